// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_snapshot.h"

#include "absl/status/status.h"
#include "core/gas/field/cell_input.h"
#include "core/gas/field/inverse_columns.h"
#include "core/linalg/dense_kernel.h"

namespace plumescout {
namespace {

// diag(Z_C (1 / precision + Z_CC)^-1 Z_C^T) for the cells C in `slots`: with L L^T the matrix in
// the middle, the rows of Z_C L^-T squared and summed. Mixed before they are continued off the
// paths, the columns need no product over all cells.
void SubtractGain(InverseColumns columns, std::span<const Slot> slots, double precision,
                  double limit_ppm2, std::vector<double>& variance_ppm2) {
  const std::size_t size = slots.size();
  const std::size_t stride = PaddedRows(size);
  std::vector<double> matrix(stride * size, 0.0);
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t i = j; i < size; ++i) matrix[j * stride + i] = columns.At(slots[i], j);
    matrix[j * stride + j] += 1.0 / precision;
  }
  FactorizeFront(matrix.data(), stride, size, size);
  std::vector<double> inverse(stride * size, 0.0);
  InvertLower(matrix.data(), stride, size, inverse.data(), stride);
  columns.Mix(inverse.data(), stride);
  columns.SubtractSquares(limit_ppm2, variance_ppm2);
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
  std::vector<double> variance_ppm2(tree.cells());
  for (Slot slot = 0; slot < variance_ppm2.size(); ++slot) {
    variance_ppm2[tree.cell(slot)] = variance_ppm2_[slot];
  }
  if (!slots.empty()) {
    SubtractGain(InverseColumns(factor_, slots), slots, precision, tolerance_ppm2_, variance_ppm2);
  }
  return variance_ppm2;
}

}  // namespace plumescout
