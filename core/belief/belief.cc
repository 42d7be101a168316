// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/belief.h"

#include <utility>

#include "core/frontier/gas_frontier.h"
#include "core/frontier/occupancy_frontier.h"
#include "core/types/species.h"

namespace plumescout {
namespace {

std::vector<Cell> RobotCells(const Belief& belief) {
  std::vector<Cell> cells;
  for (const auto& [id, record] : belief.robots) {
    if (!record.state.has_pose) continue;
    const Cell cell = belief.geometry().CellAt(record.state.pose.position());
    if (belief.geometry().Contains(cell)) cells.push_back(cell);
  }
  return cells;
}

}  // namespace

MapStatus MakeMapStatus(const Belief& belief) {
  MapStatus map;
  map.revision = belief.revision;
  map.gas_counters = belief.gas_counters;
  map.gas_quality = belief.gas_quality;
  map.gas_audits = belief.gas_audits;
  map.sensor_offsets = belief.sensor_offsets;
  map.phase = belief.phase;
  map.objective = belief.objective;
  if (belief.objective) {
    map.objective_explanation = Describe(*belief.objective, belief.options->objective);
  }
  map.keep_out = belief.options->keep_out;
  for (const auto& [id, record] : belief.robots) map.robots.push_back(record.state);

  const MissionOptions& options = *belief.options;
  for (std::size_t i = 0; i < options.gas_species.size(); ++i) {
    const GasField gas = belief.Gas(i);
    map.gases.push_back({SpeciesName(options, i), gas.counters, gas.quality, gas.audits});
  }
  const std::vector<Cell> starts = RobotCells(belief);
  const GasFrontierInput gas{*belief.occupancy, *belief.traversable, *belief.gas_mean_ppm,
                             *belief.gas_variance_ppm2};
  const double observed_ppm2 = ObservedVariance_ppm2(options.frontier, options.gas);
  map.gas_threshold_ppm = GasThreshold_ppm(gas, observed_ppm2, options.frontier);
  map.frontiers = FindOccupancyFrontiers(*belief.occupancy, *belief.traversable, starts,
                                         options.frontier.min_occupancy_cell_count);
  for (Frontier& frontier :
       FindGasFrontiers(gas, observed_ppm2, map.gas_threshold_ppm, starts, options.frontier)) {
    map.frontiers.push_back(std::move(frontier));
  }
  return map;
}

MapSnapshot MakeMapSnapshot(const Belief& belief) {
  MapSnapshot map{MakeMapStatus(belief), *belief.occupancy, *belief.gas_mean_ppm,
                  *belief.Gas(0).published_variance_ppm2()};
  for (std::size_t i = 1; i <= belief.further_gases.size(); ++i) {
    const GasField gas = belief.Gas(i);
    map.further_gases.push_back(
        {SpeciesName(*belief.options, i), *gas.mean_ppm, *gas.published_variance_ppm2()});
  }
  return map;
}

}  // namespace plumescout
