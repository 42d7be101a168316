// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "core/occupancy/occupancy_grid.h"
#include "core/types/visit_types.h"

namespace plumescout {

// Log-odds do not tell the states: those depend on what the cell was before.
template <typename Archive, typename Self>
void OccupancyGrid::VisitState(Archive& archive, Self& self) {
  archive(self.log_odds_, self.states_);
  if constexpr (Archive::kReads) {
    const GridGeometry& geometry = self.log_odds_.geometry();
    const OccupancyOptions& options = self.options_;
    archive.Require(self.states_.geometry() == geometry, "log-odds and states differ in geometry");
    const bool fits = geometry.resolution_m == options.resolution_m &&
                      geometry.width % kTileCells == 0 && geometry.height % kTileCells == 0 &&
                      static_cast<std::int64_t>(geometry.size()) <= options.max_cell_count;
    archive.Require(fits, "the map is none of the mission's options");
    const double tile_m = kTileCells * options.resolution_m;
    for (const double origin_m : {geometry.origin_x_m, geometry.origin_y_m}) {
      // Compared so that NaN is no origin.
      const bool on_lattice =
          std::abs(origin_m / options.resolution_m) <= kMostArchivedSide_cells &&
          std::round(origin_m / tile_m) * tile_m == origin_m;
      archive.Require(on_lattice, "the map's origin lies beside its lattice");
    }
    const auto clamp = static_cast<float>(options.clamp_log_odds);
    const auto& values = self.log_odds_.values();
    archive.Require(std::all_of(values.begin(), values.end(),
                                [clamp](float value) { return std::abs(value) <= clamp; }),
                    "log-odds are beyond their clamp");
  }
}

}  // namespace plumescout
