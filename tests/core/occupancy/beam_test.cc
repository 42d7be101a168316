// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/beam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/occupancy/scan_inserter.h"
#include "core/types/rng.h"

namespace plumescout {
namespace beam_test {

constexpr Point2 kSensor{0.0, 0.0};
constexpr double kDepth_m = 0.02;
constexpr double kTolerance_m = 1e-12;

std::vector<Beam> Behind(std::vector<Beam> beams, Point2 sensor = kSensor) {
  PutBehindSurfaces(sensor, kDepth_m, beams);
  return beams;
}

void ExpectNear(Point2 point, Point2 expected) {
  EXPECT_NEAR(point.x_m, expected.x_m, kTolerance_m);
  EXPECT_NEAR(point.y_m, expected.y_m, kTolerance_m);
}

TEST(Beam, GoesOnAlongTheNormalOfAWallThatItGrazes) {
  // A wall along y = 0.5.
  const std::vector<Beam> beams =
      Behind({{{5.0, 0.5}, true}, {{4.4, 0.5}, true}, {{4.0, 0.5}, true}});
  ExpectNear(beams[0].end, {5.0, 0.52});
  ExpectNear(beams[1].end, {4.4, 0.52});
  ExpectNear(beams[2].end, {4.0, 0.52});
}

TEST(Beam, GoesAwayFromTheSensorOnEitherSide) {
  const Point2 beyond{0.0, 1.0};
  const std::vector<Beam> beams =
      Behind({{{4.0, 0.5}, true}, {{4.4, 0.5}, true}, {{5.0, 0.5}, true}}, beyond);
  for (const Beam& beam : beams) EXPECT_NEAR(beam.end.y_m, 0.48, kTolerance_m);
}

TEST(Beam, TakesASlantedWallForWhatItIs) {
  const std::vector<Beam> beams =
      Behind({{{2.0, 0.0}, true}, {{1.8, 0.2}, true}, {{1.6, 0.4}, true}});
  const double step_m = kDepth_m * std::sqrt(0.5);
  ExpectNear(beams[1].end, {1.8 + step_m, 0.2 + step_m});
}

TEST(Beam, StaysWhereNoNeighbourTellsTheSurface) {
  const std::vector<Beam> alone = {{{2.0, 0.0}, true}};
  EXPECT_EQ(Behind(alone), alone);
  // A step in depth on either side, and a beam that did not return.
  const std::vector<Beam> gap = {
      {{2.0, 0.0}, true}, {{3.5, 0.1}, true}, {{3.5, 0.2}, false}, {{3.5, 0.3}, true}};
  EXPECT_EQ(Behind(gap), gap);
  const std::vector<Beam> one_point = {{{2.0, 0.0}, true}, {{2.0, 0.0}, true}};
  EXPECT_EQ(Behind(one_point), one_point);
  EXPECT_EQ(Behind({}), std::vector<Beam>());
}

TEST(Beam, TakesTheNeighbourOfOneSideWhereTheOtherIsFar) {
  const std::vector<Beam> beams =
      Behind({{{5.0, 3.0}, true}, {{2.0, 0.2}, true}, {{2.0, 0.4}, true}});
  ExpectNear(beams[1].end, {2.02, 0.2});
}

// A corridor of 10 x 2 m whose walls are one cell thick: the sensor stands at one end, so that all
// it sees of the walls is grazed. Beams end half way through the cell that they enter, and err.
struct Corridor {
  explicit Corridor(double surface_depth_m) {
    OccupancyOptions options;
    options.surface_depth_m = surface_depth_m;
    grid = OccupancyGrid(options);
    Rng rng(7);
    ScanInserter inserter;
    for (int scan = 0; scan < 50; ++scan) {
      EXPECT_TRUE(inserter.Insert({kX_m, kY_m, 0.0}, Take(rng), {}, grid).ok());
    }
  }

  static Scan Take(Rng& rng) {
    constexpr int kBeams = 360;
    constexpr double kNoise_m = 0.02;
    Scan scan = {-M_PI, 2.0 * M_PI / kBeams, 20.0, {}};
    for (int i = 0; i < kBeams; ++i) {
      const double angle_rad = scan.start_angle_rad + i * scan.angle_step_rad;
      const double range_m = Range_m(std::cos(angle_rad), std::sin(angle_rad));
      scan.ranges_m.push_back(static_cast<float>(range_m + kNoise_m * rng.Gaussian()));
    }
    return scan;
  }

  // Into the wall by half of what the beam has in its first cell there.
  static double Range_m(double dx, double dy) {
    const double to_x_m = (dx > 0.0 ? kLength_m - kX_m : -kX_m) / dx;
    const double to_y_m = (dy > 0.0 ? kWidth_m - kY_m : -kY_m) / dy;
    const double face_m = std::min(to_x_m, to_y_m);
    constexpr double kCell_m = 0.1;
    const auto left_m = [&](double at_m, double slope) {
      const double in_cell_m = at_m - kCell_m * std::floor(at_m / kCell_m);
      return slope == 0.0 ? std::numeric_limits<double>::infinity()
                          : (slope > 0.0 ? kCell_m - in_cell_m : in_cell_m) / std::abs(slope);
    };
    const bool at_end = to_x_m < to_y_m;
    const double through_m = kCell_m / std::abs(at_end ? dx : dy);
    const double along_m = at_end ? left_m(kY_m + face_m * dy, dy) : left_m(kX_m + face_m * dx, dx);
    return face_m + 0.5 * std::min(through_m, along_m);
  }

  int FreeCellsTakenForWall() const {
    int count = 0;
    for (double x_m = 0.05; x_m < kLength_m; x_m += 0.1) {
      for (const double y_m : {0.05, kWidth_m - 0.05}) {
        count += grid.State(grid.geometry().CellAt({x_m, y_m})) == CellState::kOccupied ? 1 : 0;
      }
    }
    return count;
  }

  static constexpr double kLength_m = 10.0;
  static constexpr double kWidth_m = 2.0;
  static constexpr double kX_m = 0.25;
  static constexpr double kY_m = 1.03;
  OccupancyGrid grid{OccupancyOptions{}};
};

TEST(Beam, ScansAlongAWallDoNotMakeItACellThicker) {
  const int before = Corridor(0.0).FreeCellsTakenForWall();
  EXPECT_GE(before, 20);
  EXPECT_LE(Corridor(OccupancyOptions().surface_depth_m).FreeCellsTakenForWall(), before / 5);
}

}  // namespace beam_test
}  // namespace plumescout
