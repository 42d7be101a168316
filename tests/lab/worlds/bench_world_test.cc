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

TEST(BenchWorld, DrivesOnKeepOffWalls) {
  const Grid<std::uint8_t> walls = MakeBuilding(kWidth, kHeight, kSeed);
  constexpr double kStep_m = 0.3;
  Rng rng(kSeed);
  Pose2 pose = FreePoses(walls, 1, kSeed).front();
  int moves = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose2 before = pose;
    DriveOn(walls, kStep_m, 0.2, rng, pose);
    EXPECT_EQ(walls.At(walls.geometry().CellAt(pose.position()), 1), 0);
    if (pose.position() == before.position()) continue;
    EXPECT_NEAR(Distance_m(before.position(), pose.position()), kStep_m, 1e-9);
    ++moves;
  }
  EXPECT_GT(moves, 150);
}

TEST(BenchWorld, DrivesOnStayWhereThereIsNoWay) {
  const Grid<std::uint8_t> walls(GridGeometry{0.0, 0.0, 0.1, 10, 10}, 1);
  Rng rng(kSeed);
  Pose2 pose{0.55, 0.55, 0.0};
  DriveOn(walls, 0.3, 0.2, rng, pose);
  EXPECT_EQ(pose.position(), (Point2{0.55, 0.55}));
}

}  // namespace bench_world_test
}  // namespace plumescout::lab
