// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/home_goal.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/grid/escape.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

// Nearer than this a robot is at home: more than followers miss a goal by.
constexpr double kAtHome_m = 0.3;
// Home may lie this much deeper than the inflation radius in cells where no robot can stand.
constexpr double kInFrontOfHome_m = 1.0;
// And this far from there, if other robots stand at home.
constexpr double kAroundHome_m = 3.0;

Point2 HomeOf(const GoalQuery& query) {
  if (query.belief.options->home) return *query.belief.options->home;
  return query.robot.first_place.value_or(query.belief.geometry().Center(query.start));
}

// Whether the robot could stand there beside those that stand, and be led there round them: ways
// round keep off by half a cell more (way_round.h). By its doubt where it is, as traffic has it,
// and by that there.
bool HasRoom(const GoalQuery& query, Point2 place) {
  const double half_diagonal_m = query.belief.geometry().resolution_m / std::sqrt(2.0);
  const double clearance_m = query.options.robot_clearance_m;
  RobotState there = query.robot.state;
  there.pose = {place.x_m, place.y_m, 0.0};
  return std::none_of(
      query.belief.robots.begin(), query.belief.robots.end(), [&](const auto& entry) {
        const RobotState& other = entry.second.state;
        const bool stands =
            other.has_pose && !other.silent && entry.second.live_trajectory == nullptr;
        return other.id != query.robot.state.id && stands &&
               Distance_m(place, other.pose.position()) <
                   std::max(Apart_m(there, other, clearance_m),
                            Apart_m(query.robot.state, other, clearance_m)) +
                       half_diagonal_m;
      });
}

// `home`, or the nearest cell to it that has room; `home` if there is none in kAroundHome_m. The
// first in the order of rows of several.
Cell RoomAt(const GoalQuery& query, Cell home) {
  const GridGeometry& geometry = query.belief.geometry();
  if (!query.options.yield_to_robots || HasRoom(query, geometry.Center(home))) return home;
  const int reach = static_cast<int>(std::floor(kAroundHome_m / geometry.resolution_m));
  Cell nearest = home;
  int nearest_cells2 = reach * reach + 1;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell cell{home.x + dx, home.y + dy};
      const int cells2 = dx * dx + dy * dy;
      if (cells2 >= nearest_cells2 || query.reachable.At(cell, 0) == 0) continue;
      if (!HasRoom(query, geometry.Center(cell))) continue;
      nearest = cell;
      nearest_cells2 = cells2;
    }
  }
  return nearest;
}

}  // namespace

HomeGoal FindHome(const GoalQuery& query) {
  const GridGeometry& geometry = query.belief.geometry();
  const Point2 place = HomeOf(query);
  HomeGoal home;
  home.goal = {GoalKind::kHome, geometry.CellAt(place), place, place, 0};
  const std::vector<Cell> way =
      EscapePath(*query.belief.occupancy, query.reachable, home.goal.cell);
  const double reach_m = query.belief.options->occupancy.inflation_radius_m + kInFrontOfHome_m;
  if (way.empty() || Distance_m(geometry.Center(way.back()), place) > reach_m) return home;
  home.reachable = true;
  home.goal.cell = RoomAt(query, way.back());
  home.goal.position = geometry.Center(home.goal.cell);
  home.is_there = home.goal.cell == query.start ||
                  Distance_m(geometry.Center(query.start), home.goal.position) <= kAtHome_m;
  return home;
}

}  // namespace plumescout
