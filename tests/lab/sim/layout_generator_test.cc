// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout_generator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>

#include "core/grid/distance_field.h"
#include "core/grid/flood.h"
#include "lab/sim/layout_raster.h"

namespace plumescout::lab {
namespace layout_generator_test {

constexpr std::uint64_t kSeeds = 60;

Grid<std::int32_t> DistanceToSolids_cells2(const LayoutRaster& raster) {
  Grid<std::uint8_t> occupied(raster.occupancy.geometry());
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = raster.occupancy[i] == CellState::kOccupied ? 1 : 0;
  }
  return SquaredDistances_cells2(occupied);
}

bool HasInlet(const Layout& layout) {
  return std::any_of(layout.openings.begin(), layout.openings.end(),
                     [](const Opening& opening) { return opening.inflow_mps.has_value(); });
}
bool HasOutlet(const Layout& layout) {
  return std::any_of(layout.openings.begin(), layout.openings.end(),
                     [](const Opening& opening) { return !opening.inflow_mps.has_value(); });
}

TEST(LayoutGeneratorTest, MakesBuildingsThatRasterize) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Layout layout = GenerateLayout(seed);
    EXPECT_TRUE(Rasterize(layout).ok()) << seed << ": " << Rasterize(layout).status();
    EXPECT_TRUE(HasInlet(layout) && HasOutlet(layout)) << seed;
    EXPECT_GE(layout.walls.size(), 2u) << seed;
  }
}

TEST(LayoutGeneratorTest, LetsARobotReachAllFreeSpace) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Layout layout = GenerateLayout(seed);
    const auto raster = Rasterize(layout);
    ASSERT_TRUE(raster.ok()) << raster.status();
    const Grid<std::int32_t> distance = DistanceToSolids_cells2(*raster);
    constexpr int kInflation_cells2 = 2 * 2;  // 0.2 m
    Grid<std::uint8_t> traversable(distance.geometry());
    for (std::size_t i = 0; i < distance.size(); ++i) {
      traversable[i] = distance[i] > kInflation_cells2 ? 1 : 0;
    }
    const Cell start = distance.geometry().CellAt(layout.start_pose.position());
    EXPECT_EQ(ReachableCells(traversable, {start}, Connectivity::kFour), traversable) << seed;
  }
}

TEST(LayoutGeneratorTest, PutsLeaksAndTheStartInTheOpen) {
  constexpr int kClearance_cells2 = 5 * 5;  // half a metre at least
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Layout layout = GenerateLayout(seed);
    const auto raster = Rasterize(layout);
    ASSERT_TRUE(raster.ok()) << raster.status();
    const Grid<std::int32_t> distance = DistanceToSolids_cells2(*raster);
    const GridGeometry& geometry = distance.geometry();
    EXPECT_GE(distance[geometry.CellAt(layout.start_pose.position())], kClearance_cells2) << seed;
    for (const GasSource& source : layout.sources) {
      EXPECT_GE(distance[geometry.CellAt({source.x_m, source.y_m})], kClearance_cells2) << seed;
    }
  }
}

TEST(LayoutGeneratorTest, KeepsDoorsOffTheEndsOfTheirWalls) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const Wall& wall : GenerateLayout(seed).walls) {
      const double length_m = Distance_m(wall.from, wall.to);
      for (const Door& door : wall.doors) {
        constexpr double kRounding_m = 1e-9;
        EXPECT_GE(door.width_m, 1.0 - kRounding_m) << seed;
        EXPECT_LE(door.width_m, 1.6 + kRounding_m) << seed;
        EXPECT_GE(door.at_m - door.width_m / 2.0, 0.4 - kRounding_m) << seed;
        EXPECT_LE(door.at_m + door.width_m / 2.0, length_m - 0.4 + kRounding_m) << seed;
      }
    }
  }
}

TEST(LayoutGeneratorTest, StaysWithinItsOptions) {
  const GeneratorOptions options{
      .min_size_m = 11, .max_size_x_m = 13, .max_size_y_m = 12, .max_sources = 2};
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Layout layout = GenerateLayout(seed, options);
    EXPECT_TRUE(layout.size_x_m >= 11.0 && layout.size_x_m <= 13.0) << layout.size_x_m;
    EXPECT_TRUE(layout.size_y_m >= 11.0 && layout.size_y_m <= 12.0) << layout.size_y_m;
    EXPECT_TRUE(layout.sources.size() == 1 || layout.sources.size() == 2);
    for (const GasSource& source : layout.sources) {
      EXPECT_TRUE(source.rate_ppm_per_s >= 600.0 && source.rate_ppm_per_s <= 2000.0);
    }
  }
}

TEST(LayoutGeneratorTest, DrawsTheSameBuildingEverywhere) {
  const Layout layout = GenerateLayout(7);
  EXPECT_EQ(layout, GenerateLayout(7));
  EXPECT_EQ(layout.name, "generated_7");
  EXPECT_EQ(Point2({layout.size_x_m, layout.size_y_m}), (Point2{14.8, 19.6}));
  EXPECT_EQ(layout.walls.size(), 4u);
  EXPECT_EQ(layout.boxes.size(), 9u);
  EXPECT_EQ(layout.openings.back(), (Opening{Side::kNorth, 1.2, 2.6, std::nullopt}));
  ASSERT_EQ(layout.sources.size(), 2u);
  EXPECT_EQ(layout.sources[1].x_m, 10.2);
  EXPECT_EQ(layout.sources[1].rate_ppm_per_s, 1200.0);
  EXPECT_EQ(layout.start_pose, (Pose2{12.8, 11.2, 1.09}));
}

TEST(LayoutGeneratorTest, DrawsBuildingsThatDiffer) {
  std::set<std::size_t> walls;
  std::set<double> sizes;
  std::set<std::size_t> sources;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Layout layout = GenerateLayout(seed);
    walls.insert(layout.walls.size());
    sizes.insert(layout.size_x_m * layout.size_y_m);
    sources.insert(layout.sources.size());
  }
  EXPECT_GE(walls.size(), 8u);
  EXPECT_GE(sizes.size(), kSeeds / 2);
  EXPECT_EQ(sources, (std::set<std::size_t>{1, 2, 3, 4}));
}

}  // namespace layout_generator_test
}  // namespace plumescout::lab
