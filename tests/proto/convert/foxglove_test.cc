// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/foxglove.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace plumescout {
namespace foxglove_test {

constexpr std::int64_t kTime_ns = 12'000'000'034;

std::vector<float> FloatsOf(const std::string& data) {
  std::vector<float> values(data.size() / sizeof(float));
  std::memcpy(values.data(), data.data(), data.size());
  return values;
}

TEST(FoxgloveTest, PosesAreQuaternionsInFrameMap) {
  const foxglove::PoseInFrame pose = FoxglovePose({1.0, 2.0, M_PI / 2}, kTime_ns);
  EXPECT_EQ(pose.frame_id(), "map");
  EXPECT_EQ(pose.timestamp().seconds(), 12);
  EXPECT_EQ(pose.timestamp().nanos(), 34);
  EXPECT_EQ(pose.pose().position().x(), 1.0);
  EXPECT_EQ(pose.pose().position().y(), 2.0);
  EXPECT_NEAR(pose.pose().orientation().z(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(pose.pose().orientation().w(), std::sqrt(0.5), 1e-12);
}

TEST(FoxgloveTest, TheLastBeamOfAScanHasItsEndAngle) {
  const Scan scan{-1.0, 0.5, 10.0, {1.0F, std::numeric_limits<float>::infinity(), 3.0F}};
  const foxglove::LaserScan message = FoxgloveScan(scan, {1.0, 2.0, 0.0}, kTime_ns);
  EXPECT_EQ(message.start_angle(), -1.0);
  EXPECT_EQ(message.end_angle(), 0.0);
  ASSERT_EQ(message.ranges_size(), 3);
  EXPECT_EQ(message.ranges(0), 1.0);
  EXPECT_TRUE(std::isinf(message.ranges(1)));
  EXPECT_EQ(FoxgloveScan({}, {}, kTime_ns).ranges_size(), 0);
}

TEST(FoxgloveTest, RangesAreRoundedByFourMillimetresAtMost) {
  Scan scan{.start_angle_rad = 0.0, .angle_step_rad = 0.1, .max_range_m = 8.0, .ranges_m = {}};
  for (int i = 0; i < 1000; ++i) scan.ranges_m.push_back(0.0077F * static_cast<float>(i));
  const foxglove::LaserScan message = FoxgloveScan(scan, {}, kTime_ns);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_NEAR(message.ranges(i), scan.ranges_m[static_cast<std::size_t>(i)], 0.00391);
    EXPECT_EQ(message.ranges(i) * 128.0, std::round(message.ranges(i) * 128.0)) << i;
  }
}

TEST(FoxgloveTest, OccupancyIsThatOfRos) {
  Grid<CellState> occupancy({-1.0, 2.0, 0.1, 3, 1}, CellState::kUnknown);
  occupancy[Cell{1, 0}] = CellState::kFree;
  occupancy[Cell{2, 0}] = CellState::kOccupied;
  const foxglove::Grid grid = FoxgloveGrid(occupancy, kTime_ns);
  EXPECT_EQ(grid.data(), std::string("\xFF\0\x64", 3));
  EXPECT_EQ(grid.column_count(), 3u);
  EXPECT_EQ(grid.row_stride(), 3u);
  EXPECT_EQ(grid.cell_stride(), 1u);
  EXPECT_EQ(grid.cell_size().x(), 0.1);
  EXPECT_EQ(grid.pose().position().x(), -1.0);
  EXPECT_EQ(grid.pose().position().y(), 2.0);
  ASSERT_EQ(grid.fields_size(), 1);
  EXPECT_EQ(grid.fields(0).name(), "occupancy");
  EXPECT_EQ(grid.fields(0).type(), foxglove::PackedElementField::INT8);
}

TEST(FoxgloveTest, FieldsAreRoundedByAThousandthOfTheLargest) {
  Grid<float> values({0.0, 0.0, 0.5, 100, 2}, 0.0F);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.377F * static_cast<float>(i);
  values[7] = std::numeric_limits<float>::quiet_NaN();
  const float largest = values[199];
  const foxglove::Grid grid = FoxgloveGrid(values, "mean_ppm", kTime_ns);
  EXPECT_EQ(grid.fields(0).name(), "mean_ppm");
  EXPECT_EQ(grid.fields(0).type(), foxglove::PackedElementField::FLOAT32);
  EXPECT_EQ(grid.row_stride(), 400u);
  const std::vector<float> shown = FloatsOf(grid.data());
  ASSERT_EQ(shown.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == 7) continue;
    EXPECT_NEAR(shown[i], values[i], largest / 1000.0F) << i;
  }
  EXPECT_TRUE(std::isnan(shown[7]));
}

TEST(FoxgloveTest, FieldsOfNothingOrNextToNothingStayWhatTheyAre) {
  Grid<float> values({0.0, 0.0, 0.5, 2, 1}, 0.0F);
  EXPECT_EQ(FloatsOf(FoxgloveGrid(values, "mean_ppm", kTime_ns).data()), values.values());
  values[0] = std::numeric_limits<float>::min();
  EXPECT_EQ(FloatsOf(FoxgloveGrid(values, "mean_ppm", kTime_ns).data()), values.values());
  EXPECT_EQ(FoxgloveGrid(Grid<float>(), "mean_ppm", kTime_ns).data(), "");
}

TEST(FoxgloveTest, AWayIsALineToItsGoal) {
  Trajectory trajectory;
  trajectory.waypoints = {{{1.0, 2.0, 0.0}}, {{3.0, 4.0, 0.0}}};
  const foxglove::SceneUpdate update = FoxgloveWay("plans/r1", trajectory, kTime_ns);
  ASSERT_EQ(update.entities_size(), 1);
  EXPECT_EQ(update.entities(0).id(), "plans/r1");
  EXPECT_EQ(update.entities(0).lines(0).points_size(), 2);
  EXPECT_EQ(update.entities(0).spheres(0).pose().position().x(), 3.0);
  const foxglove::SceneUpdate gone = FoxgloveGone("plans/r1", kTime_ns);
  ASSERT_EQ(gone.deletions_size(), 1);
  EXPECT_EQ(gone.deletions(0).id(), "plans/r1");
  EXPECT_EQ(gone.deletions(0).type(), foxglove::SceneEntityDeletion::MATCHING_ID);
}

TEST(FoxgloveTest, FrontiersAreOfTwoKindsAndPalerWhereTheyAreNoGoals) {
  Frontier near;
  near.kind = FrontierKind::kGas;
  near.cells = {{0, 0}, {1, 0}};
  near.reachable = true;
  Frontier small = near;
  small.cells = {{2, 0}};
  small.too_small = true;
  const foxglove::SceneUpdate update =
      FoxgloveFrontiers({near, small}, {0.0, 0.0, 1.0, 4, 4}, kTime_ns);
  ASSERT_EQ(update.entities_size(), 2);
  EXPECT_EQ(update.entities(0).id(), "frontiers/occupancy");
  EXPECT_EQ(update.entities(0).spheres_size(), 0);
  ASSERT_EQ(update.entities(1).spheres_size(), 3);
  EXPECT_EQ(update.entities(1).spheres(1).pose().position().x(), 1.5);
  EXPECT_EQ(update.entities(1).spheres(1).color().a(), 1.0);
  EXPECT_LT(update.entities(1).spheres(2).color().a(), 1.0);
}

TEST(FoxgloveTest, OfManyFrontiersCellsAreLeftOutEvenly) {
  Frontier long_one;
  for (int x = 0; x < static_cast<int>(kMostFrontierMarks); ++x) long_one.cells.push_back({x, 0});
  const GridGeometry geometry{0.0, 0.0, 1.0, 100'000, 4};
  const auto marks = [&](const std::vector<Frontier>& frontiers) {
    const foxglove::SceneUpdate update = FoxgloveFrontiers(frontiers, geometry, kTime_ns);
    return static_cast<std::size_t>(update.entities(0).spheres_size() +
                                    update.entities(1).spheres_size());
  };
  EXPECT_EQ(marks({long_one}), kMostFrontierMarks);
  Frontier one_more = long_one;
  one_more.kind = FrontierKind::kGas;
  one_more.cells = {{0, 1}};
  EXPECT_EQ(marks({long_one, one_more}), kMostFrontierMarks / 2 + 1);
  EXPECT_LE(marks(std::vector<Frontier>(7, long_one)), kMostFrontierMarks);
}

TEST(FoxgloveTest, LogsSayWhoAndWhat) {
  const foxglove::Log log = FoxgloveLog(foxglove::Log::WARNING, "r1", "what", kTime_ns);
  EXPECT_EQ(log.level(), foxglove::Log::WARNING);
  EXPECT_EQ(log.name(), "r1");
  EXPECT_EQ(log.message(), "what");
}

}  // namespace foxglove_test
}  // namespace plumescout
