// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/field_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plumescout::lab {
namespace field_agreement_test {

Grid<float> Row(const std::vector<float>& values) {
  GridGeometry geometry;
  geometry.width = static_cast<int>(values.size());
  geometry.height = 1;
  Grid<float> grid(geometry);
  grid.values() = values;
  return grid;
}

Grid<CellState> Free(int cells) {
  GridGeometry geometry;
  geometry.width = cells;
  geometry.height = 1;
  return Grid<CellState>(geometry, CellState::kFree);
}

TEST(FieldAgreementTest, AMultipleIsFullyCorrelated) {
  const auto agreement = Compare(Row({1, 10, 100}), Row({3, 30, 300}), Free(3), 2.5);
  EXPECT_NEAR(agreement.log_correlation, 1.0, 1e-6);
  EXPECT_NEAR(agreement.mean_ratio, 3.0, 1e-6);
  EXPECT_NEAR(agreement.overlap, 2.0 / 3.0, 1e-12);
}

// ln 1, ln e, ln e^2 against ln e, ln 1, ln e^2: deviations (-1, 0, 1) and (0, -1, 1).
TEST(FieldAgreementTest, CorrelatesTheLogarithms) {
  const auto e = static_cast<float>(M_E);
  const auto agreement = Compare(Row({1, e, e * e}), Row({e, 1, e * e}), Free(3), 2.5);
  EXPECT_NEAR(agreement.log_correlation, 0.5, 1e-6);
}

TEST(FieldAgreementTest, WhatNoSensorDetectsIsAllTheSame) {
  const auto agreement = Compare(Row({0.0F, 1e-9F, 10}), Row({0.04F, 0.0F, 10}), Free(3), 2.5);
  EXPECT_NEAR(agreement.log_correlation, 1.0, 1e-9);
}

TEST(FieldAgreementTest, LooksAtFreeCellsOnly) {
  Grid<CellState> occupancy = Free(3);
  occupancy[Cell(1, 0)] = CellState::kOccupied;
  const auto agreement = Compare(Row({1, 0, 100}), Row({1, 50, 100}), occupancy, 2.5);
  EXPECT_NEAR(agreement.log_correlation, 1.0, 1e-9);
  EXPECT_EQ(agreement.overlap, 1.0);
}

TEST(FieldAgreementTest, NothingAnywhereHasNoCorrelationAndNoDisagreement) {
  const auto agreement = Compare(Row({0, 0}), Row({0, 0}), Free(2), 2.5);
  EXPECT_TRUE(std::isnan(agreement.log_correlation));
  EXPECT_EQ(agreement.overlap, 1.0);
}

}  // namespace field_agreement_test
}  // namespace plumescout::lab
