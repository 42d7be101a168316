// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/precedence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/plan/blockade.h"
#include "core/plan/departure.h"
#include "core/plan/sampling/ways.h"
#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

constexpr double kTurn_s = kPrecedenceAfter_s + kPrecedenceFor_s;

double Waited_s(const RobotRecord& record, std::int64_t now_ns) {
  constexpr double kSecondsPerNanosecond = 1e-9;
  return static_cast<double>(now_ns - record.wanted_since_ns) * kSecondsPerNanosecond;
}

bool GoesFirst(const RobotRecord& record, std::int64_t now_ns) {
  return StandsAndWants(record) &&
         std::fmod(Waited_s(record, now_ns), kTurn_s) >= kPrecedenceAfter_s;
}

// Who goes before others, the first of all first.
std::vector<RobotId> Precedence(const Belief& belief) {
  using Turn = std::tuple<std::int64_t, std::int64_t, RobotId>;  // turns that it has had
  std::vector<Turn> turns;
  for (const auto& [id, record] : belief.robots) {
    if (!GoesFirst(record, belief.sample_time_ns)) continue;
    const double had = std::floor(Waited_s(record, belief.sample_time_ns) / kTurn_s);
    turns.emplace_back(static_cast<std::int64_t>(had), record.wanted_since_ns, id);
  }
  std::sort(turns.begin(), turns.end());
  for (auto begin = turns.begin(); begin != turns.end();) {
    const std::int64_t had = std::get<0>(*begin);
    const auto end = std::find_if(begin, turns.end(),
                                  [&](const Turn& turn) { return std::get<0>(turn) != had; });
    std::rotate(begin, begin + had % (end - begin), end);
    begin = end;
  }
  std::vector<RobotId> order;
  for (const Turn& turn : turns) order.push_back(std::get<2>(turn));
  return order;
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
  std::vector<RobotId> before = Precedence(belief);
  before.erase(std::find(before.begin(), before.end(), robot), before.end());
  std::sort(before.begin(), before.end());
  std::vector<KeptWay> ways;
  for (const RobotId& id : before) {
    auto way = KeptWayOf(belief, belief.robots.at(id), robot, options);
    if (way) ways.push_back({id, *std::move(way)});
  }
  return ways;
}

}  // namespace plumescout
