// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/completeness.h"

#include <cstddef>
#include <cstdint>

#include "core/frontier/gas_frontier.h"
#include "core/grid/escape.h"
#include "core/grid/flood.h"

namespace plumescout {

std::vector<Cell> PlacesOfRobots(const Belief& belief) {
  std::vector<Cell> cells;
  // Who stands in the inflated zone may leave it, as for a plan.
  const auto add = [&](Point2 place) {
    const Cell cell = belief.geometry().CellAt(place);
    if (!belief.geometry().Contains(cell)) return;
    const std::vector<Cell> way = EscapePath(*belief.occupancy, *belief.traversable, cell);
    cells.push_back(way.empty() ? cell : way.back());
  };
  for (const auto& [id, record] : belief.robots) {
    if (record.state.has_pose) add(record.state.pose.position());
    if (record.first_place) add(*record.first_place);
  }
  return cells;
}

Completeness AssessCompleteness(const Belief& belief) {
  const MissionOptions& options = *belief.options;
  const auto observed_ppm2 =
      static_cast<float>(ObservedVariance_ppm2(options.frontier, options.gas));
  const Grid<std::uint8_t> reachable = ReachableCells(*belief.traversable, PlacesOfRobots(belief));
  std::size_t reached = 0;
  std::size_t observed = 0;
  for (std::size_t i = 0; i < reachable.size(); ++i) {
    if (reachable[i] == 0) continue;
    ++reached;
    if ((*belief.gas_variance_ppm2)[i] <= observed_ppm2) ++observed;  // false for NaN, too
  }
  const double cell_m2 = belief.geometry().resolution_m * belief.geometry().resolution_m;
  return {.reachable_area_m2 = static_cast<double>(reached) * cell_m2,
          .observed_area_m2 = static_cast<double>(observed) * cell_m2};
}

}  // namespace plumescout
