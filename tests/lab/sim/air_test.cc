// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/air.h"

#include <gtest/gtest.h>

#include "core/grid/ray.h"
#include "core/types/rng.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace air_test {

// Points in and around a raster whose origin is not at zero.
struct RandomAir {
  RandomAir() : raster(*Rasterize(SmallLayout())) {
    GridGeometry geometry = raster.occupancy.geometry();
    geometry.origin_x_m = -1.5;
    geometry.origin_y_m = 7.0;
    wind = MacField(geometry);
    Grid<CellState> occupancy(geometry);
    Grid<std::uint8_t> fluid(geometry);
    for (std::size_t i = 0; i < geometry.size(); ++i) {
      occupancy[i] = raster.occupancy[i];
      fluid[i] = raster.flow.fluid[i];
      const Cell cell = geometry.CellAtIndex(i);
      wind.u(cell.x, cell.y) = rng.Gaussian();
      wind.v(cell.x, cell.y) = rng.Gaussian();
    }
    raster.occupancy = occupancy;
    raster.flow.fluid = fluid;
  }
  Point2 Point() { return {-1.5 + rng.Uniform(-0.5, 4.5), 7.0 + rng.Uniform(-0.5, 3.5)}; }

  Rng rng{7};
  LayoutRaster raster;
  MacField wind;
};

TEST(AirTest, HasTheWindOfTheField) {
  RandomAir random;
  const Air air(random.raster, random.wind);
  for (int i = 0; i < 10'000; ++i) {
    const Point2 point = random.Point();
    const Velocity expected = random.wind.At(point);
    const Velocity velocity = air.WindAt(point);
    // Faces are float: of the order of 1 m/s.
    EXPECT_NEAR(velocity.u_mps, expected.u_mps, 1e-6);
    EXPECT_NEAR(velocity.v_mps, expected.v_mps, 1e-6);
  }
}

TEST(AirTest, TellsSpacesAsTheRasterDoes) {
  RandomAir random;
  const Air air(random.raster, random.wind);
  const Grid<GasSpace> spaces = GasSpaces(random.raster);
  for (int i = 0; i < 10'000; ++i) {
    const Point2 point = random.Point();
    EXPECT_EQ(air.SpaceAt(point), spaces.At(spaces.geometry().CellAt(point), GasSpace::kOutside));
  }
}

TEST(AirTest, IsClearWhereAWalkMeetsNoSolid) {
  RandomAir random;
  const Air air(random.raster, random.wind);
  const Grid<GasSpace> spaces = GasSpaces(random.raster);
  int clear = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Point2 from = random.Point();
    const Point2 to{from.x_m + 0.2 * random.rng.Gaussian(), from.y_m + 0.2 * random.rng.Gaussian()};
    if (air.SpaceAt(from) == GasSpace::kSolid) continue;
    const bool walked = WalkSegment(spaces.geometry(), from, to, [&](Cell cell, double) {
      return spaces.At(cell, GasSpace::kOutside) != GasSpace::kSolid;
    });
    ASSERT_EQ(air.Clear(from, to), walked);
    clear += walked ? 1 : 0;
  }
  EXPECT_GT(clear, 1000);
}

}  // namespace air_test
}  // namespace plumescout::lab
