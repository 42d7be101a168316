// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_what_if.h"

#include <cstddef>
#include <limits>
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
  return OnMap(variance_ppm2);
}

absl::StatusOr<std::optional<InverseColumns>> GasWhatIf::ColumnsIfRead(std::span<const Cell> cells,
                                                                       double precision,
                                                                       const StopFn& stop) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<std::size_t> read, FreeIndices(cells));
  return field_.ColumnsIfRead(read, precision, stop);
}

EntropyFall GasWhatIf::FallOf(std::span<const float> weights, const StopFn& stop) const {
  std::vector<double> by_lattice_cell(lattice_.size(), 0.0);
  const auto add = [&](std::size_t i, AnchorCell cell) {
    by_lattice_cell[FieldIndex(cell)] += weights[i];
  };
  states_.ForEachFree(add, stop);
  return field_.FallOf(by_lattice_cell, beside_ppm2_, stop);
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

Grid<float> GasWhatIf::OnMap(const std::vector<double>& by_lattice_cell, const StopFn& stop) const {
  Grid<float> result(geometry(), std::numeric_limits<float>::quiet_NaN());
  const auto write = [&](std::size_t i, AnchorCell cell) {
    const std::size_t index = FieldIndex(cell);
    const double beside_ppm2 = beside_ppm2_.empty() ? 0.0 : beside_ppm2_[index];
    result[i] = static_cast<float>(prior_scale_ * (by_lattice_cell[index] + beside_ppm2));
  };
  states_.ForEachFree(write, stop);
  return result;
}

}  // namespace plumescout
