// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/precedence.h"

#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/plan/blockade.h"
#include "core/plan/departure.h"
#include "core/plan/sampling/ways.h"
#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

bool GoesFirst(const RobotRecord& record, std::int64_t now_ns) {
  constexpr double kSecondsPerNanosecond = 1e-9;
  const bool stands =
      record.state.has_pose && !record.state.silent && record.live_trajectory == nullptr;
  if (!stands || !record.wanted_goal) return false;
  const double waited_s =
      static_cast<double>(now_ns - record.wanted_since_ns) * kSecondsPerNanosecond;
  return std::fmod(waited_s, kPrecedenceAfter_s + kPrecedenceFor_s) >= kPrecedenceAfter_s;
}

bool IsBefore(const RobotRecord& a, const RobotRecord& b) {
  return std::pair(a.wanted_since_ns, a.state.id) < std::pair(b.wanted_since_ns, b.state.id);
}

// From where it stands to what it wants, round those that stand; none if there is no such way.
std::optional<Trajectory> WantedWay(const Belief& belief,
                                    const std::map<RobotId, RobotRecord>& robots,
                                    const RobotRecord& record, const PlanningOptions& options) {
  const Pose2& pose = record.state.pose;
  const Point2 goal = record.wanted_goal->position;
  if (!belief.occupancy->Contains(belief.geometry().CellAt(pose.position()))) return std::nullopt;
  const std::optional<Departure> departure = Depart(belief, pose.position());
  if (!departure) return std::nullopt;
  const Grid<std::uint8_t> open = OpenTo(belief, robots, record.state.id, pose.position(), options);
  const GridGeometry& geometry = belief.geometry();
  const bool ends_open =
      open.At(geometry.CellAt(departure->start), 0) != 0 && open.At(geometry.CellAt(goal), 0) != 0;
  if (!ends_open) return std::nullopt;
  const Way way = WaysFrom(open, departure->start, {goal}).front();
  if (way.vertices.empty()) return std::nullopt;
  std::vector<Point2> vertices = departure->way_out;
  vertices.insert(vertices.end(), way.vertices.begin(), way.vertices.end());
  return TimeTrajectory(vertices, pose.yaw_rad, options);
}

std::optional<Trajectory> KeptWayOf(const Belief& belief, const RobotRecord& record,
                                    const RobotId& planner, const PlanningOptions& options) {
  std::map<RobotId, RobotRecord> robots = belief.robots;
  robots.at(planner).live_trajectory = nullptr;  // it is to have another
  std::optional<double> wait_s;
  std::optional<Trajectory> way = WantedWay(belief, robots, record, options);
  if (way) {
    wait_s = Traffic(robots, record.state.id, options.robot_clearance_m, belief.sample_time_ns)
                 .LeastWait_s(*way, Traffic::kHorizon_s);
  } else {
    robots.erase(planner);
    way = WantedWay(belief, robots, record, options);
  }
  if (way) WaitAtStart(wait_s.value_or(Traffic::kHorizon_s), *way);
  return way;
}

}  // namespace

std::vector<KeptWay> KeptWays(const Belief& belief, const RobotId& robot,
                              const PlanningOptions& options) {
  const std::int64_t now_ns = belief.sample_time_ns;
  const RobotRecord& own = belief.robots.at(robot);
  const bool own_goes_first = GoesFirst(own, now_ns);
  std::vector<KeptWay> ways;
  for (const auto& [id, record] : belief.robots) {
    if (id == robot || !GoesFirst(record, now_ns)) continue;
    if (own_goes_first && IsBefore(own, record)) continue;
    if (auto way = KeptWayOf(belief, record, robot, options)) ways.push_back({id, *std::move(way)});
  }
  return ways;
}

}  // namespace plumescout
