// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/mission_figures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/types/frontier.h"
#include "core/types/species.h"
#include "proto/convert/names.h"

namespace plumescout::server {
namespace {

double CellArea_m2(const Belief& belief) {
  const double size_m = belief.geometry().resolution_m;
  return size_m * size_m;
}

double KnownArea_m2(const Belief& belief) {
  const auto& cells = belief.occupancy->values();
  const auto unknown = std::count(cells.begin(), cells.end(), CellState::kUnknown);
  return static_cast<double>(static_cast<std::ptrdiff_t>(cells.size()) - unknown) *
         CellArea_m2(belief);
}

double Entropy_nats(double variance_ppm2) {
  return 0.5 * std::log(2.0 * std::numbers::pi * std::numbers::e * variance_ppm2);
}

// Of cells that are known, as their rasters are published.
void AddField(const Belief& belief, std::size_t species, double threshold_ppm,
              v1::GasFigures& figures) {
  const GasField gas = belief.Gas(species);
  const Grid<float>& variances_ppm2 = *gas.published_variance_ppm2();
  std::int64_t plume_cells = 0;
  std::int64_t cells = 0;
  double entropy_nats = 0.0;
  for (std::size_t i = 0; i < belief.occupancy->size(); ++i) {
    const double mean_ppm = (*gas.mean_ppm)[i];
    if ((*belief.occupancy)[i] == CellState::kUnknown || std::isnan(mean_ppm)) continue;
    if (!figures.has_max_mean_ppm() || mean_ppm > figures.max_mean_ppm()) {
      figures.set_max_mean_ppm(mean_ppm);
    }
    if (threshold_ppm > 0.0 && mean_ppm > threshold_ppm) ++plume_cells;
    const double variance_ppm2 = variances_ppm2[i];
    if (!(variance_ppm2 > 0.0)) continue;
    ++cells;
    entropy_nats += Entropy_nats(variance_ppm2);
  }
  figures.set_plume_area_m2(static_cast<double>(plume_cells) * CellArea_m2(belief));
  if (cells > 0) figures.set_mean_entropy_nats(entropy_nats / static_cast<double>(cells));
  figures.set_in_posterior_count(gas.counters.in_posterior);
}

bool IsOpen(const Frontier& frontier) {
  return frontier.kind == FrontierKind::kOccupancy && frontier.reachable && !frontier.too_small;
}

}  // namespace

v1::MissionFigures FiguresOf(const Belief& belief, const MissionId& mission,
                             std::int64_t begin_ns) {
  const MapStatus status = MakeMapStatus(belief);
  v1::MissionFigures figures;
  figures.set_revision(belief.revision);
  figures.set_elapsed_s(1e-9 * static_cast<double>(belief.sample_time_ns - begin_ns));
  figures.set_known_area_m2(KnownArea_m2(belief));
  figures.set_reachable_area_m2(status.completeness.reachable_area_m2);
  figures.set_observed_area_m2(status.completeness.observed_area_m2);
  figures.set_open_frontier_count(
      static_cast<int>(std::count_if(status.frontiers.begin(), status.frontiers.end(), IsOpen)));
  if (status.objective) figures.set_undecided_area_m2(status.objective->undecided_area_m2);
  for (std::size_t i = 0; i < SpeciesCount(*belief.options); ++i) {
    v1::GasFigures& gas = *figures.add_gases();
    gas.set_species(SpeciesName(*belief.options, i));
    AddField(belief, i, i == 0 ? status.gas_threshold_ppm : 0.0, gas);
  }
  for (const RobotState& robot : status.robots) {
    v1::RobotFigures& told = *figures.add_robots();
    told.set_robot(RobotResource({mission, robot.id}));
    told.set_applied_sequence(robot.applied_sequence);
  }
  return figures;
}

}  // namespace plumescout::server
