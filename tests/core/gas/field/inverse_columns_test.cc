// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/inverse_columns.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "core/linalg/dense_kernel.h"
#include "tests/core/gas/field/factor_case.h"

namespace plumescout {
namespace inverse_columns_test {

using ::plumescout::testing::FactorCase;

// Columns of the dense inverse.
Eigen::MatrixXd DenseColumns(const FactorCase& c, const std::vector<Slot>& slots) {
  Eigen::MatrixXd columns(c.inverse.rows(), static_cast<Eigen::Index>(slots.size()));
  for (std::size_t j = 0; j < slots.size(); ++j) {
    columns.col(static_cast<Eigen::Index>(j)) = c.inverse.col(c.Variable(slots[j]));
  }
  return columns;
}

// What is subtracted, by cell.
std::vector<double> Squares(InverseColumns& columns, const FactorCase& c, double limit) {
  std::vector<double> by_cell(c.tree->cells(), 0.0);
  columns.SubtractSquares(limit, by_cell);
  for (double& value : by_cell) value = -value;
  return by_cell;
}

void ExpectSquares(const std::vector<double>& by_cell, const FactorCase& c,
                   const Eigen::MatrixXd& rows) {
  for (Slot slot = 0; slot < c.tree->cells(); ++slot) {
    const double truth = c.IsActive(slot) ? rows.row(c.Variable(slot)).squaredNorm() : 0.0;
    EXPECT_NEAR(by_cell[c.tree->cell(slot)], truth, 1e-10 * (1.0 + truth));  // condition below 1e5
  }
}

TEST(InverseColumnsTest, HoldTheInverseBetweenTheirCells) {
  const FactorCase c(1);
  const std::vector<Slot> slots = c.RandomActiveSlots(9);
  const InverseColumns columns(c.factor, slots);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = 0; j < slots.size(); ++j) {
      const double truth = c.inverse(c.Variable(slots[i]), c.Variable(slots[j]));
      EXPECT_NEAR(columns.At(slots[i], j), truth, 1e-10);
    }
  }
}

TEST(InverseColumnsTest, SubtractTheirSquaresFromEveryActiveCell) {
  for (const std::size_t count : {1, 2, 8, 9, 17}) {
    const FactorCase c(count);
    const std::vector<Slot> slots = c.RandomActiveSlots(count);
    InverseColumns columns(c.factor, slots);
    ExpectSquares(Squares(columns, c, 0.0), c, DenseColumns(c, slots));
  }
}

TEST(InverseColumnsTest, MixEveryRow) {
  constexpr std::size_t kCount = 5;
  FactorCase c(3);
  const std::vector<Slot> slots = c.RandomActiveSlots(kCount);
  const std::size_t stride = PaddedRows(kCount);
  std::vector<double> matrix(stride * kCount, 0.0);
  Eigen::MatrixXd dense(kCount, kCount);
  for (std::size_t j = 0; j < kCount; ++j) {
    for (std::size_t i = 0; i < kCount; ++i) {
      matrix[j * stride + i] = c.rng.Uniform(-1.0, 1.0);
      dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = matrix[j * stride + i];
    }
  }
  InverseColumns columns(c.factor, slots);
  columns.Mix(matrix.data(), stride);
  ExpectSquares(Squares(columns, c, 0.0), c, DenseColumns(c, slots) * dense.transpose());
}

TEST(InverseColumnsTest, PassOverNoCellThatHasMoreThanTheLimit) {
  const FactorCase c(4);
  const std::vector<Slot> slots = c.RandomActiveSlots(2);
  InverseColumns columns(c.factor, slots);
  const std::vector<double> all = Squares(columns, c, 0.0);
  std::vector<double> sorted = all;
  std::sort(sorted.begin(), sorted.end());
  const double limit = sorted[sorted.size() / 2];
  const std::vector<double> some = Squares(columns, c, limit);
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (some[i] == all[i]) continue;
    EXPECT_EQ(some[i], 0.0);
    EXPECT_LE(all[i], limit * (1.0 + 1e-12));
    ++left_out;
  }
  EXPECT_GT(left_out, 0U);
}

}  // namespace inverse_columns_test
}  // namespace plumescout
