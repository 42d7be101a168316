// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/sites.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/grid/grid_search.h"
#include "core/plan/goals/frontier_goals.h"

namespace plumescout {
namespace {

// The site whose square a place lies in.
std::optional<std::size_t> SiteAt(const SiteLattice& lattice, Point2 place) {
  const double column = std::floor((place.x_m - lattice.corner.x_m) / lattice.spacing_m);
  const double row = std::floor((place.y_m - lattice.corner.y_m) / lattice.spacing_m);
  if (!(column >= 0.0 && row >= 0.0 && column < lattice.columns && row < lattice.rows)) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(lattice.columns) +
         static_cast<std::size_t>(column);
}

// Sites with a sampled cell in their square, by index.
std::vector<std::uint8_t> SampledSites(const Grid<std::uint8_t>& sampled,
                                       const SiteLattice& lattice) {
  std::vector<std::uint8_t> sites(lattice.size(), 0);
  for (std::size_t i = 0; i < sampled.size(); ++i) {
    if (sampled[i] == 0) continue;
    const Point2 place = sampled.geometry().Center(sampled.geometry().CellAtIndex(i));
    if (const std::optional<std::size_t> site = SiteAt(lattice, place)) sites[*site] = 1;
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

// Cells in which the live plans of other robots stop, by index. A claim that has run out, of a
// robot that is stuck, keeps nobody away.
using StopsOfOthers = std::map<std::size_t, RobotId>;

StopsOfOthers FindStopsOfOthers(const GoalQuery& query) {
  const Belief& belief = query.belief;
  StopsOfOthers stops;
  for (const GoalClaim& claim : belief.claims) {
    if (claim.robot == query.robot.state.id || claim.expires_ns <= belief.sample_time_ns) continue;
    const auto other = belief.robots.find(claim.robot);
    if (other == belief.robots.end() || other->second.live_trajectory == nullptr) continue;
    for (const Waypoint& waypoint : other->second.live_trajectory->waypoints) {
      const Cell cell = belief.geometry().CellAt(waypoint.pose.position());
      if (waypoint.dwell_s == 0.0 || !belief.geometry().Contains(cell)) continue;
      stops.emplace(belief.geometry().Index(cell), claim.robot);
    }
  }
  return stops;
}

std::optional<RejectedGoal> Rejected(const GoalQuery& query, const Goal& goal,
                                     const StopsOfOthers& stops) {
  if (std::optional<RejectedGoal> rejected = RejectedByMemory(query, goal)) return rejected;
  const auto stop = stops.find(query.belief.geometry().Index(goal.cell));
  if (stop == stops.end()) return std::nullopt;
  return RejectedGoal{goal, RejectionReason::kClaimed,
                      absl::StrCat("by robot \"", stop->second, "\"")};
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
  const StopsOfOthers stops = FindStopsOfOthers(query);
  Grid<std::uint8_t> open = query.reachable;  // to sites: each cell once
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    Site site;
    site.index = i;
    site.cell = geometry.CellAt(lattice.Place(i));
    if (open.At(site.cell, 0) == 0) continue;
    open[site.cell] = 0;
    site.place = geometry.Center(site.cell);
    site.travel_m = travel_m[site.cell];
    // The cell that holds the middle of a square may have its own middle in the next.
    site.sampled = sampled[i] != 0 || (*query.belief.sampled)[site.cell] != 0;
    TakeEstimate(query.belief, site);
    if (std::optional<RejectedGoal> rejected = Rejected(query, GoalAt(site), stops)) {
      sites.rejected.push_back(*std::move(rejected));
    } else {
      sites.offered.push_back(site);
    }
  }
  return sites;
}

bool AreSampled(const Belief& belief, const SiteLattice& lattice,
                const std::vector<Point2>& places) {
  const std::vector<std::uint8_t> sites = SampledSites(*belief.sampled, lattice);
  return std::all_of(places.begin(), places.end(), [&](Point2 place) {
    const std::optional<std::size_t> site = SiteAt(lattice, place);
    return (site && sites[*site] != 0) ||
           belief.sampled->At(belief.geometry().CellAt(place), 0) != 0;
  });
}

}  // namespace plumescout
