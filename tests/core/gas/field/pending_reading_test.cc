// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/pending_reading.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/core/gas/field/factor_case.h"

namespace plumescout {
namespace {

using ::plumescout::testing::FactorCase;

// Readings of 5 ppm^-2 in `slots`, one after the other, told of nothing but the dense inverse.
PendingReadings ReadingsOf(const FactorCase& c, const std::vector<Slot>& slots,
                           Eigen::MatrixXd& covariance, Eigen::VectorXd& mean_ppm) {
  constexpr double kPrecision = 5.0;
  constexpr double kConcentration_ppm = 30.0;
  PendingReadings pending;
  for (const Slot slot : slots) {
    const Eigen::VectorXd x = covariance.col(c.Variable(slot));
    const double scale = 1.0 / (1.0 + kPrecision * x(c.Variable(slot)));
    const double mean_factor =
        kPrecision * (kConcentration_ppm - mean_ppm(c.Variable(slot))) * scale;
    SlotColumns column(c.tree->cells(), 1);
    for (Slot i = 0; i < c.tree->cells(); ++i) {
      if (c.IsActive(i)) *column.row(i) = x(c.Variable(i));
    }
    pending.push_back(std::make_shared<PendingReading>(
        PendingReading{slot, std::move(column), kPrecision * scale, mean_factor}));
    covariance -= kPrecision * scale * x * x.transpose();
    mean_ppm += mean_factor * x;
  }
  return pending;
}

TEST(PendingReadingTest, CorrectsMixedColumns) {
  const FactorCase c(1);
  Eigen::MatrixXd covariance = c.inverse;
  Eigen::VectorXd mean_ppm = c.mean_ppm;
  const PendingReadings pending = ReadingsOf(c, c.RandomActiveSlots(4), covariance, mean_ppm);
  const std::vector<Slot> slots = c.RandomActiveSlots(2);
  const std::vector<double> mixing = {1.0, -2.0, 0.5, 3.0};
  PathColumns on_paths = c.factor.InverseOnPaths(slots);
  SlotColumns columns = c.factor.Extend(std::move(on_paths));
  for (Slot i = 0; i < c.tree->cells(); ++i) {
    double* const row = columns.row(i);
    const double first = row[0] * mixing[0] + row[1] * mixing[2];
    row[1] = row[0] * mixing[1] + row[1] * mixing[3];
    row[0] = first;
  }
  CorrectColumns(pending, slots, mixing, columns);
  const Eigen::VectorXd a = covariance.col(c.Variable(slots[0]));
  const Eigen::VectorXd b = covariance.col(c.Variable(slots[1]));
  for (Slot i = 0; i < c.tree->cells(); ++i) {
    if (!c.IsActive(i)) continue;
    const Eigen::Index v = c.Variable(i);
    EXPECT_NEAR(columns.row(i)[0], a(v) * mixing[0] + b(v) * mixing[2], 1e-10);
    EXPECT_NEAR(columns.row(i)[1], a(v) * mixing[1] + b(v) * mixing[3], 1e-10);
  }
}

TEST(PendingReadingTest, CorrectsTheMeanOfACell) {
  const FactorCase c(2);
  Eigen::MatrixXd covariance = c.inverse;
  Eigen::VectorXd mean_ppm = c.mean_ppm;
  const PendingReadings pending = ReadingsOf(c, c.RandomActiveSlots(4), covariance, mean_ppm);
  for (const Slot slot : c.RandomActiveSlots(10)) {
    EXPECT_NEAR(Mean_ppm(c.factor, pending, slot), mean_ppm(c.Variable(slot)), 1e-9);
  }
}

}  // namespace
}  // namespace plumescout
