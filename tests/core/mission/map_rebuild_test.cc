// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/map_rebuild.h"

#include "gtest/gtest.h"
#include "tests/support/box_room.h"

namespace plumescout {
namespace map_rebuild_test {

RebuildInputs RoomOf(int scans, StopFn stop = {}) {
  RebuildInputs inputs{5, 7, OccupancyGrid(OccupancyOptions()), {}, std::move(stop)};
  for (int i = 0; i < scans; ++i) {
    const Pose2 pose{1.0 + 0.1 * i, 1.5, 0.0};
    inputs.scans.push_back(
        {pose, 3, std::make_shared<const PackedScan>(Pack(support::ScanInBox(pose, 4, 3), {}))});
  }
  return inputs;
}

TEST(MapRebuild, InsertsEachScanAsOftenAsItStandsFor) {
  MapRebuild rebuild(RoomOf(2));
  EXPECT_FALSE(rebuild.done());
  rebuild.Recompute();
  ASSERT_TRUE(rebuild.done());
  EXPECT_EQ(rebuild.last_number(), 7);
  OccupancyGrid expected{OccupancyOptions()};
  ScanInserter inserter;
  for (int i = 0; i < 6; ++i) {
    const Pose2 pose{1.0 + 0.1 * (i / 3), 1.5, 0.0};
    const Scan scan = Unpack(Pack(support::ScanInBox(pose, 4, 3), {}));
    ASSERT_TRUE(inserter.Insert(pose, scan, {}, expected).ok());
  }
  const OccupancyGrid grid = rebuild.TakeGrid();
  ASSERT_EQ(grid.geometry(), expected.geometry());
  EXPECT_EQ(grid.States().values(), expected.States().values());
}

TEST(MapRebuild, IsDueAfterATimeThatFollowsFromWhatThereIsToDo) {
  EXPECT_EQ(MapRebuild(RoomOf(0)).due_ns(), 1'000'000'005);
  MapRebuild rebuild(RoomOf(10));
  EXPECT_EQ(rebuild.due_ns(), 1'003'000'005);
  rebuild.Recompute();
  EXPECT_EQ(rebuild.due_ns(), 1'003'000'005);
}

// A mission that was saved before there were slight faults has 0 or 1.
TEST(MapFault, HasTheNumbersItIsSavedWith) {
  EXPECT_EQ(static_cast<int>(MapFault::kNone), 0);
  EXPECT_EQ(static_cast<int>(MapFault::kMisleads), 1);
  EXPECT_TRUE(IsOne(MapFault::kSlight));
  EXPECT_FALSE(IsOne(static_cast<MapFault>(3)));
}

TEST(MapRebuild, ComesToNothingIfItIsStopped) {
  bool stopped = true;
  MapRebuild rebuild(RoomOf(2, [&stopped] { return stopped; }));
  rebuild.Recompute();
  EXPECT_FALSE(rebuild.done());
}

}  // namespace map_rebuild_test
}  // namespace plumescout
