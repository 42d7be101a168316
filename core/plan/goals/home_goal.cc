// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/home_goal.h"

#include <vector>

#include "core/grid/escape.h"

namespace plumescout {
namespace {

// Nearer than this a robot is at home: more than followers miss a goal by.
constexpr double kAtHome_m = 0.3;
// Home may lie this much deeper than the inflation radius in cells where no robot can stand.
constexpr double kInFrontOfHome_m = 1.0;

Point2 HomeOf(const GoalQuery& query) {
  if (query.belief.options->home) return *query.belief.options->home;
  return query.robot.first_place.value_or(query.belief.geometry().Center(query.start));
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
  home.goal.cell = way.back();
  home.goal.position = geometry.Center(way.back());
  home.is_there = home.goal.cell == query.start ||
                  Distance_m(geometry.Center(query.start), home.goal.position) <= kAtHome_m;
  return home;
}

}  // namespace plumescout
