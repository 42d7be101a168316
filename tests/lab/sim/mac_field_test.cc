// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/mac_field.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace mac_field_test {

// Rounding of a handful of operations on values around 1.
constexpr double kRounding = 1e-12;

GridGeometry ThreeByTwo() { return {1.0, 2.0, 0.5, 3, 2}; }

// u grows east, v falls north at the same rate: divergence-free.
MacField Stretching() {
  MacField field(ThreeByTwo());
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x <= 3; ++x) field.u(x, y) = x;
  }
  for (int y = 0; y <= 2; ++y) {
    for (int x = 0; x < 3; ++x) field.v(x, y) = -y;
  }
  return field;
}

TEST(MacFieldTest, CountsWhatFlowsOutOfACell) {
  MacField field = Stretching();
  EXPECT_EQ(field.NetOutflow_mps({1, 1}), 0.0);
  field.u(2, 1) += 0.25;
  EXPECT_EQ(field.NetOutflow_mps({1, 1}), 0.25);
  EXPECT_EQ(field.NetOutflow_mps({2, 1}), -0.25);
}

TEST(MacFieldTest, AveragesFacesAtTheCentre) {
  const Velocity velocity = Stretching().AtCenter({2, 0});
  EXPECT_EQ(velocity.u_mps, 2.5);
  EXPECT_EQ(velocity.v_mps, -0.5);
}

TEST(MacFieldTest, IsLinearBetweenOppositeFaces) {
  // A quarter of a cell east of the west face of cell (1,0), half a cell north of its south face.
  const Velocity velocity = Stretching().At({1.5 + 0.125, 2.25});
  EXPECT_NEAR(velocity.u_mps, 1.25, kRounding);
  EXPECT_NEAR(velocity.v_mps, -0.5, kRounding);
}

TEST(MacFieldTest, HasNoFlowThroughAWallRightAtTheWall) {
  MacField field = Stretching();
  field.u(2, 0) = 0.0;                                         // a wall east of cell (1,0)
  EXPECT_NEAR(field.At({2.0 - 1e-9, 2.25}).u_mps, 0.0, 1e-8);  // 2e-9 of a cell off a slope of 1
}

TEST(MacFieldTest, IsAtRestOffTheRaster) {
  const Velocity velocity = Stretching().At({0.5, 2.25});
  EXPECT_EQ(velocity.u_mps, 0.0);
  EXPECT_EQ(velocity.v_mps, 0.0);
}

TEST(MacFieldTest, AddsScaledFields) {
  MacField field = Stretching();
  field.AddScaled(Stretching(), -0.5);
  EXPECT_EQ(field.u(3, 1), 1.5);
  EXPECT_EQ(field.v(0, 2), -1.0);
}

TEST(MacFieldTest, FindsTheFastestFaceOfEachDirection) {
  const Velocity largest = Stretching().MaxMagnitudes();
  EXPECT_EQ(largest.u_mps, 3.0);
  EXPECT_EQ(largest.v_mps, 2.0);
}

TEST(MacFieldTest, FindsTheFastestCell) {
  MacField field = Stretching();
  EXPECT_EQ(field.FastestCell_mps(), 3.0 + 2.0);  // cell (2,1)
  field.u(0, 0) = -7.0;
  EXPECT_EQ(field.FastestCell_mps(), 7.0 + 1.0);  // cell (0,0)
}

TEST(MacFieldTest, NumbersItsFacesInOneRow) {
  MacField field = Stretching();
  ASSERT_EQ(field.values().size(), 4u * 2u + 3u * 3u);
  field.values()[field.UFace(3, 1)] = 5.0;
  field.values()[field.VFace(2, 2)] = 6.0;
  EXPECT_EQ(field.u(3, 1), 5.0);
  EXPECT_EQ(field.v(2, 2), 6.0);
}

}  // namespace mac_field_test
}  // namespace plumescout::lab
