// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/memory_estimate.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/gas/epoch_schedule.h"
#include "core/gas/field_bytes.h"
#include "core/gas/field_region.h"
#include "core/types/error_reason.h"
#include "core/types/map_tiles.h"
#include "core/types/prior_map.h"
#include "core/types/species.h"

namespace plumescout {
namespace {

constexpr std::int64_t kEighths = 8;
constexpr std::int64_t kFieldEighths = 5;
constexpr std::int64_t kRestEighths = 7;

// Cells of the map, in whole tiles, that the known one lies on.
std::int64_t MapCells(const Grid<CellState>& known, double resolution_m) {
  const Cell corner = LatticeCell(known.geometry(), resolution_m);
  return TilesAround({}, corner.x, std::int64_t{corner.x} + known.width() - 1).cells() *
         TilesAround({}, corner.y, std::int64_t{corner.y} + known.height() - 1).cells();
}

// Of the field at first, on the full lattice.
struct FirstCells {
  std::int64_t active = 0;
  std::int64_t lattice = 0;
};

FirstCells FirstField(const MissionOptions& options) {
  const Grid<CellState>& known = *options.prior_map;
  FirstCells cells;
  cells.active = std::count(known.values().begin(), known.values().end(), CellState::kFree);
  std::int64_t width = known.width();
  std::int64_t height = known.height();
  if (!CountsAsVisited(known.geometry(), options.gas)) {
    const FieldRegion region(options.gas.field_reach_m, options.occupancy.resolution_m);
    const std::int64_t around = region.TilesAround() * kMapTileCells * kMapTileCells;
    cells.active = std::min(cells.active, around);
    width = std::min(width, region.WidestAround_cells());
    height = std::min(height, region.WidestAround_cells());
  }
  const std::int64_t margin =
      EpochSchedule::Margin_cells({{0, 0}, {static_cast<int>(width), static_cast<int>(height)}});
  cells.lattice = (width + 2 * margin) * (height + 2 * margin);
  return cells;
}

std::int64_t BytesOn(const FirstCells& full, int factor) {
  const std::int64_t area = std::int64_t{factor} * factor;
  return FieldBytes((full.active + area - 1) / area, (full.lattice + area - 1) / area);
}

}  // namespace

std::int64_t ReadingBytes(const ReadingStore& readings) {
  return kReadingSiteBytes * static_cast<std::int64_t>(readings.sites() + readings.arrivals()) +
         kReadingBucketBytes *
             static_cast<std::int64_t>(readings.buckets() + readings.arrival_buckets());
}

std::int64_t RoomForField_bytes(std::int64_t budget_bytes, const MemoryUse& use) {
  return std::min(budget_bytes / kEighths * kFieldEighths, budget_bytes - use.BesideField_bytes());
}

std::int64_t RoomBesideField_bytes(std::int64_t budget_bytes, const MemoryUse& use) {
  return std::min(budget_bytes / kEighths * kRestEighths, budget_bytes - use.field_bytes) -
         use.BesideField_bytes();
}

absl::Status BudgetReached(absl::string_view message) {
  return TypedError(absl::StatusCode::kResourceExhausted, reason::kBudgetReached, message);
}

bool CountsAsVisited(const GridGeometry& known, const GasOptions& options) {
  const double most_m = 2.0 * options.field_reach_m;
  return options.field_reach_m == 0.0 ||
         std::max(known.width, known.height) * known.resolution_m <= most_m;
}

absl::StatusOr<MissionOptions> FitToBudget(const MissionOptions& options) {
  if (options.prior_map == nullptr) return options;
  const std::int64_t budget_bytes = options.memory_budget_bytes;
  MemoryUse use;
  use.species = static_cast<std::int64_t>(SpeciesCount(options));
  use.map_cells = MapCells(*options.prior_map, options.occupancy.resolution_m);
  if (RoomBesideField_bytes(budget_bytes, use) < 0) {
    return BudgetReached(absl::StrCat("prior_map takes ", use.BesideField_bytes(),
                                      " bytes beside its gas field, too much of "
                                      "memory_budget_bytes = ",
                                      budget_bytes));
  }
  MissionOptions fitted = options;
  const FirstCells full = FirstField(options);
  int& factor = fitted.gas.lattice_factor;
  const std::int64_t room_bytes = RoomForField_bytes(budget_bytes, use) / use.species;  // for each
  while (BytesOn(full, factor) > room_bytes && 2 * factor <= kMostLatticeFactor) factor *= 2;
  if (BytesOn(full, factor) <= room_bytes) return fitted;
  return BudgetReached(absl::StrCat("the gas field of prior_map takes ", BytesOn(full, factor),
                                    " bytes on the coarsest lattice, gas.lattice_factor = ", factor,
                                    "; memory_budget_bytes = ", budget_bytes, " leaves ",
                                    room_bytes));
}

}  // namespace plumescout
