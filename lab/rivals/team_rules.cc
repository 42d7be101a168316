// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/team_rules.h"

#include <algorithm>
#include <cmath>

#include "core/grid/ray.h"
#include "lab/rivals/assignment.h"

namespace plumescout::lab {
namespace {

bool CanSee(const Grid<CellState>& occupancy, Point2 from, Point2 to) {
  return WalkSegment(occupancy.geometry(), from, to, [&](Cell cell, double) {
    return occupancy.At(cell, CellState::kUnknown) != CellState::kOccupied;
  });
}

// Unknown area within the radius of `center`, and of none of `taken`. Beyond the map all is
// unknown, which their grid has no cells for: it counts for nothing, as there.
double UnknownArea_m2(Point2 center, const std::vector<Point2>& taken,
                      const Grid<CellState>& occupancy, double radius_m) {
  const GridGeometry& geometry = occupancy.geometry();
  const Cell least = geometry.CellAt({center.x_m - radius_m, center.y_m - radius_m});
  const Cell most = geometry.CellAt({center.x_m + radius_m, center.y_m + radius_m});
  int unknown = 0;
  for (int y = least.y; y <= most.y; ++y) {
    for (int x = least.x; x <= most.x; ++x) {
      const Point2 at = geometry.Center({x, y});
      const auto is_near = [&](Point2 place) { return Distance_m(place, at) <= radius_m; };
      const bool counts = occupancy.At({x, y}, CellState::kFree) == CellState::kUnknown &&
                          is_near(center) && std::none_of(taken.begin(), taken.end(), is_near);
      if (counts) ++unknown;
    }
  }
  return unknown * geometry.resolution_m * geometry.resolution_m;
}

}  // namespace

std::vector<double> BurgardValues(const std::vector<Point2>& goals,
                                  const std::vector<double>& travel_m,
                                  const std::vector<Point2>& taken,
                                  const Grid<CellState>& occupancy, const BurgardOptions& options) {
  std::vector<double> values;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    double utility = 1.0;
    for (const Point2 place : taken) {
      const double distance_m = Distance_m(place, goals[i]);
      if (distance_m >= options.range_m || !CanSee(occupancy, place, goals[i])) continue;
      utility -= 1.0 - distance_m / options.range_m;
    }
    values.push_back(utility - options.beta * travel_m[i] / options.range_m);
  }
  return values;
}

std::vector<double> RrtRevenues(Point2 robot, const std::vector<Point2>& goals,
                                const std::vector<Point2>& taken, const Grid<CellState>& occupancy,
                                const RrtRuleOptions& options) {
  std::vector<double> revenues;
  for (const Point2 goal : goals) {
    const double distance_m = Distance_m(robot, goal);
    const double gain_m2 = UnknownArea_m2(goal, taken, occupancy, options.radius_m);
    const double times = distance_m <= options.near_m ? options.near_gain : 1.0;
    revenues.push_back(options.weight_per_m * times * gain_m2 - distance_m);
  }
  return revenues;
}

std::vector<std::size_t> MatchGoals(std::vector<std::vector<double>> travel_m) {
  if (travel_m.empty()) return {};
  constexpr double kNoWay_m = 1e6;  // beyond any sum of ways
  const std::size_t goals = travel_m.front().size();
  const std::size_t times = (travel_m.size() + goals - 1) / goals;
  for (std::vector<double>& ways : travel_m) {
    for (double& way_m : ways) way_m = std::min(way_m, kNoWay_m);
    for (std::size_t i = goals; i < times * goals; ++i) ways.push_back(ways[i - goals]);
  }
  std::vector<std::size_t> matched = LeastAssignment(travel_m);
  for (std::size_t& goal : matched) goal %= goals;
  return matched;
}

}  // namespace plumescout::lab
