// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "absl/status/statusor.h"
#include "core/types/grid_geometry.h"
#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

// Where the sites of a region lie: row by row from its lower left corner, each in the middle of a
// square. Site (column, row) has index row * columns + column.
struct SiteLattice {
  Point2 corner;  // lower left, of square (0, 0)
  double spacing_m = 1.0;
  int columns = 0;
  int rows = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  Point2 Place(std::size_t index) const {
    constexpr double kMiddle = 0.5;
    const auto width = static_cast<std::size_t>(columns);
    return {corner.x_m + (static_cast<double>(index % width) + kMiddle) * spacing_m,
            corner.y_m + (static_cast<double>(index / width) + kMiddle) * spacing_m};
  }
};

// Most sites a region may have.
inline constexpr double kMaxSites = 1e6;

// Errors: kInvalidArgument naming field and value if the region is not whole multiples of the
// spacing wide and high, or has more than kMaxSites.
absl::StatusOr<SiteLattice> MakeSiteLattice(const Rectangle& region, double spacing_m);

// The squares that a map reaches, with corners on whole multiples of the spacing from (0, 0) of
// frame map: sites stay where they are while the map grows.
SiteLattice CoveringLattice(const GridGeometry& map, double spacing_m);

// The one of the region, or without a region the one that covers the map. REQUIRES: a region that
// MakeSiteLattice takes.
SiteLattice LatticeOver(const GridGeometry& map, const SiteOptions& options);

// The squares of `spacing_m` that cover the building, and as many beyond it in the north and east
// as it takes for a survey of every stride-th site to have the last row and column.
Rectangle RegionOver(const GridGeometry& building, double spacing_m, int stride);

}  // namespace plumescout
