// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/offset_estimate.h"

#include <cmath>

#include "core/linalg/dense_kernel.h"

namespace plumescout {
namespace {

// A square matrix by columns that lie PaddedRows apart.
struct DenseSquare {
  explicit DenseSquare(std::size_t rows)
      : size(rows), stride(PaddedRows(rows)), values(stride * rows, 0.0) {}

  double& At(std::size_t row, std::size_t column) { return values[column * stride + row]; }
  double At(std::size_t row, std::size_t column) const { return values[column * stride + row]; }

  std::size_t size;
  std::size_t stride;
  std::vector<double> values;
};

bool IsActive(const FieldEngine& field, std::size_t cell) { return field.input(cell).active; }

// W, column by column, by lattice cell.
std::vector<std::vector<double>> Reach(const FieldEngine& field,
                                       std::span<const OffsetColumn> columns) {
  std::vector<std::vector<double>> reach;
  std::vector<double> right_side;
  for (const OffsetColumn& column : columns) {
    right_side.assign(field.cells(), 0.0);
    for (const SensorEvidence& e : column.cells) right_side[e.cell] = e.evidence.precision;
    reach.push_back(field.Solve(right_side));
  }
  return reach;
}

// The lower triangle of S, and h_b - G^T m.
struct Normal {
  DenseSquare matrix;
  std::vector<double> right_side;
};
Normal NormalOf(const FieldEngine& field, std::span<const OffsetColumn> columns,
                const std::vector<std::vector<double>>& reach) {
  Normal normal{DenseSquare(columns.size()), std::vector<double>(columns.size(), 0.0)};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    normal.matrix.At(k, k) = columns[k].prior_precision_per_ppm2;
    for (const SensorEvidence& e : columns[k].cells) {
      if (!IsActive(field, e.cell)) continue;
      const auto& [precision, weighted_deviation, weighted_square, count] = e.evidence;
      normal.matrix.At(k, k) += precision;
      normal.right_side[k] += weighted_deviation - precision * field.mean_ppm(e.cell);
      for (std::size_t j = 0; j <= k; ++j) normal.matrix.At(k, j) -= precision * reach[j][e.cell];
    }
  }
  return normal;
}

// L^-1 with S = L L^T, which is positive definite: a Schur complement of the joint precision.
DenseSquare InverseFactor(DenseSquare matrix) {
  FactorizeFront(matrix.values.data(), matrix.stride, matrix.size, matrix.size);
  DenseSquare inverse(matrix.size);
  InvertLower(matrix.values.data(), matrix.stride, matrix.size, inverse.values.data(),
              inverse.stride);
  return inverse;
}

}  // namespace

OffsetEstimate EstimateOffsets(const FieldEngine& field, std::span<const OffsetColumn> columns) {
  const std::size_t size = columns.size();
  const std::vector<std::vector<double>> reach = Reach(field, columns);
  const Normal normal = NormalOf(field, columns, reach);
  const DenseSquare factor = InverseFactor(normal.matrix);
  std::vector<double> whitened(size, 0.0);  // L^-1 (h_b - G^T m)
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t j = 0; j <= k; ++j) whitened[k] += factor.At(k, j) * normal.right_side[j];
  }
  OffsetEstimate estimate;
  for (const double part : whitened) estimate.explained += part * part;
  estimate.offset_ppm.assign(size, 0.0);
  estimate.stddev_ppm.assign(size, 0.0);
  for (std::size_t j = 0; j < size; ++j) {
    double variance_ppm2 = 0.0;
    for (std::size_t k = j; k < size; ++k) {
      estimate.offset_ppm[j] += factor.At(k, j) * whitened[k];
      variance_ppm2 += factor.At(k, j) * factor.At(k, j);
    }
    estimate.stddev_ppm[j] = std::sqrt(variance_ppm2);
  }
  estimate.mean_ppm.assign(field.cells(), 0.0);
  estimate.variance_ppm2.assign(field.cells(), 0.0);
  for (std::size_t cell = 0; cell < field.cells(); ++cell) {
    if (!IsActive(field, cell)) continue;
    for (std::size_t k = 0; k < size; ++k) {
      double row = 0.0;  // of L^-1 W_i^T
      for (std::size_t j = 0; j <= k; ++j) row += factor.At(k, j) * reach[j][cell];
      estimate.mean_ppm[cell] -= row * whitened[k];
      estimate.variance_ppm2[cell] += row * row;
    }
  }
  return estimate;
}

}  // namespace plumescout
