// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_what_if.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout {

absl::StatusOr<Grid<float>> GasWhatIf::VarianceIfRead(std::span<const Cell> cells,
                                                      double precision) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<std::size_t> read, FreeIndices(cells));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<double> variance_ppm2,
                              field_.VarianceIfRead(read, precision));
  return OnMap([&](std::size_t cell) { return variance_ppm2[cell]; });
}

absl::StatusOr<std::optional<InverseColumns>> GasWhatIf::ColumnsIfRead(
    std::span<const Cell> cells, double precision, const StopFn& stop,
    std::optional<InverseColumns> used) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<std::size_t> read, FreeIndices(cells));
  return field_.ColumnsIfRead(read, precision, stop, std::move(used));
}

EntropyFall GasWhatIf::FallOf(std::span<const float> weights, const CellRect& cells,
                              const StopFn& stop) const {
  std::vector<double> by_slot(lattice_.size(), 0.0);
  const auto width = static_cast<std::size_t>(cells.width());
  const auto add = [&](std::size_t, AnchorCell at) {
    const Cell cell = states_.CellAt(at);
    const auto x = static_cast<std::size_t>(cell.x - cells.min.x);
    const auto y = static_cast<std::size_t>(cell.y - cells.min.y);
    by_slot[field_.slot(FieldIndex(at))] += weights[y * width + x];
  };
  states_.ForEachFree(add, stop);
  return field_.FallOf(std::move(by_slot), beside_ppm2_, stop);
}

absl::StatusOr<std::shared_ptr<const GasWhatIf>> GasWhatIf::Given(
    std::span<const ForeseenCell> readings, const StopFn& stop) const {
  std::vector<ForeseenReading> read;
  for (const ForeseenCell& reading : readings) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<std::size_t> index, FreeIndex(reading.cell));
    if (index) read.push_back({*index, reading.precision_per_ppm2});
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(FieldSnapshot field, field_.Given(read, stop));
  return std::shared_ptr<const GasWhatIf>(new GasWhatIf(*this, std::move(field)));
}

absl::StatusOr<std::optional<std::size_t>> GasWhatIf::FreeIndex(Cell cell) const {
  const Grid<CellState>& states = states_.states();
  if (!states.Contains(cell)) {
    return absl::InvalidArgumentError(
        absl::StrCat("cell (", cell.x, ", ", cell.y, ") lies off the map"));
  }
  const std::size_t index = geometry().Index(cell);
  if (states[index] != CellState::kFree) return std::nullopt;
  return FieldIndex(states_.At(index));
}

absl::StatusOr<std::vector<std::size_t>> GasWhatIf::FreeIndices(std::span<const Cell> cells) const {
  std::vector<std::size_t> indices;
  for (const Cell cell : cells) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<std::size_t> index, FreeIndex(cell));
    if (index) indices.push_back(*index);
  }
  return indices;
}

}  // namespace plumescout
