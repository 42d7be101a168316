// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/blockade.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include "core/grid/flood.h"
#include "core/plan/departure.h"
#include "core/plan/sampling/ways.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;
// Poses err by a little: who is on the way by less than this is not.
constexpr double kTolerance_m = 0.05;
constexpr double kStep_m = 0.1;

// Where a robot would go that stands, and for how long it would have.
struct Wish {
  Goal goal;
  double waits_s = 0.0;
};

std::optional<Wish> WishOf(const RobotRecord& record, std::int64_t now_ns) {
  if (StandsAndWants(record)) {
    return Wish{*record.wanted_goal,
                static_cast<double>(now_ns - record.wanted_since_ns) * kSecondsPerNanosecond};
  }
  const bool is_stuck = record.live_trajectory != nullptr && StandsStill(record, now_ns);
  if (!is_stuck || !record.live_goal || record.live_goal->kind == GoalKind::kMakeWay)
    return std::nullopt;
  return Wish{*record.live_goal, Lateness_s(record, now_ns)};
}

std::vector<Point2> InSteps(const std::vector<Point2>& vertices) {
  std::vector<Point2> points;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    const Point2 from = vertices[i];
    const Point2 to = vertices[i + 1];
    const int count = 1 + static_cast<int>(Distance_m(from, to) / kStep_m);
    for (int k = 0; k < count; ++k) {
      const double share = static_cast<double>(k) / count;
      points.push_back(
          {from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m)});
    }
  }
  if (!vertices.empty()) points.push_back(vertices.back());
  return points;
}

// Whether the way comes nearer to the one that stands than it may.
bool IsInTheWay(const RobotState& standing, const std::vector<Point2>& way, double apart_m) {
  const Point2 place = standing.pose.position();
  const double limit_m = std::min(apart_m, Distance_m(way.front(), place)) - kTolerance_m;
  return std::any_of(way.begin(), way.end(),
                     [&](Point2 point) { return Distance_m(point, place) < limit_m; });
}

const BlockedRobot* Find(const std::vector<BlockedRobot>& blocked, const RobotId& robot) {
  const auto found =
      std::find_if(blocked.begin(), blocked.end(),
                   [&](const BlockedRobot& candidate) { return candidate.robot == robot; });
  return found == blocked.end() ? nullptr : &*found;
}

// All that the robot waits for, and those that these wait for, and so on.
std::set<RobotId> WaitedFor(const std::vector<BlockedRobot>& blocked, const RobotId& robot) {
  std::set<RobotId> all;
  std::vector<RobotId> open = {robot};
  while (!open.empty()) {
    const BlockedRobot* const next = Find(blocked, open.back());
    open.pop_back();
    if (next == nullptr) continue;
    for (const RobotId& by : next->by) {
      if (all.insert(by).second) open.push_back(by);
    }
  }
  return all;
}

std::vector<Point2> ShortestWay(const Belief& belief, Point2 from, Point2 to) {
  const std::optional<Departure> departure = Depart(belief, from);
  if (!departure || belief.traversable->At(belief.geometry().CellAt(to), 0) == 0) return {};
  std::vector<Point2> vertices = departure->way_out;
  const Way way = WaysFrom(*belief.traversable, departure->start, {to}).front();
  if (way.vertices.empty()) return {};
  vertices.insert(vertices.end(), way.vertices.begin(), way.vertices.end());
  return InSteps(vertices);
}

bool HasAWay(const Belief& belief, const Grid<std::uint8_t>& open, Point2 from, Point2 to) {
  const std::optional<Departure> departure = Depart(belief, from);
  if (!departure) return false;
  const Cell start = belief.geometry().CellAt(departure->start);
  return ReachableCells(open, {start}).At(belief.geometry().CellAt(to), 0) != 0;
}

}  // namespace

bool StandsStill(const RobotRecord& record, std::int64_t now_ns) {
  if (!record.state.has_pose || record.state.silent) return false;
  return !IsOnItsWay(record, now_ns) || Lateness_s(record, now_ns) >= kStuck_s;
}

bool StandsAndWants(const RobotRecord& record) {
  return record.state.has_pose && !record.state.silent && record.live_trajectory == nullptr &&
         record.wanted_goal.has_value();
}

void CloseAround(const RobotState& standing, const RobotState& mover, Point2 from,
                 const PlanningOptions& options, Grid<std::uint8_t>& open) {
  CloseDisc(standing.pose.position(), Apart_m(mover, standing, options.robot_clearance_m), from,
            open);
}

void CloseDisc(Point2 center, double apart_m, Point2 from, Grid<std::uint8_t>& open) {
  const GridGeometry& geometry = open.geometry();
  const double half_diagonal_m = geometry.resolution_m / std::sqrt(2.0);
  // As ways round robots keep off (way_round.h): what they find no way to is not open.
  const double limit_m =
      std::min(apart_m + half_diagonal_m, Distance_m(center, from) - half_diagonal_m);
  if (!(limit_m > 0.0)) return;
  const Cell low = geometry.CellAt({center.x_m - limit_m, center.y_m - limit_m});
  const Cell high = geometry.CellAt({center.x_m + limit_m, center.y_m + limit_m});
  for (int y = std::max(0, low.y); y <= std::min(geometry.height - 1, high.y); ++y) {
    for (int x = std::max(0, low.x); x <= std::min(geometry.width - 1, high.x); ++x) {
      const Cell cell{x, y};
      if (Distance_m(geometry.Center(cell), center) < limit_m) open[cell] = 0;
    }
  }
}

Grid<std::uint8_t> OpenTo(const Belief& belief, const std::map<RobotId, RobotRecord>& robots,
                          const RobotId& robot, Point2 from, const PlanningOptions& options) {
  Grid<std::uint8_t> open = *belief.traversable;
  const RobotState& mover = robots.at(robot).state;
  for (const auto& [id, record] : robots) {
    if (id == robot || !StandsStill(record, belief.sample_time_ns)) continue;
    CloseAround(record.state, mover, from, options, open);
  }
  return open;
}

std::vector<BlockedRobot> FindBlockedRobots(const Belief& belief,
                                            const std::map<RobotId, RobotRecord>& robots,
                                            const PlanningOptions& options) {
  const double half_diagonal_m = belief.geometry().resolution_m / std::sqrt(2.0);
  std::vector<BlockedRobot> blocked;
  for (const auto& [id, record] : robots) {
    const std::optional<Wish> wish = WishOf(record, belief.sample_time_ns);
    const Point2 place = record.state.pose.position();
    if (!wish || !belief.occupancy->Contains(belief.geometry().CellAt(place))) continue;
    const Point2 goal = wish->goal.position;
    if (HasAWay(belief, OpenTo(belief, robots, id, place, options), place, goal)) continue;
    BlockedRobot found{id, record.state.radius_m, wish->goal, ShortestWay(belief, place, goal),
                       {}, wish->waits_s};
    if (found.way.empty()) continue;
    for (const auto& [other_id, other] : robots) {
      const double apart_m =
          Apart_m(record.state, other.state, options.robot_clearance_m) + half_diagonal_m;
      if (other_id != id && StandsStill(other, belief.sample_time_ns) &&
          IsInTheWay(other.state, found.way, apart_m)) {
        found.by.push_back(other_id);
      }
    }
    if (!found.by.empty()) blocked.push_back(std::move(found));
  }
  return blocked;
}

std::vector<BlockedRobot> FindRing(const std::vector<BlockedRobot>& blocked, const RobotId& robot) {
  std::vector<BlockedRobot> ring;
  const std::set<RobotId> waited_for = WaitedFor(blocked, robot);
  for (const BlockedRobot& one : blocked) {
    if (waited_for.contains(one.robot) && WaitedFor(blocked, one.robot).contains(robot)) {
      ring.push_back(one);
    }
  }
  return ring;
}

}  // namespace plumescout
