// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/lattice_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "tests/core/gas/field/rotated_rooms.h"

namespace plumescout {
namespace lattice_lines_test {

using ::plumescout::testing::RotatedRooms;

constexpr std::size_t kWidth = 37;
constexpr std::size_t kHeight = 23;

TEST(LatticeLinesTest, LetNoStepLeapOverALine) {
  for (const auto across : {LatticeLines::Across::kX, LatticeLines::Across::kY}) {
    for (const double slope : {0.0, 0.3, -0.7, 1.0, -1.0}) {
      const LatticeLines lines(across, slope, kWidth, kHeight);
      for (std::int32_t y = 0; y < static_cast<std::int32_t>(kHeight); ++y) {
        for (std::int32_t x = 0; x < static_cast<std::int32_t>(kWidth); ++x) {
          const std::int32_t line = lines.line({x, y});
          EXPECT_GE(line, 0);
          EXPECT_LT(line, static_cast<std::int32_t>(lines.count()));
          // The first column and the first row are compared with themselves.
          EXPECT_LE(std::abs(line - lines.line({std::max(x - 1, 0), y})), 1);
          EXPECT_LE(std::abs(line - lines.line({x, std::max(y - 1, 0)})), 1);
        }
      }
    }
  }
}

TEST(LatticeLinesTest, CrossAtRightAngles) {
  // Along a line of one family x + slope y is constant, so the other's number grows by 1 + slope^2.
  constexpr double kSlope = 0.25;
  const LatticeLines x_lines(LatticeLines::Across::kX, kSlope, 200, 200);
  const LatticeLines y_lines(LatticeLines::Across::kY, kSlope, 200, 200);
  const LatticeCell from = {150, 20};
  const LatticeCell to = {120, 140};
  EXPECT_EQ(x_lines.line(from), x_lines.line(to));
  EXPECT_NEAR(y_lines.line(to) - y_lines.line(from), 120 + 30 * kSlope, 1.0);
}

TEST(WallSlopeTest, FindsTheDirectionOfABuilding) {
  constexpr std::size_t kSide = 180;
  for (const double angle_deg : {-40.0, -12.0, 7.0, 30.0, 44.0}) {
    const std::vector<std::uint8_t> active = RotatedRooms(kSide, angle_deg);
    const double slope = WallSlope(kSide, kSide, active);
    // A line of the slope found ends no more than two cells beside the wall it began in.
    EXPECT_NEAR(slope, std::tan(angle_deg * M_PI / 180.0), 2.0 / kSide) << angle_deg;
  }
}

TEST(WallSlopeTest, PrefersTheAxes) { EXPECT_EQ(WallSlope(180, 180, RotatedRooms(180, 0.0)), 0.0); }

TEST(WallSlopeTest, IsZeroWithoutWalls) {
  EXPECT_EQ(WallSlope(30, 20, std::vector<std::uint8_t>(600, 1)), 0.0);
  EXPECT_EQ(WallSlope(30, 20, std::vector<std::uint8_t>(600, 0)), 0.0);
  EXPECT_EQ(WallSlope(1, 1, std::vector<std::uint8_t>(1, 1)), 0.0);
}

}  // namespace lattice_lines_test
}  // namespace plumescout
