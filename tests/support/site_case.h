// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/belief/belief.h"
#include "core/plan/sampling/sites.h"
#include "core/plan/strategy.h"
#include "core/types/options.h"
#include "tests/support/goal_case.h"

namespace plumescout::testing {

// Where sites are, for tests on drawn maps with cells of 0.1 m: each free cell is one.
inline constexpr double kArtSpacing_m = 0.1;

// All of a drawn map.
inline Rectangle RegionOf(const GridGeometry& map) {
  return {{map.origin_x_m, map.origin_y_m},
          {map.origin_x_m + map.width * map.resolution_m,
           map.origin_y_m + map.height * map.resolution_m}};
}

// width x height free cells, in a rectangle without walls; the robot's is 'S'.
inline GridArt OpenArt(int width, int height, Cell start = {0, 0}) {
  GridArt art(static_cast<std::size_t>(height), std::string(static_cast<std::size_t>(width), '.'));
  art.at(static_cast<std::size_t>(height - 1 - start.y)).at(static_cast<std::size_t>(start.x)) =
      'S';
  return art;
}

// A belief over a drawn map where the gas is known: there is none.
inline Belief SiteBelief(const GridArt& art) {
  Belief belief = BeliefFromArt(art);
  for (auto* field : {&belief.gas_mean_ppm, &belief.gas_variance_ppm2}) {
    *field = std::make_shared<const Grid<float>>(belief.geometry(), 0.0F);
  }
  return belief;
}

inline void SetSampled(Belief& belief, const std::vector<Cell>& cells) {
  Grid<std::uint8_t> sampled = *belief.sampled;
  for (const Cell cell : cells) sampled[cell] = 1;
  belief.sampled = std::make_shared<const Grid<std::uint8_t>>(sampled);
}

inline void SetMean(Belief& belief, Cell cell, float mean_ppm) {
  Grid<float> mean = *belief.gas_mean_ppm;
  mean[cell] = mean_ppm;
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(mean);
}

inline void SetVariance(Belief& belief, Cell cell, float variance_ppm2) {
  Grid<float> variance = *belief.gas_variance_ppm2;
  variance[cell] = variance_ppm2;
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(variance);
}

inline void MovePose(Belief& belief, Point2 place, const RobotId& robot = "r") {
  RobotState& state = belief.robots[robot].state;
  state.id = robot;
  state.has_pose = true;
  state.pose = {place.x_m, place.y_m, 0.0};
}

// Robot `id` is on its way to sample at `stops`, with this claim on the last of them.
inline void AddOtherRobot(Belief& belief, const RobotId& id, const std::vector<Point2>& stops,
                          std::int64_t claim_expires_ns = 1'000'000'000) {
  MovePose(belief, stops.front(), id);
  Trajectory live;
  for (const Point2 stop : stops) {
    Waypoint waypoint;
    waypoint.pose = {stop.x_m, stop.y_m, 0.0};
    waypoint.dwell_s = 2.0;
    live.waypoints.push_back(waypoint);
  }
  const Point2 last = stops.back();
  const Goal goal = {GoalKind::kSite, belief.geometry().CellAt(last), last, last, 0};
  RobotRecord& record = belief.robots[id];
  record.live_trajectory = std::make_shared<const Trajectory>(live);
  record.live_goal = goal;
  belief.claims.push_back({id, 7, goal, claim_expires_ns});
}

// Options of a sampling strategy over all of a drawn map: at 1 m/s, 2 s at each site.
inline PlanningOptions SiteOptionsOf(const std::string& strategy, const GridGeometry& map) {
  PlanningOptions options;
  options.strategy = strategy;
  if (!ApplyStrategyRow(options).ok()) return {};  // of a strategy that samples nothing
  options.speed_mps = 1.0;
  options.dwell_s = 2.0;
  options.sites.region = RegionOf(map);
  options.sites.spacing_m = kArtSpacing_m;
  options.sites.survey = false;
  return options;
}

// The cells of these places.
inline std::vector<Cell> CellsOf(const GridGeometry& map, const std::vector<Point2>& places) {
  std::vector<Cell> cells;
  for (const Point2 place : places) cells.push_back(map.CellAt(place));
  return cells;
}

// For whom rules choose, on a drawn map: as GoalCase, with sites.
struct SiteCase : GoalCase {
  explicit SiteCase(const GridArt& art) : GoalCase(art) {
    belief = SiteBelief(art);
    options = SiteOptionsOf("lhr", belief.geometry());
  }

  SiteLattice Lattice() const { return LatticeOver(belief.geometry(), options.sites); }
  Sites Find() const { return FindSites(Query(), Lattice()); }
  Point2 At(Cell cell) const { return belief.geometry().Center(cell); }
};

}  // namespace plumescout::testing
