// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/bench_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plumescout::lab {
namespace bench_world_test {

using ::testing::SizeIs;

constexpr int kWidth = 120;
constexpr int kHeight = 90;
constexpr std::uint64_t kSeed = 3;

TEST(BenchWorld, BuildingIsClosedAndHasRoom) {
  const Grid<std::uint8_t> walls = MakeBuilding(kWidth, kHeight, kSeed);
  ASSERT_EQ(walls.width(), kWidth);
  ASSERT_EQ(walls.height(), kHeight);
  int closed = 0;
  for (int x = 0; x < kWidth; ++x) closed += walls[Cell{x, 0}] + walls[Cell{x, kHeight - 1}];
  EXPECT_EQ(closed, 2 * kWidth);
  const auto free = std::count(walls.values().begin(), walls.values().end(), 0);
  EXPECT_GT(free, kWidth * kHeight / 2);
  EXPECT_EQ(walls, MakeBuilding(kWidth, kHeight, kSeed));
}

TEST(BenchWorld, ScansEndAtWallsOrNowhere) {
  const Grid<std::uint8_t> walls = MakeBuilding(kWidth, kHeight, kSeed);
  const std::vector<Pose2> poses = FreePoses(walls, 5, kSeed);
  ASSERT_THAT(poses, SizeIs(5));
  for (const Pose2& pose : poses) {
    const Cell at = walls.geometry().CellAt(pose.position());
    EXPECT_EQ(walls[at], 0);
    const Scan scan = ScanBuilding(walls, pose);
    ASSERT_THAT(scan.ranges_m, SizeIs(360));
    for (const float range_m : scan.ranges_m) {
      EXPECT_TRUE(std::isinf(range_m) || (range_m > 0.0F && range_m <= 8.0F)) << range_m;
    }
  }
}

}  // namespace bench_world_test
}  // namespace plumescout::lab
