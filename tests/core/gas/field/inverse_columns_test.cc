// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/inverse_columns.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <optional>
#include <utility>
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

std::vector<Slot> SomeSlots(const FactorCase& c, std::size_t count) {
  std::vector<Slot> slots = c.RandomActiveSlots(count);
  std::sort(slots.begin(), slots.end());
  return slots;
}

InverseColumns ColumnsOf(const FactorCase& c, const std::vector<Slot>& slots) {
  return {c.factor, ReadingPaths(c.factor, slots)};
}

// What is subtracted, by slot.
std::vector<double> Squares(InverseColumns& columns, const FactorCase& c, double limit) {
  std::vector<double> by_slot(c.tree->cells(), 0.0);
  columns.SubtractSquares(limit, by_slot);
  for (double& value : by_slot) value = -value;
  return by_slot;
}

void ExpectSquares(const std::vector<double>& by_slot, const FactorCase& c,
                   const Eigen::MatrixXd& rows) {
  for (Slot slot = 0; slot < c.tree->cells(); ++slot) {
    const double truth = c.IsActive(slot) ? rows.row(c.Variable(slot)).squaredNorm() : 0.0;
    EXPECT_NEAR(by_slot[slot], truth, 1e-10 * (1.0 + truth));  // condition below 1e5
  }
}

TEST(InverseColumnsTest, SubtractTheirSquaresFromEveryActiveCell) {
  for (const std::size_t count : {1, 2, 8, 9, 17}) {
    const FactorCase c(count);
    const std::vector<Slot> slots = SomeSlots(c, count);
    InverseColumns columns = ColumnsOf(c, slots);
    ExpectSquares(Squares(columns, c, 0.0), c, DenseColumns(c, slots));
  }
}

TEST(InverseColumnsTest, AreTheSameInTheMemoryOfOthers) {
  const FactorCase c(5);
  std::optional<InverseColumns> used;
  for (const std::size_t count : {9, 1, 17, 2}) {
    const std::vector<Slot> slots = SomeSlots(c, count);
    InverseColumns fresh = ColumnsOf(c, slots);
    InverseColumns columns(c.factor, ReadingPaths(c.factor, slots), std::move(used));
    EXPECT_EQ(Squares(columns, c, 0.0), Squares(fresh, c, 0.0));
    used = std::move(columns);
  }
}

TEST(InverseColumnsTest, MixEveryRow) {
  for (const std::size_t count : {1, 5, 9, 20}) {
    FactorCase c(3 + count);
    const std::vector<Slot> slots = SomeSlots(c, count);
    const std::size_t stride = PaddedRows(count);
    std::vector<double> matrix(stride * count, 0.0);
    const auto size = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t i = j; i < count; ++i) {
        matrix[j * stride + i] = c.rng.Uniform(-1.0, 1.0);
        dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = matrix[j * stride + i];
      }
    }
    InverseColumns columns = ColumnsOf(c, slots);
    columns.Mix(matrix, stride);
    ExpectSquares(Squares(columns, c, 0.0), c, DenseColumns(c, slots) * dense.transpose());
  }
}

TEST(InverseColumnsTest, PassOverNoCellThatHasMoreThanTheLimit) {
  const FactorCase c(4);
  InverseColumns columns = ColumnsOf(c, SomeSlots(c, 2));
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

// As in plans: many columns that from afar are much alike.
TEST(InverseColumnsTest, LeaveOutNoMoreThanTheLimitOfManyColumns) {
  for (const std::size_t count : {12, 40}) {
    const FactorCase c(count);
    InverseColumns columns = ColumnsOf(c, SomeSlots(c, count));
    const std::vector<double> all = Squares(columns, c, 0.0);
    const double greatest = *std::max_element(all.begin(), all.end());
    for (const double share : {1e-6, 1e-3, 0.3}) {
      const double limit = share * greatest;
      const std::vector<double> some = Squares(columns, c, limit);
      for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_LE(some[i], all[i] + 1e-12 * greatest);
        EXPECT_GE(some[i], all[i] - limit - 1e-12 * greatest);
      }
    }
  }
}

}  // namespace inverse_columns_test
}  // namespace plumescout
