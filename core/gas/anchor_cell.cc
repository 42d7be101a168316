// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/anchor_cell.h"

#include <cmath>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

bool IsWholeAndNear(double cells) {
  constexpr double kTolerance_cells = 1e-3;    // origins are sums of rounded tile sizes
  constexpr double kFarthest_cells = 1 << 29;  // half of where GridGeometry::CellAt saturates
  return std::abs(cells - std::round(cells)) <= kTolerance_cells &&
         std::abs(cells) <= kFarthest_cells;
}

}  // namespace

absl::StatusOr<AnchorCell> CornerOf(const GridGeometry& geometry, const GridGeometry& anchor) {
  const double x = (geometry.origin_x_m - anchor.origin_x_m) / anchor.resolution_m;
  const double y = (geometry.origin_y_m - anchor.origin_y_m) / anchor.resolution_m;
  if (geometry.resolution_m != anchor.resolution_m || !IsWholeAndNear(x) || !IsWholeAndNear(y)) {
    return absl::InvalidArgumentError(absl::StrCat(
        "gas map: lattice of ", geometry.resolution_m, " m from (", geometry.origin_x_m, ", ",
        geometry.origin_y_m, ") does not match ", anchor.resolution_m, " m from (",
        anchor.origin_x_m, ", ", anchor.origin_y_m, ")"));
  }
  return AnchorCell{static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))};
}

}  // namespace plumescout
