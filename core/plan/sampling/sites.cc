// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/sites.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/grid/grid_search.h"
#include "core/plan/goals/frontier_goals.h"

namespace plumescout {
namespace {

// Sites with a sampled cell in their square, by index.
std::vector<std::uint8_t> SampledSites(const Grid<std::uint8_t>& sampled,
                                       const SiteLattice& lattice) {
  std::vector<std::uint8_t> sites(lattice.size(), 0);
  for (std::size_t i = 0; i < sampled.size(); ++i) {
    if (sampled[i] == 0) continue;
    const Point2 place = sampled.geometry().Center(sampled.geometry().CellAtIndex(i));
    const double column = std::floor((place.x_m - lattice.corner.x_m) / lattice.spacing_m);
    const double row = std::floor((place.y_m - lattice.corner.y_m) / lattice.spacing_m);
    if (column < 0.0 || row < 0.0 || column >= lattice.columns || row >= lattice.rows) continue;
    sites[static_cast<std::size_t>(row) * static_cast<std::size_t>(lattice.columns) +
          static_cast<std::size_t>(column)] = 1;
  }
  return sites;
}

double MapMean_ppm(const Belief& belief) {
  double sum_ppm = 0.0;
  double cells = 0.0;
  for (const float mean : belief.gas_mean_ppm->values()) {
    if (!std::isfinite(mean)) continue;
    sum_ppm += mean - belief.options->gas.background_mean_ppm;
    cells += 1.0;
  }
  return cells > 0.0 ? sum_ppm / cells : 0.0;
}

// The other robot whose live plan stops at the goal, if there is one.
std::optional<RobotId> StoppingThere(const GoalQuery& query, const Goal& goal) {
  for (const auto& [id, record] : query.belief.robots) {
    if (id == query.robot.state.id || record.live_trajectory == nullptr) continue;
    const std::vector<Waypoint>& waypoints = record.live_trajectory->waypoints;
    const bool stops = std::any_of(waypoints.begin(), waypoints.end(), [&](const Waypoint& w) {
      return w.dwell_s > 0.0 && Distance_m(w.pose.position(), goal.position) < kSamePlaceRadius_m;
    });
    if (stops) return id;
  }
  return std::nullopt;
}

std::optional<RejectedGoal> Rejected(const GoalQuery& query, const Goal& goal) {
  if (std::optional<RejectedGoal> rejected = RejectedByMemory(query, goal)) return rejected;
  const std::optional<RobotId> other = StoppingThere(query, goal);
  if (!other) return std::nullopt;
  return RejectedGoal{goal, RejectionReason::kClaimed, absl::StrCat("by robot \"", *other, "\"")};
}

void TakeEstimate(const Belief& belief, Site& site) {
  const GasOptions& gas = belief.options->gas;
  const float mean_ppm = (*belief.gas_mean_ppm)[site.cell];
  const float variance_ppm2 = (*belief.gas_variance_ppm2)[site.cell];
  site.mean_ppm = std::isfinite(mean_ppm) ? mean_ppm - gas.background_mean_ppm : 0.0;
  site.variance_ppm2 = std::isfinite(variance_ppm2) ? variance_ppm2 : OpenLatticeVariance_ppm2(gas);
}

}  // namespace

Goal GoalAt(const Site& site) { return {GoalKind::kSite, site.cell, site.place, site.place, 0}; }

Sites FindSites(const GoalQuery& query, const SiteLattice& lattice) {
  const GridGeometry& geometry = query.belief.geometry();
  Sites sites{lattice, {}, {}, MapMean_ppm(query.belief)};
  const std::vector<std::uint8_t> sampled = SampledSites(*query.belief.sampled, lattice);
  const Grid<double> travel_m = TravelDistances_m(query.reachable, std::vector<Cell>{query.start});
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    Site site;
    site.index = i;
    site.cell = geometry.CellAt(lattice.Place(i));
    if (query.reachable.At(site.cell, 0) == 0) continue;
    site.place = geometry.Center(site.cell);
    site.travel_m = travel_m[site.cell];
    site.sampled = sampled[i] != 0;
    TakeEstimate(query.belief, site);
    if (std::optional<RejectedGoal> rejected = Rejected(query, GoalAt(site))) {
      sites.rejected.push_back(*std::move(rejected));
    } else {
      sites.offered.push_back(site);
    }
  }
  return sites;
}

}  // namespace plumescout
