// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/fan_raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/lab/sim/flow_domains.h"

namespace plumescout::lab {
namespace fan_raster_test {

using ::testing::HasSubstr;

void ExpectInvalid(const std::vector<Fan>& fans, FlowDomain flow, const std::string& message) {
  const absl::Status status = AddFans(fans, flow);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), HasSubstr(message));
}

TEST(FanRasterTest, HoldsTheFacesThatTheFanLiesOn) {
  FlowDomain flow = ClosedRoom(20, 20);
  ASSERT_TRUE(AddFans({{{1.0, 1.0}, 0.0, 0.4, 2.0}}, flow).ok());
  ASSERT_EQ(flow.fans.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(flow.fans[static_cast<std::size_t>(i)].cell, (Cell{10, 8 + i}));
    EXPECT_EQ(flow.fans[static_cast<std::size_t>(i)].side, Side::kWest);
    EXPECT_EQ(flow.fans[static_cast<std::size_t>(i)].speed_mps, 2.0);
  }
}

TEST(FanRasterTest, BlowsBackwardsAlongAnAxis) {
  FlowDomain flow = ClosedRoom(20, 20);
  ASSERT_TRUE(AddFans({{{1.0, 1.0}, -M_PI / 2.0, 0.3, 1.5}}, flow).ok());
  EXPECT_EQ(flow.fans.size(), 3u);
  for (const FanFace& face : flow.fans) {
    EXPECT_EQ(face.side, Side::kSouth);
    EXPECT_EQ(face.speed_mps, -1.5);
  }
}

// A line of length w at an angle parts w |cos| / h pairs of cells in the east and w |sin| / h in
// the north, each at that share of the speed; to within a face on each axis.
TEST(FanRasterTest, MovesWidthTimesSpeedAtAnyAngle) {
  constexpr double kWidth_m = 1.2;
  constexpr double kSpeed_mps = 2.0;
  constexpr double kCell_m = 0.1;
  for (double direction_rad = -3.0; direction_rad < 3.2; direction_rad += 0.37) {
    FlowDomain flow = ClosedRoom(30, 30);
    ASSERT_TRUE(AddFans({{{1.53, 1.48}, direction_rad, kWidth_m, kSpeed_mps}}, flow).ok());
    double moved_m2_per_s = 0.0;
    for (const FanFace& face : flow.fans) moved_m2_per_s += std::abs(face.speed_mps) * kCell_m;
    EXPECT_NEAR(moved_m2_per_s, kWidth_m * kSpeed_mps, kSpeed_mps * 1.5 * kCell_m) << direction_rad;
    for (const FanFace& face : flow.fans) {
      const bool west = face.side == Side::kWest;
      const double along = west ? std::cos(direction_rad) : std::sin(direction_rad);
      EXPECT_EQ(face.speed_mps, kSpeed_mps * along);
    }
  }
}

TEST(FanRasterTest, RejectsFansInOrIntoWalls) {
  FlowDomain flow = ClosedRoom(20, 20);
  flow.fluid[Cell(10, 11)] = 0;
  ExpectInvalid({{{1.0, 1.0}, 0.0, 0.4, 2.0}}, flow, "fans[0] reaches into a wall at (1.05, 1.15)");
  ExpectInvalid({{{0.0, 1.0}, 0.0, 0.4, 2.0}}, ClosedRoom(20, 20), "fans[0] reaches into a wall");
}

TEST(FanRasterTest, RejectsFansNarrowerThanACell) {
  ExpectInvalid({{{1.0, 1.0}, 0.0, 0.04, 2.0}}, ClosedRoom(20, 20),
                "fans[0].width_m = 0.04 is too narrow for cells of 0.1 m");
}

TEST(FanRasterTest, RejectsFansThatOverlap) {
  const Fan fan{{1.0, 1.0}, 0.0, 0.4, 2.0};
  ExpectInvalid({fan, fan}, ClosedRoom(20, 20), "fans[1] overlaps another fan");
}

TEST(FanRasterTest, RejectsAFanThatFillsTheWholeRoom) {
  ExpectInvalid({{{1.0, 1.0}, 0.0, 2.0, 2.0}}, ClosedRoom(20, 20),
                "fans: air is driven out of the space around cell (0, 0)");
}

}  // namespace fan_raster_test
}  // namespace plumescout::lab
