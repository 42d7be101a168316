// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/prior_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/map_tiles.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Map files carry decimals that went through 32-bit floats. Over the widest map, 4000 cells, this
// share adds up to a twenty-fifth of a cell.
constexpr double kSameResolution = 1e-5;
constexpr double kOnLattice_cells = 1e-3;
constexpr double kRounding_cells = 1e-9;
// Well below where GridGeometry::CellAt saturates.
constexpr double kFarthest_cells = 1 << 29;

absl::Status Refuse(absl::string_view what, double value, absl::string_view rule) {
  return absl::InvalidArgumentError(absl::StrCat("prior_map ", what, " = ", value, " ", rule));
}

absl::Status CheckOrigin(absl::string_view name, double origin_m, double resolution_m) {
  const double cells = origin_m / resolution_m;
  if (std::abs(cells) <= kFarthest_cells &&
      std::abs(cells - std::round(cells)) <= kOnLattice_cells) {
    return absl::OkStatus();
  }
  return Refuse(
      name, origin_m,
      absl::StrCat("must be a whole multiple of occupancy.resolution_m = ", resolution_m));
}

struct MapSize {
  std::int64_t width_cells = 0;
  std::int64_t height_cells = 0;
};

// In whole tiles, of the mission's map that holds this one.
MapSize SizeOnMission(const GridGeometry& geometry, double resolution_m) {
  const Cell corner = LatticeCell(geometry, resolution_m);
  return {TilesAround({}, corner.x, std::int64_t{corner.x} + geometry.width - 1).cells(),
          TilesAround({}, corner.y, std::int64_t{corner.y} + geometry.height - 1).cells()};
}

absl::Status CheckSize(const GridGeometry& geometry, const OccupancyOptions& options) {
  const MapSize size = SizeOnMission(geometry, options.resolution_m);
  const auto widest = static_cast<double>(std::max(size.width_cells, size.height_cells));
  if (widest <= options.max_extent_m / options.resolution_m + kRounding_cells &&
      size.width_cells * size.height_cells <= options.max_cell_count) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(absl::StrCat(
      "prior_map of ", geometry.width, " x ", geometry.height, " cells needs ", size.width_cells,
      " x ", size.height_cells, " in whole tiles, beyond occupancy.max_extent_m = ",
      options.max_extent_m, " or occupancy.max_cell_count = ", options.max_cell_count));
}

}  // namespace

Cell LatticeCell(const GridGeometry& geometry, double resolution_m) {
  return {static_cast<int>(std::lround(geometry.origin_x_m / resolution_m)),
          static_cast<int>(std::lround(geometry.origin_y_m / resolution_m))};
}

absl::Status ValidatePriorMap(const Grid<CellState>& map, const OccupancyOptions& options) {
  const GridGeometry& geometry = map.geometry();
  const double resolution_m = options.resolution_m;
  // Written so that NaN fails it.
  if (!(std::abs(geometry.resolution_m - resolution_m) <= kSameResolution * resolution_m)) {
    return Refuse("resolution_m", geometry.resolution_m,
                  absl::StrCat("must be occupancy.resolution_m = ", resolution_m));
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckOrigin("origin.x_m", geometry.origin_x_m, resolution_m));
  PLUMESCOUT_RETURN_IF_ERROR(CheckOrigin("origin.y_m", geometry.origin_y_m, resolution_m));
  PLUMESCOUT_RETURN_IF_ERROR(CheckSize(geometry, options));
  if (std::find(map.values().begin(), map.values().end(), CellState::kFree) == map.values().end()) {
    return absl::InvalidArgumentError(absl::StrCat("prior_map of ", map.width(), " x ",
                                                   map.height(), " cells must have a free one"));
  }
  return absl::OkStatus();
}

void StartWith(std::shared_ptr<const Grid<CellState>> map, MissionOptions& options) {
  const GridGeometry& geometry = map->geometry();
  const MapSize size = SizeOnMission(geometry, geometry.resolution_m);
  OccupancyOptions& occupancy = options.occupancy;
  occupancy.resolution_m = geometry.resolution_m;
  const auto widest = static_cast<double>(std::max(size.width_cells, size.height_cells));
  occupancy.max_extent_m = std::max(occupancy.max_extent_m, widest * geometry.resolution_m);
  occupancy.max_cell_count =
      std::max(occupancy.max_cell_count, size.width_cells * size.height_cells);
  for (const double edge_m : {geometry.origin_x_m, geometry.origin_y_m,
                              geometry.origin_x_m + geometry.width * geometry.resolution_m,
                              geometry.origin_y_m + geometry.height * geometry.resolution_m}) {
    options.pose_limit_m = std::max(options.pose_limit_m, std::abs(edge_m));
  }
  options.prior_map = std::move(map);
}

}  // namespace plumescout
