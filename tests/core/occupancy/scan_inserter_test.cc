// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/scan_inserter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/types/rng.h"

namespace plumescout {
namespace scan_inserter_test {

constexpr float kNoReturn = std::numeric_limits<float>::infinity();
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr double kTolerance = 1e-6;  // of a probability from a few summed floats
constexpr double kRightAngle_rad = M_PI / 2.0;

double ProbabilityOf(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

// Beams from `start_angle_rad` on, a right angle apart, at most 3 m long.
Scan CrossScan(std::vector<float> ranges_m, double start_angle_rad = 0.0) {
  return {start_angle_rad, kRightAngle_rad, 3.0, std::move(ranges_m)};
}

const OccupancyOptions kOptions = PublishedOccupancyOptions();
const double kPassed = ProbabilityOf(kOptions.miss_log_odds);
const double kHit = ProbabilityOf(kOptions.hit_log_odds);

// In the middle of a cell, so that beams along the axes stay in one row or column.
constexpr Pose2 kSensor = {0.05, 0.05, 0.0};

struct Map {
  OccupancyGrid grid{kOptions};
  ScanInserter inserter;

  absl::Status Insert(const Scan& scan, const Pose2& pose = kSensor,
                      const std::vector<MaskDisc>& masks = {}) {
    return inserter.Insert(pose, scan, masks, grid);
  }
  double At(Point2 point) const { return grid.Probability(grid.geometry().CellAt(point)); }
};

TEST(ScanInserter, PassesTheCellsBeforeAHitAndMarksTheHit) {
  Map map;
  ASSERT_TRUE(map.Insert(CrossScan({1.0F})).ok());
  EXPECT_NEAR(map.At({0.05, 0.05}), kPassed, kTolerance);
  EXPECT_NEAR(map.At({0.95, 0.05}), kPassed, kTolerance);
  EXPECT_NEAR(map.At({1.05, 0.05}), kHit, kTolerance);
  EXPECT_EQ(map.At({1.15, 0.05}), 0.5);
  EXPECT_EQ(map.At({-0.05, 0.05}), 0.5);
}

TEST(ScanInserter, PointsBeamsByYawStartAngleAndStep) {
  Map map;
  const Pose2 north = {kSensor.x_m, kSensor.y_m, kRightAngle_rad};
  ASSERT_TRUE(map.Insert(CrossScan({1.0F, 2.0F}, kRightAngle_rad), north).ok());
  EXPECT_NEAR(map.At({-0.95, 0.05}), kHit, kTolerance);  // yaw + start: west
  EXPECT_NEAR(map.At({0.05, -1.95}), kHit, kTolerance);  // one step on: south
}

TEST(ScanInserter, ClearsUpToTheMaximumRangeWithoutAReturn) {
  Map map;
  ASSERT_TRUE(map.Insert(CrossScan({kNoReturn})).ok());
  EXPECT_NEAR(map.At({0.05, 0.05}), kPassed, kTolerance);
  EXPECT_NEAR(map.At({2.95, 0.05}), kPassed, kTolerance);
  EXPECT_NEAR(map.At({3.04, 0.05}), kPassed, kTolerance);
  EXPECT_EQ(map.At({3.15, 0.05}), 0.5);
}

TEST(ScanInserter, DropsBadRangesOneByOne) {
  Map map;
  Scan scan = {0.0, kRightAngle_rad / 2, 3.0, {1.0F, kNothing, 0.0F, -1.0F, 3.1F, -kNoReturn}};
  ASSERT_TRUE(map.Insert(scan).ok());
  Map only_first;
  ASSERT_TRUE(only_first.Insert({0.0, kRightAngle_rad, 3.0, {1.0F}}).ok());
  EXPECT_EQ(map.grid.States(), only_first.grid.States());
  EXPECT_NEAR(map.At({1.05, 0.05}), kHit, kTolerance);
}

TEST(ScanInserter, KeepsARangeThatEqualsTheMaximumAsAFloat) {
  Map map;
  ASSERT_GT(static_cast<double>(2.1F), 2.1 - 1e-6);
  Scan scan = {0.0, kRightAngle_rad, 2.1, {std::nextafter(2.1F, 3.0F)}};
  ASSERT_TRUE(map.Insert(scan).ok());
  EXPECT_NEAR(map.At({2.15, 0.05}), kHit, kTolerance);
}

TEST(ScanInserter, ChangesNothingForAScanWithoutABeam) {
  Map map;
  ASSERT_TRUE(map.Insert(CrossScan({})).ok());
  ASSERT_TRUE(map.Insert(CrossScan({kNothing, kNothing})).ok());
  EXPECT_EQ(map.grid.geometry().size(), 0U);
}

TEST(ScanInserter, ChangesACellOnceHoweverManyBeamsCrossIt) {
  Map map;
  Scan scan = {0.0, 1e-3, 3.0, std::vector<float>(20, 1.0F)};
  ASSERT_TRUE(map.Insert(scan).ok());
  EXPECT_NEAR(map.At({0.05, 0.05}), kPassed, kTolerance);
  EXPECT_NEAR(map.At({0.55, 0.05}), kPassed, kTolerance);
  EXPECT_NEAR(map.At({1.05, 0.05}), kHit, kTolerance);
}

TEST(ScanInserter, LetsAHitWinOverPassesInAnyOrder) {
  for (const std::vector<float>& ranges_m : {std::vector<float>{1.0F, 2.0F}, {2.0F, 1.0F}}) {
    Map map;
    ASSERT_TRUE(map.Insert({0.0, 1e-4, 3.0, ranges_m}).ok());
    EXPECT_NEAR(map.At({1.05, 0.05}), kHit, kTolerance);
    EXPECT_NEAR(map.At({2.05, 0.05}), kHit, kTolerance);
  }
}

TEST(ScanInserter, AddsUpOverScans) {
  Map map;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(map.Insert(CrossScan({1.0F})).ok());
  EXPECT_NEAR(map.At({0.5, 0.05}), ProbabilityOf(3 * kOptions.miss_log_odds), kTolerance);
  EXPECT_NEAR(map.At({1.05, 0.05}), ProbabilityOf(3 * kOptions.hit_log_odds), kTolerance);
}

TEST(ScanInserter, HitsItsOwnCellWhenTheRangeIsShort) {
  Map map;
  ASSERT_TRUE(map.Insert(CrossScan({0.01F, 1.0F})).ok());
  EXPECT_NEAR(map.At({0.05, 0.05}), kHit, kTolerance);
  EXPECT_NEAR(map.At({0.05, 0.5}), kPassed, kTolerance);
}

TEST(ScanInserter, PassesTheCellUnderASensorThatStandsOnItsEdge) {
  Map map;
  ASSERT_TRUE(map.Insert(CrossScan({1.0F}, M_PI), {0.0, 0.05, 0.0}).ok());
  EXPECT_NEAR(map.At({0.05, 0.05}), kPassed, kTolerance);
}

TEST(ScanInserter, DropsBeamsThatEndInAMaskWhole) {
  Map map;
  const std::vector<MaskDisc> masks = {{{1.0, 0.0}, 0.2}};
  ASSERT_TRUE(map.Insert(CrossScan({0.9F, 1.0F}), kSensor, masks).ok());
  EXPECT_EQ(map.At({0.95, 0.05}), 0.5);
  EXPECT_EQ(map.At({0.55, 0.05}), 0.5);
  EXPECT_NEAR(map.At({0.05, 1.05}), kHit, kTolerance);
}

TEST(ScanInserter, KeepsBeamsThatEndBehindAMaskOrReturnNothing) {
  Map map;
  const std::vector<MaskDisc> masks = {{{1.0, 0.0}, 0.2}, {{-2.95, 0.0}, 0.2}};
  ASSERT_TRUE(map.Insert({0.0, M_PI, 3.0, {1.5F, kNoReturn}}, kSensor, masks).ok());
  EXPECT_NEAR(map.At({1.55, 0.05}), kHit, kTolerance);
  EXPECT_NEAR(map.At({-2.85, 0.05}), kPassed, kTolerance);
}

TEST(ScanInserter, RefusesAScanThatLeavesTheLimitsAndChangesNothing) {
  OccupancyOptions options;
  options.max_extent_m = 6.4;
  OccupancyGrid grid(options);
  ScanInserter inserter;
  const Pose2 pose = {3.0, 3.0, 0.0};
  ASSERT_TRUE(inserter.Insert(pose, CrossScan({1.0F}), {}, grid).ok());
  const Grid<CellState> before = grid.States();
  Scan far = {0.0, kRightAngle_rad, 8.0, {1.0F, 1.0F, 4.0F}};
  EXPECT_EQ(inserter.Insert(pose, far, {}, grid).code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(grid.States(), before);
  // The scratch is clean too: the next scan counts as if nothing had been.
  ASSERT_TRUE(inserter.Insert(pose, CrossScan({1.0F}), {}, grid).ok());
  EXPECT_NEAR(grid.Probability({35, 30}), ProbabilityOf(2 * kOptions.miss_log_odds), kTolerance);
}

TEST(ScanInserter, RefusesNumbersThatAreNone) {
  Map map;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto code = [&map](const Scan& scan, const Pose2& pose) {
    return map.Insert(scan, pose).code();
  };
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_EQ(code(CrossScan({1.0F}), {bad, 0.0, 0.0}), absl::StatusCode::kInvalidArgument);
    EXPECT_EQ(code(CrossScan({1.0F}), {0.0, bad, 0.0}), absl::StatusCode::kInvalidArgument);
    EXPECT_EQ(code(CrossScan({1.0F}), {0.0, 0.0, bad}), absl::StatusCode::kInvalidArgument);
    EXPECT_EQ(code({bad, 0.1, 3.0, {1.0F}}, kSensor), absl::StatusCode::kInvalidArgument);
    EXPECT_EQ(code({0.0, bad, 3.0, {1.0F}}, kSensor), absl::StatusCode::kInvalidArgument);
    EXPECT_EQ(code({0.0, 0.1, bad, {1.0F}}, kSensor), absl::StatusCode::kInvalidArgument);
  }
  EXPECT_EQ(code({0.0, 0.1, 0.0, {1.0F}}, kSensor), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(map.grid.geometry().size(), 0U);
}

TEST(ScanInserter, FollowsAGridThatGrows) {
  Map map;
  ASSERT_TRUE(map.Insert(CrossScan({1.0F, 1.0F, 1.0F, 1.0F})).ok());
  const Pose2 far = {-9.95, 8.05, 0.0};
  ASSERT_TRUE(map.Insert(CrossScan({1.0F, 1.0F, 1.0F, 1.0F}), far).ok());
  EXPECT_NEAR(map.At({1.05, 0.05}), kHit, kTolerance);
  EXPECT_NEAR(map.At({-8.95, 8.05}), kHit, kTolerance);
  EXPECT_NEAR(map.At({-9.5, 8.05}), kPassed, kTolerance);
}

// Length of the part of the segment inside the closed cell, by clipping (Liang and Barsky).
double ClippedLength_m(const GridGeometry& g, Point2 from, Point2 to, Cell cell) {
  const double delta[2] = {to.x_m - from.x_m, to.y_m - from.y_m};
  const double start[2] = {from.x_m, from.y_m};
  const double low[2] = {g.origin_x_m + cell.x * g.resolution_m,
                         g.origin_y_m + cell.y * g.resolution_m};
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double near = (low[axis] - start[axis]) / delta[axis];
    const double far = (low[axis] + g.resolution_m - start[axis]) / delta[axis];
    enter = std::max(enter, std::min(near, far));
    leave = std::min(leave, std::max(near, far));
  }
  return std::max(0.0, leave - enter) * std::hypot(delta[0], delta[1]);
}

// What the scan says of each cell, 0 nothing, 1 passed, 2 hit, by looking at every beam anew.
Grid<int> SlowVerdicts(const GridGeometry& geometry, const Pose2& pose, const Scan& scan) {
  Grid<int> verdicts(geometry, 0);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle_rad =
        pose.yaw_rad + scan.start_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
    const bool hit = std::isfinite(scan.ranges_m[i]);
    const double reach_m = hit ? static_cast<double>(scan.ranges_m[i]) : scan.max_range_m;
    const Point2 end = {pose.x_m + reach_m * std::cos(angle_rad),
                        pose.y_m + reach_m * std::sin(angle_rad)};
    for (std::size_t c = 0; c < verdicts.size(); ++c) {
      const Cell cell = geometry.CellAtIndex(c);
      if (ClippedLength_m(geometry, pose.position(), end, cell) > 0.0) {
        verdicts[c] = std::max(verdicts[c], 1);
      }
    }
    if (hit) verdicts[geometry.CellAt(end)] = 2;
  }
  return verdicts;
}

TEST(ScanInserter, EqualsEveryBeamClippedAgainstEveryCellOnRandomScans) {
  Rng rng(7);
  for (int trial = 0; trial < 10; ++trial) {
    Map map;
    const Pose2 pose = {rng.Uniform(-5.0, 5.0), rng.Uniform(-5.0, 5.0), rng.Uniform(-3.0, 3.0)};
    Scan scan = {-M_PI, 2.0 * M_PI / 40, 2.5, {}};
    for (int i = 0; i < 40; ++i) {
      const bool lost = rng.Uniform01() < 0.2;
      scan.ranges_m.push_back(lost ? kNoReturn : static_cast<float>(rng.Uniform(0.05, 2.5)));
    }
    ASSERT_TRUE(map.Insert(scan, pose).ok());
    const Grid<int> verdicts = SlowVerdicts(map.grid.geometry(), pose, scan);
    const double expected[] = {0.5, kPassed, kHit};
    for (std::size_t c = 0; c < verdicts.size(); ++c) {
      const Cell cell = verdicts.geometry().CellAtIndex(c);
      ASSERT_NEAR(map.grid.Probability(cell), expected[verdicts[c]], kTolerance)
          << cell.x << ", " << cell.y;
    }
  }
}

// Beams of 100 m that differ by a hair: on a fine grid each crosses ten thousand cells.
// Two beams that end 1 mm before the wall that they come from.
TEST(ScanInserter, HitsLieBehindTheirSurfaceByHalfACellAtMost) {
  const Scan scan = {-0.05, 0.1, 3.0, {0.949F, 0.949F}};
  const Point2 before{0.95, 0.05};
  const Point2 wall{1.05, 0.05};
  for (const auto& [surface_depth_m, hit] : {std::pair{0.0, before}, {0.01, wall}, {1.0, wall}}) {
    OccupancyOptions options;
    options.surface_depth_m = surface_depth_m;
    OccupancyGrid grid(options);
    ASSERT_TRUE(ScanInserter().Insert(kSensor, scan, {}, grid).ok());
    EXPECT_NEAR(grid.Probability(grid.geometry().CellAt(hit)), kHit, kTolerance);
    EXPECT_EQ(grid.Probability(grid.geometry().CellAt({1.15, 0.05})), 0.5);
  }
}

TEST(ScanInserter, BeamsThatCrossTooManyCellsAreRefused) {
  OccupancyOptions options;
  options.resolution_m = 0.01;
  OccupancyGrid grid(options);
  ScanInserter inserter;
  const Scan scan{0.0, 1e-9, 100.0, std::vector<float>(4096, kNoReturn)};
  const absl::Status refused = inserter.Insert(kSensor, scan, {}, grid);
  EXPECT_TRUE(absl::IsInvalidArgument(refused)) << refused;
  EXPECT_NE(refused.message().find("4096 beams cross"), absl::string_view::npos) << refused;
  EXPECT_EQ(grid.geometry().size(), 0U) << "nothing changed";
  const Scan honest{0.0, 2.0 * M_PI / 1440, 95.0, std::vector<float>(1440, kNoReturn)};
  OccupancyGrid outdoors(kOptions);
  EXPECT_TRUE(inserter.Insert(kSensor, honest, {}, outdoors).ok());
}

TEST(ScanInserter, AScanThatStandsForSeveralIsAsGoodAsThose) {
  const Pose2 pose{1.0, 1.5, 0.2};
  const Scan scan{-M_PI, 0.1, 8.0, std::vector<float>(62, 1.0F)};
  OccupancyGrid at_once((OccupancyOptions()));
  OccupancyGrid one_by_one((OccupancyOptions()));
  ScanInserter inserter;
  ASSERT_TRUE(inserter.Insert(pose, scan, {}, at_once, 4).ok());
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(inserter.Insert(pose, scan, {}, one_by_one).ok());
  EXPECT_EQ(at_once.States().values(), one_by_one.States().values());
}

}  // namespace scan_inserter_test
}  // namespace plumescout
