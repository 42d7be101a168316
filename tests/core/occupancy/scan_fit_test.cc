// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/scan_fit.h"

#include "gtest/gtest.h"
#include "tests/support/box_room.h"

namespace plumescout {
namespace scan_fit_test {

constexpr double kWidth_m = 6.0;
constexpr double kHeight_m = 4.0;

OccupancyGrid RoomSeenFrom(const Pose2& pose) {
  OccupancyGrid grid((OccupancyOptions()));
  ScanInserter inserter;
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(
        inserter.Insert(pose, support::ScanInBox(pose, kWidth_m, kHeight_m), {}, grid).ok());
  }
  return grid;
}

TEST(ScanFit, AScanFromAnotherPlaceOfTheRoomFits) {
  const OccupancyGrid grid = RoomSeenFrom({2.0, 2.0, 0.0});
  const Pose2 other{3.5, 1.2, 0.7};
  const ScanFit fit = FitOf(other, support::ScanInBox(other, kWidth_m, kHeight_m), {}, grid);
  EXPECT_GT(fit.fitting, 150);
  EXPECT_EQ(fit.short_of, 0);
  EXPECT_LE(fit.beyond, 2);
}

TEST(ScanFit, AJumpOfHalfAMetreShowsOnBothSides) {
  const OccupancyGrid grid = RoomSeenFrom({2.0, 2.0, 0.0});
  const Pose2 truth{3.0, 2.0, 0.0};
  const Scan scan = support::ScanInBox(truth, kWidth_m, kHeight_m);
  for (const Pose2 told : {Pose2{3.5, 2.0, 0.0}, Pose2{3.0, 1.5, 0.0}, Pose2{3.36, 2.36, 0.0},
                           Pose2{3.0, 2.0, 0.35}}) {
    const ScanFit fit = FitOf(told, scan, {}, grid);
    EXPECT_GT(fit.short_of + fit.beyond, fit.judged() / 4) << told.x_m << ", " << told.y_m;
    EXPECT_GT(fit.short_of, 5) << told.x_m << ", " << told.y_m;
    EXPECT_GT(fit.beyond, 5) << told.x_m << ", " << told.y_m;
  }
}

TEST(ScanFit, WhoStandsInTheWayIsMaskedOrOnOneSideAlone) {
  const Pose2 pose{2.0, 2.0, 0.0};
  const OccupancyGrid grid = RoomSeenFrom(pose);
  const Scan scan = support::ScanInBox(pose, kWidth_m, kHeight_m, {{{3.0, 2.0}, 0.3}});
  const ScanFit seen = FitOf(pose, scan, {}, grid);
  EXPECT_GT(seen.short_of, 5);
  EXPECT_EQ(seen.beyond, 0);
  EXPECT_EQ(FitOf(pose, scan, {{{3.0, 2.0}, 0.4}}, grid).short_of, 0);
}

TEST(ScanFit, TheUnknownTellsNothing) {
  const Pose2 pose{2.0, 2.0, 0.0};
  const Scan scan = support::ScanInBox(pose, kWidth_m, kHeight_m);
  EXPECT_EQ(FitOf(pose, scan, {}, OccupancyGrid(OccupancyOptions())), ScanFit());
  EXPECT_EQ(FitOf({90.0, 2.0, 0.0}, scan, {}, RoomSeenFrom(pose)).judged(), 0);
}

}  // namespace scan_fit_test
}  // namespace plumescout
