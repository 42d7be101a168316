// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/lidar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace plumescout::lab {
namespace lidar_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Ranges are float: half a unit in the last place at 8 m is below a micrometre.
constexpr double kFloat_m = 1e-6;

// Free space [1, 7) x [1, 5) m with walls one metre thick around it.
Grid<CellState> BoxRoom() {
  GridGeometry geometry;
  geometry.width = 80;
  geometry.height = 60;
  Grid<CellState> room(geometry, CellState::kOccupied);
  for (int y = 10; y < 50; ++y) {
    for (int x = 10; x < 70; ++x) room[Cell{x, y}] = CellState::kFree;
  }
  return room;
}

// Distance to the walls of BoxRoom.
double WallDistance_m(Point2 from, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  const double x_m = ((c > 0 ? 7.0 : 1.0) - from.x_m) / c;
  const double y_m = ((s > 0 ? 5.0 : 1.0) - from.y_m) / s;
  return std::min(x_m, y_m);
}

LidarOptions Noiseless(double max_range_m = 8.0) {
  LidarOptions options;
  options.noise_sigma_m = 0.0;
  options.max_range_m = max_range_m;
  return options;
}

// Between the wall's edge and half the diagonal of a cell behind it, and in an occupied cell.
TEST(LidarTest, MeasuresABoxRoomExactly) {
  const Grid<CellState> room = BoxRoom();
  Lidar lidar(Noiseless(), 1);
  const Pose2 pose{2.37, 3.11, 0.4};
  const Scan scan = lidar.Take(room, pose);
  ASSERT_EQ(scan.ranges_m.size(), 360u);
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double angle_rad =
        pose.yaw_rad + scan.start_angle_rad + static_cast<double>(beam) * scan.angle_step_rad;
    const double edge_m = WallDistance_m(pose.position(), angle_rad);
    const double range_m = scan.ranges_m[beam];
    EXPECT_GE(range_m, edge_m - kFloat_m);
    EXPECT_LE(range_m, edge_m + 0.5 * std::sqrt(2.0) * 0.1 + kFloat_m);
    const Point2 end{pose.x_m + range_m * std::cos(angle_rad),
                     pose.y_m + range_m * std::sin(angle_rad)};
    EXPECT_EQ(room[room.geometry().CellAt(end)], CellState::kOccupied);
  }
}

TEST(LidarTest, ReturnsFromTheMiddleOfTheBeamsWayThroughTheCell) {
  const Grid<CellState> room = BoxRoom();
  EXPECT_NEAR(CastBeam_m(room, {2.0, 3.05}, 0.0, 8.0), 5.0 + 0.05, 1e-9);
  // At 45 degrees from a cell's centre through corners: 3.95 m to the wall on both axes, and half a
  // cell.
  EXPECT_NEAR(CastBeam_m(room, {3.05, 1.05}, M_PI / 4.0, 8.0), 4.0 * std::sqrt(2.0), 1e-9);
}

TEST(LidarTest, SeesNothingBeyondItsRange) {
  const Grid<CellState> room = BoxRoom();
  EXPECT_EQ(CastBeam_m(room, {2.0, 3.05}, 0.0, 4.9), kInfinity);
  EXPECT_EQ(CastBeam_m(room, {2.0, 3.05}, 0.0, 5.04), kInfinity);
  EXPECT_NEAR(CastBeam_m(room, {2.0, 3.05}, 0.0, 5.06), 5.05, 1e-9);
}

TEST(LidarTest, SeesNothingOffTheMap) {
  GridGeometry geometry;
  geometry.width = geometry.height = 10;
  const Grid<CellState> open(geometry, CellState::kFree);
  Lidar lidar(Noiseless(), 1);
  for (const float range_m : lidar.Take(open, {0.5, 0.5, 0.0}).ranges_m) {
    EXPECT_EQ(range_m, kInfinity);
  }
}

TEST(LidarTest, CountsBeamsFromBehindCounterClockwise) {
  const Grid<CellState> room = BoxRoom();
  Lidar lidar(Noiseless(), 1);
  const Scan scan = lidar.Take(room, {2.0, 2.05, M_PI / 2.0});  // looking north
  EXPECT_NEAR(scan.ranges_m[0], 1.05 + 0.05, kFloat_m);         // behind: the southern wall
  EXPECT_NEAR(scan.ranges_m[90], 5.0 + 0.05, kFloat_m);         // right: the eastern wall
  EXPECT_NEAR(scan.ranges_m[180], 2.95 + 0.05, kFloat_m);       // ahead
  EXPECT_NEAR(scan.ranges_m[270], 1.0 + 0.05, kFloat_m);        // left
}

TEST(LidarTest, AddsNoiseOfTheGivenSize) {
  const Grid<CellState> room = BoxRoom();
  Lidar noisy({}, 7);
  Lidar clean(Noiseless(), 7);
  const Pose2 pose{3.0, 3.0, 0.0};
  const Scan truth = clean.Take(room, pose);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kScans = 50;
  for (int i = 0; i < kScans; ++i) {
    const Scan scan = noisy.Take(room, pose);
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      const double error = (scan.ranges_m[beam] - truth.ranges_m[beam]) / 0.02;
      sum += error;
      squares += error * error;
    }
  }
  // Standard normal sums of n draws, to 4 standard deviations.
  constexpr double kDraws = 360.0 * kScans;
  EXPECT_NEAR(sum, 0.0, 4.0 * std::sqrt(kDraws));
  EXPECT_NEAR(squares, kDraws, 4.0 * std::sqrt(2.0 * kDraws));
}

TEST(LidarTest, NeverMeasuresLessThanNothingOrMoreThanItsRange) {
  const Grid<CellState> room = BoxRoom();
  LidarOptions options;
  options.noise_sigma_m = 1.0;
  options.max_range_m = 2.0;
  Lidar lidar(options, 7);
  int returns = 0;
  for (const float range_m : lidar.Take(room, {1.2, 3.0, 0.0}).ranges_m) {
    EXPECT_GE(range_m, 0.0F);
    EXPECT_TRUE(range_m <= 2.0F || range_m == kInfinity) << range_m;
    returns += std::isfinite(range_m) ? 1 : 0;
  }
  EXPECT_GT(returns, 0);
}

TEST(LidarTest, DependsOnItsSeedAlone) {
  const Grid<CellState> room = BoxRoom();
  const Pose2 pose{3.0, 3.0, 0.0};
  EXPECT_EQ(Lidar({}, 7).Take(room, pose), Lidar({}, 7).Take(room, pose));
  EXPECT_NE(Lidar({}, 7).Take(room, pose), Lidar({}, 8).Take(room, pose));
}

TEST(LidarTest, RejectsOptionsOutOfRange) {
  LidarOptions options;
  options.beams = 0;
  EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
  options = {};
  options.max_range_m = std::nan("");
  EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
  options = {};
  options.noise_sigma_m = -0.01;
  EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_TRUE(Validate(LidarOptions{}).ok());
}

TEST(LidarTest, DropsTheShareOfBeamsItIsToldTo) {
  const Grid<CellState> room = BoxRoom();
  LidarOptions options = Noiseless();
  options.dropout_share = 0.25;
  Lidar lidar(options, 7);
  int silent = 0;
  constexpr int kScans = 50;
  for (int i = 0; i < kScans; ++i) {
    for (const float range_m : lidar.Take(room, {3.0, 3.0, 0.0}).ranges_m) {
      EXPECT_NE(range_m, kInfinity) << "would be read as free space";
      silent += std::isnan(range_m) ? 1 : 0;
    }
  }
  // Binomial, to 4 standard deviations.
  constexpr double kDraws = 360.0 * kScans;
  EXPECT_NEAR(silent, 0.25 * kDraws, 4.0 * std::sqrt(0.25 * 0.75 * kDraws));
}

TEST(LidarTest, MayDropEveryBeam) {
  LidarOptions options;
  options.dropout_share = 1.0;
  Lidar lidar(options, 7);
  for (const float range_m : lidar.Take(BoxRoom(), {3.0, 3.0, 0.0}).ranges_m) {
    EXPECT_TRUE(std::isnan(range_m));
  }
}

TEST(LidarTest, MeetsBodiesAtTheirEdge) {
  const std::vector<Body> bodies = {{{3.0, 0.0}, 0.5}, {{5.0, 0.0}, 1.0}};
  EXPECT_NEAR(CastBeamAtBodies_m(bodies, {0.0, 0.0}, 0.0), 2.5, 1e-12);
  EXPECT_EQ(CastBeamAtBodies_m(bodies, {0.0, 0.0}, M_PI), kInfinity);
  // 0.3 m off the centre: half a chord of 0.4 m.
  EXPECT_NEAR(CastBeamAtBodies_m(bodies, {0.0, 0.3}, 0.0), 2.6, 1e-12);
  EXPECT_EQ(CastBeamAtBodies_m(bodies, {0.0, 2.0}, 0.0), kInfinity);
  EXPECT_EQ(CastBeamAtBodies_m({{{0.1, 0.0}, 0.5}}, {0.0, 0.0}, 0.0), kInfinity) << "its own";
}

TEST(LidarTest, SeesBodiesBeforeWallsOnly) {
  const Grid<CellState> room = BoxRoom();
  Lidar lidar(Noiseless(), 1);
  const Pose2 pose{2.0, 3.05, 0.0};
  const std::vector<Body> bodies = {{{4.0, 3.05}, 0.2}, {{2.0, 5.5}, 0.2}};
  const Scan scan = lidar.Take(room, pose, bodies);
  EXPECT_NEAR(scan.ranges_m[180], 1.8, kFloat_m);
  EXPECT_NEAR(scan.ranges_m[270], 1.95 + 0.05, kFloat_m) << "the body stands in the wall";
}

TEST(LidarTest, RejectsDropoutsOutOfRange) {
  for (const double bad : {-0.1, 1.1, std::nan("")}) {
    LidarOptions options;
    options.dropout_share = bad;
    EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
  }
}

}  // namespace lidar_test
}  // namespace plumescout::lab
