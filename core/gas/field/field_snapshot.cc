// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_snapshot.h"

#include <algorithm>
#include <utility>

#include "absl/status/status.h"
#include "core/gas/field/cell_input.h"
#include "core/linalg/dense_kernel.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

absl::Status Cancelled() { return absl::CancelledError("told to stop"); }

absl::Status CheckReading(const SeparatorTree& tree, const ForeseenReading& reading) {
  if (!(reading.precision > 0.0) || reading.precision > kMaxCellPrecision) {
    return absl::InvalidArgumentError("the precision of a reading is out of range");
  }
  if (reading.cell >= tree.cells()) {
    return absl::InvalidArgumentError("a cell lies beyond the lattice");
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<FieldSnapshot::Foreseen> FieldSnapshot::ActiveOf(
    std::span<const ForeseenReading> readings) const {
  std::vector<std::pair<Slot, double>> active;
  for (const ForeseenReading& reading : readings) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckReading(factor_.tree(), reading));
    const Slot slot = factor_.tree().slot(reading.cell);
    if (IsActive(slot)) active.emplace_back(slot, 1.0 / reading.precision);
  }
  std::sort(active.begin(), active.end());
  Foreseen foreseen;
  for (const auto& [slot, noise_ppm2] : active) {
    foreseen.slots.push_back(slot);
    foreseen.noise_ppm2.push_back(noise_ppm2);
  }
  return foreseen;
}

// diag(Z_C (N + Z_CC)^-1 Z_C^T) for the cells C that are read and the noise N: with L L^T the
// matrix in the middle, the rows of Z_C L^-T squared and summed. Mixed before they are continued
// off the paths, the columns need no product over all cells.
// kCancelled once `stop`, which is asked all along, says so. REQUIRES: some are read.
absl::StatusOr<InverseColumns> FieldSnapshot::GainColumns(
    const Foreseen& readings, const StopFn& stop, std::optional<InverseColumns> used) const {
  std::optional<ReadingPaths> used_paths;
  if (used) used_paths = (*std::move(used)).TakePaths();
  ReadingPaths paths(factor_, readings.slots, stop, std::move(used_paths));
  if (Stops(stop)) return Cancelled();
  const std::size_t size = readings.slots.size();
  const std::size_t stride = PaddedRows(size);
  const ReadingPaths::Step& root = paths.steps().back();
  std::vector<double> matrix(stride * size, 0.0);
  for (std::size_t j = 0; j < size; ++j) {
    std::copy_n(root.among + j * root.stride() + j, size - j, matrix.data() + j * stride + j);
    matrix[j * stride + j] += readings.noise_ppm2[j];
  }
  FactorizeFront(matrix.data(), stride, size, size);
  std::vector<double> inverse(stride * size, 0.0);
  InvertLower(matrix.data(), stride, size, inverse.data(), stride);
  InverseColumns columns(factor_, std::move(paths), std::move(used));
  columns.Mix(std::move(inverse), stride);
  return columns;
}

absl::StatusOr<std::vector<double>> FieldSnapshot::VarianceIfRead(
    std::span<const std::size_t> cells, double precision) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::optional<InverseColumns> columns,
                              ColumnsIfRead(cells, precision));
  if (!columns) return variance_ppm2();
  std::vector<double> variance = variance_ppm2_;
  columns->SubtractSquares(tolerance_ppm2_, variance);
  return ByCell(variance, {});
}

absl::StatusOr<std::optional<InverseColumns>> FieldSnapshot::ColumnsIfRead(
    std::span<const std::size_t> cells, double precision, const StopFn& stop,
    std::optional<InverseColumns> used) const {
  std::vector<ForeseenReading> readings;
  for (const std::size_t cell : cells) readings.push_back({cell, precision});
  if (readings.empty()) PLUMESCOUT_RETURN_IF_ERROR(CheckReading(factor_.tree(), {0, precision}));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Foreseen foreseen, ActiveOf(readings));
  if (foreseen.slots.empty()) return std::nullopt;
  PLUMESCOUT_ASSIGN_OR_RETURN(InverseColumns columns, GainColumns(foreseen, stop, std::move(used)));
  return columns;
}

EntropyFall FieldSnapshot::FallOf(std::vector<double> weights, std::span<const double> beside_ppm2,
                                  const StopFn& stop) const {
  if (beside_ppm2.empty()) {
    return {factor_, std::span(variance_ppm2_), std::move(weights), tolerance_ppm2_};
  }
  std::vector<double> variance_ppm2 = variance_ppm2_;
  InPieces(beside_ppm2.size(), stop, [&](std::size_t first, std::size_t end) {
    for (std::size_t cell = first; cell < end; ++cell) {
      variance_ppm2[slot(cell)] += beside_ppm2[cell];
    }
  });
  return {factor_, std::move(variance_ppm2), std::move(weights), tolerance_ppm2_};
}

absl::StatusOr<FieldSnapshot> FieldSnapshot::Given(std::span<const ForeseenReading> readings,
                                                   const StopFn& stop) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Foreseen foreseen, ActiveOf(readings));
  if (Stops(stop)) return Cancelled();
  FieldSnapshot given = *this;
  if (foreseen.slots.empty()) return given;
  PLUMESCOUT_ASSIGN_OR_RETURN(InverseColumns columns, GainColumns(foreseen, stop));
  columns.SubtractSquares(tolerance_ppm2_, given.variance_ppm2_, stop);
  given.factor_.AddForeseen(columns.paths(), foreseen.noise_ppm2, stop);
  if (Stops(stop)) return Cancelled();
  return given;
}

std::vector<double> FieldSnapshot::variance_ppm2(const StopFn& stop) const {
  return ByCell(variance_ppm2_, stop);
}

std::vector<double> FieldSnapshot::ByCell(const std::vector<double>& by_slot,
                                          const StopFn& stop) const {
  const SeparatorTree& tree = factor_.tree();
  std::vector<double> by_cell(tree.cells());
  InPieces(by_cell.size(), stop, [&](std::size_t first, std::size_t end) {
    for (auto slot = static_cast<Slot>(first); slot < end; ++slot) {
      by_cell[tree.cell(slot)] = by_slot[slot];
    }
  });
  return by_cell;
}

}  // namespace plumescout
