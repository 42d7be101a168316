// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_snapshot.h"

#include <algorithm>

#include "absl/status/status.h"
#include "core/gas/field/cell_input.h"
#include "core/linalg/dense_kernel.h"

namespace plumescout {
namespace {

constexpr std::size_t kRowsAtOnce = 512;  // of a product, so that its columns stay in cache
constexpr std::size_t kColumnsAtOnce = 4;

// L^-1 with L L^T = 1 / precision + Z_CC for the cells C of the columns `z`; column-major.
std::vector<double> WhitenReadings(const SlotColumns& z, std::span<const Slot> slots,
                                   double precision) {
  const std::size_t size = slots.size();
  const std::size_t stride = PaddedRows(size);
  std::vector<double> matrix(stride * size, 0.0);
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t i = j; i < size; ++i) matrix[j * stride + i] = z.column(j)[slots[i]];
    matrix[j * stride + j] += 1.0 / precision;
  }
  FactorizeFront(matrix.data(), stride, size, size);
  std::vector<double> inverse(stride * size);
  InvertLower(matrix.data(), stride, size, inverse.data(), stride);
  return inverse;
}

// variance -= diag(Z_C (1 / precision + Z_CC)^-1 Z_C^T) = rows of Z_C L^-T, squared and summed.
void SubtractGain(const SlotColumns& z, std::span<const Slot> slots, double precision,
                  std::vector<double>& variance_ppm2) {
  const std::vector<double> whitening = WhitenReadings(z, slots, precision);
  const std::size_t stride = PaddedRows(slots.size());
  std::vector<double> gain(kRowsAtOnce * kColumnsAtOnce);
  for (std::size_t row = 0; row < variance_ppm2.size(); row += kRowsAtOnce) {
    const std::size_t rows = std::min(kRowsAtOnce, variance_ppm2.size() - row);
    for (std::size_t first = 0; first < slots.size(); first += kColumnsAtOnce) {
      const std::size_t columns = std::min(kColumnsAtOnce, slots.size() - first);
      std::fill(gain.begin(), gain.end(), 0.0);
      Accumulate({.a = z.column(0) + row,
                  .a_stride = z.stride(),
                  .b = whitening.data() + first,
                  .b_row_stride = stride,
                  .b_column_stride = 1,
                  .c = gain.data(),
                  .c_stride = kRowsAtOnce,
                  .rows = rows,
                  .columns = columns,
                  .depth = first + columns});
      for (std::size_t j = 0; j < columns; ++j) {
        const double* const column = gain.data() + j * kRowsAtOnce;
        for (std::size_t i = 0; i < rows; ++i) variance_ppm2[row + i] -= column[i] * column[i];
      }
    }
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
  if (!slots.empty()) {
    const SlotColumns z = CovarianceColumns(factor_, pending_, slots);
    SubtractGain(z, slots, precision, variance_ppm2);
  }
  std::vector<double> by_cell(tree.cells());
  for (Slot slot = 0; slot < by_cell.size(); ++slot) {
    by_cell[tree.cell(slot)] = variance_ppm2[slot];
  }
  return by_cell;
}

}  // namespace plumescout
