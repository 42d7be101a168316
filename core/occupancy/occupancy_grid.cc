// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/occupancy_grid.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/grid/padded.h"
#include "core/types/error_reason.h"
#include "core/types/map_tiles.h"
#include "core/types/prior_map.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr double kRounding_cells = 1e-9;

float LogOdds(double probability) {
  return static_cast<float>(std::log(probability / (1.0 - probability)));
}

TileSpan SpanOf(double origin_m, double resolution_m, int cells) {
  const double tile_m = OccupancyGrid::kTileCells * resolution_m;
  const std::int64_t begin = std::llround(origin_m / tile_m);
  return {begin, begin + cells / OccupancyGrid::kTileCells};
}

// `raster` on a larger lattice, its cell (0, 0) at `shift`.
template <typename T>
Grid<T> Moved(const Grid<T>& raster, const GridGeometry& geometry, Cell shift, T fill) {
  Grid<T> moved(geometry, fill);
  for (int row = 0; row < raster.height(); ++row) {
    std::copy_n(GridRow(raster, row), raster.width(), GridRow(moved, row + shift.y) + shift.x);
  }
  return moved;
}

}  // namespace

OccupancyGrid::OccupancyGrid(const OccupancyOptions& options)
    : options_(options),
      free_log_odds_(LogOdds(options.free_threshold_probability)),
      occupied_log_odds_(LogOdds(options.occupied_threshold_probability)) {
  GridGeometry empty;
  empty.resolution_m = options.resolution_m;
  log_odds_ = Grid<float>(empty);
  states_ = Grid<CellState>(empty);
}

absl::Status OccupancyGrid::GrowToContain(Point2 min, Point2 max) {
  const bool finite = std::isfinite(min.x_m) && std::isfinite(min.y_m) && std::isfinite(max.x_m) &&
                      std::isfinite(max.y_m);
  if (!finite || min.x_m > max.x_m || min.y_m > max.y_m) {
    return absl::InvalidArgumentError("the rectangle to map is not finite or min > max");
  }
  const GridGeometry& old = geometry();
  const double resolution_m = options_.resolution_m;
  const GridGeometry lattice = {0.0, 0.0, resolution_m, 0, 0};
  const Cell first = lattice.CellAt(min);
  const Cell last = lattice.CellAt(max);
  const TileSpan old_x = SpanOf(old.origin_x_m, resolution_m, old.width);
  const TileSpan old_y = SpanOf(old.origin_y_m, resolution_m, old.height);
  const TileSpan x = TilesAround(old_x, first.x, last.x);
  const TileSpan y = TilesAround(old_y, first.y, last.y);
  if (x.cells() == old.width && y.cells() == old.height) return absl::OkStatus();

  // Counted in cells, so that an extent of whole tiles is not lost to rounding.
  const auto widest = static_cast<double>(std::max(x.cells(), y.cells()));
  if (widest > options_.max_extent_m / resolution_m + kRounding_cells ||
      x.cells() * y.cells() > options_.max_cell_count) {
    return absl::ResourceExhaustedError(
        absl::StrCat("a map of ", x.cells(), " x ", y.cells(), " cells exceeds max_extent_m = ",
                     options_.max_extent_m, " or max_cell_count = ", options_.max_cell_count));
  }
  if (x.cells() * y.cells() > cell_limit_) {
    return TypedError(
        absl::StatusCode::kResourceExhausted, reason::kBudgetReached,
        absl::StrCat("a map of ", x.cells(), " x ", y.cells(),
                     " cells exceeds what memory_budget_bytes leaves, ", cell_limit_, " cells"));
  }
  const double tile_m = kTileCells * resolution_m;
  const GridGeometry grown = {static_cast<double>(x.begin) * tile_m,
                              static_cast<double>(y.begin) * tile_m, resolution_m,
                              static_cast<int>(x.cells()), static_cast<int>(y.cells())};
  const Cell shift = {static_cast<int>((old_x.begin - x.begin) * kTileCells),
                      static_cast<int>((old_y.begin - y.begin) * kTileCells)};
  log_odds_ = Moved(log_odds_, grown, shift, 0.0F);
  states_ = Moved(states_, grown, shift, CellState::kUnknown);
  return absl::OkStatus();
}

absl::Status OccupancyGrid::Learn(const Grid<CellState>& map) {
  PLUMESCOUT_RETURN_IF_ERROR(ValidatePriorMap(map, options_));
  const Cell first = LatticeCell(map.geometry(), options_.resolution_m);
  const GridGeometry lattice = {0.0, 0.0, options_.resolution_m, 0, 0};
  PLUMESCOUT_RETURN_IF_ERROR(
      GrowToContain(lattice.Center(first),
                    lattice.Center({first.x + map.width() - 1, first.y + map.height() - 1})));
  const Cell shift = geometry().CellAt(lattice.Center(first));
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i] == CellState::kUnknown) continue;
    const Cell cell = map.geometry().CellAtIndex(i);
    const double sign = map[i] == CellState::kOccupied ? 1.0 : -1.0;
    const std::size_t index = geometry().Index({cell.x + shift.x, cell.y + shift.y});
    log_odds_[index] = 0.0F;
    Add(index, sign * options_.clamp_log_odds);
  }
  return absl::OkStatus();
}

double OccupancyGrid::Probability(Cell cell) const {
  return 1.0 / (1.0 + std::exp(-static_cast<double>(log_odds_.At(cell, 0.0F))));
}

}  // namespace plumescout
