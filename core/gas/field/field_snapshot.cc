// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_snapshot.h"

#include <algorithm>
#include <utility>

#include "absl/status/status.h"
#include "core/gas/field/cell_input.h"
#include "core/linalg/dense_kernel.h"

namespace plumescout {
namespace {

// L^-T with L L^T = 1 / precision + Z_CC for the cells C in `slots`; by rows.
std::vector<double> WhitenReadings(const SlotColumns& columns, std::span<const Slot> slots,
                                   double precision) {
  const std::size_t size = slots.size();
  const std::size_t stride = PaddedRows(size);
  std::vector<double> matrix(stride * size, 0.0);
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t i = j; i < size; ++i) matrix[j * stride + i] = columns.row(slots[i])[j];
    matrix[j * stride + j] += 1.0 / precision;
  }
  FactorizeFront(matrix.data(), stride, size, size);
  std::vector<double> inverse(stride * size);
  InvertLower(matrix.data(), stride, size, inverse.data(), stride);
  std::vector<double> transposed;  // L^-1 by columns is L^-T by rows
  for (std::size_t j = 0; j < size; ++j) {
    const double* const column = inverse.data() + j * stride;
    transposed.insert(transposed.end(), column, column + size);
  }
  return transposed;
}

// Combines the columns so far by `mixing`, by rows.
void Mix(const SeparatorTree& tree, std::span<const double> mixing, PathColumns& columns) {
  const std::size_t size = columns.values.columns();
  std::vector<double> mixed(size);
  for (const std::uint32_t node : columns.path_nodes) {
    for (Slot slot = tree.nodes()[node].first; slot < tree.nodes()[node].end; ++slot) {
      double* const row = columns.values.row(slot);
      std::fill(mixed.begin(), mixed.end(), 0.0);
      for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = 0; j < size; ++j) mixed[j] += row[i] * mixing[i * size + j];
      }
      std::copy(mixed.begin(), mixed.end(), row);
    }
  }
}

// diag(Z_C (1 / precision + Z_CC)^-1 Z_C^T), which are the rows of Z_C L^-T squared and summed.
// Mixed before they are continued off the paths, the columns need no product over all cells.
void SubtractGain(const FieldFactor& factor, std::span<const Slot> slots, double precision,
                  std::vector<double>& variance_ppm2) {
  PathColumns on_paths = factor.InverseOnPaths(slots);
  const std::vector<double> mixing = WhitenReadings(on_paths.values, slots, precision);
  Mix(factor.tree(), mixing, on_paths);
  const SlotColumns columns = factor.Extend(std::move(on_paths));
  for (Slot slot = 0; slot < variance_ppm2.size(); ++slot) {
    const double* const row = columns.row(slot);
    variance_ppm2[slot] -= Dot(row, row, columns.columns());
  }
}

}  // namespace

absl::StatusOr<std::vector<double>> FieldSnapshot::VarianceIfRead(
    std::span<const std::size_t> cells, double precision) const {
  const SeparatorTree& tree = factor_.tree();
  if (!(precision > 0.0) || precision > kMaxCellPrecision) {
    return absl::InvalidArgumentError("the precision of a reading is out of range");
  }
  std::vector<Slot> slots;
  for (const std::size_t cell : cells) {
    if (cell >= tree.cells()) return absl::InvalidArgumentError("a cell lies beyond the lattice");
    const Slot slot = tree.slot(cell);
    if (variance_ppm2_[slot] > 0.0) slots.push_back(slot);  // not NaN: active
  }
  std::vector<double> variance_ppm2 = variance_ppm2_;
  if (!slots.empty()) SubtractGain(factor_, slots, precision, variance_ppm2);
  std::vector<double> by_cell(tree.cells());
  for (Slot slot = 0; slot < by_cell.size(); ++slot) {
    by_cell[tree.cell(slot)] = variance_ppm2[slot];
  }
  return by_cell;
}

}  // namespace plumescout
