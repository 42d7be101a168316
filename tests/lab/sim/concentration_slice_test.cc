// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/concentration_slice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lab/sim/ageing_depth.h"
#include "lab/sim/open_air.h"
#include "tests/support/grid_art.h"

namespace plumescout::lab {
namespace concentration_slice_test {

// Layers are float: relative rounding of a product of two exponentials, with room.
constexpr double kFloatShare = 1e-5;

Grid<CellState> OpenSpace(int size) {
  GridGeometry geometry;
  geometry.width = geometry.height = size;
  return Grid<CellState>(geometry, CellState::kFree);
}

const std::vector<GasSource> kSources = {{0, 0.0, 0.0, 0.4, 1000.0}, {1, 0.0, 0.0, 0.4, 500.0}};

TEST(ConcentrationSliceTest, IsTheGaussianOfAFilamentAtTheCellsCentres) {
  const Grid<CellState> open = OpenSpace(41);
  SliceRenderer renderer(open, kSources, GasParameters{});
  const Filament filament{{2.03, 2.09}, 200, 0};  // 10 s old
  const auto layers = renderer.Render({filament});
  const FilamentShape shape = ShapeAtAge(kSources[0], GasParameters{}, 10.0);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Point2 center = open.geometry().Center(open.geometry().CellAtIndex(i));
    const double r = Distance_m(center, filament.position) / shape.sigma_m;
    const double expected = r <= 3.0 ? shape.peak_ppm * std::exp(-0.5 * r * r) : 0.0;
    EXPECT_NEAR(layers[0][i], expected, kFloatShare * shape.peak_ppm);
  }
}

// Beyond 3 sigma lies exp(-4.5) = 1.1 % of a plane Gaussian; at sigma = 3 cells the sum over cells
// is the integral to far better than that.
TEST(ConcentrationSliceTest, HoldsTheFilamentsGasButForWhatIsCutOff) {
  const Grid<CellState> open = OpenSpace(61);
  GasParameters gas;
  gas.initial_sigma_m = 0.3;
  SliceRenderer renderer(open, kSources, gas);
  const auto layers = renderer.Render({{{3.05, 3.05}, 0, 0}});
  double sum_ppm = 0.0;
  for (const float ppm : layers[0].values()) sum_ppm += ppm;
  const double depth_m = std::sqrt(2.0 * M_PI) * 0.3;
  const double content = sum_ppm * 0.1 * 0.1 * depth_m;
  const double released = FilamentContent_ppm_m3(kSources[0], gas);
  EXPECT_NEAR(content / released, 1.0 - std::exp(-4.5), 0.003);
}

// A plume far from walls, at a depth that does not change: the slice times the depth is the gas
// inside. Of each filament exp(-4.5) lies beyond 3 sigma, and the cells of its circle are off by at
// most its rim, one cell's diagonal wide: 2 pi 3 sigma * sqrt(2) h * exp(-4.5) / (2 pi sigma^2) =
// 0.047 h / sigma of it, at either sign for filaments at random places.
TEST(ConcentrationSliceTest, IntegralTimesDepthIsTheGasInside) {
  GridGeometry geometry;
  geometry.width = 120;
  geometry.height = 60;
  const LayoutRaster raster = OpenAir(geometry);
  const MacField wind = UniformWind(geometry, {0.4, 0.1});
  GasParameters gas;
  gas.mixing_depth_m = 0.25;  // that of a fresh filament
  const GasSource source{0, 2.05, 2.05, 0.4, 1000.0};
  Plume plume(raster, wind, {source}, gas, 3);
  SliceRenderer renderer(raster.occupancy, {source}, gas);
  for (int i = 0; i < 300; ++i) plume.Step();
  ASSERT_EQ(plume.left()[0], 0);
  double sum_ppm = 0.0;
  for (const float ppm : renderer.Render(plume.filaments())[0].values()) sum_ppm += ppm;
  const auto filaments = static_cast<double>(plume.filaments().size());
  const double inside = filaments * FilamentContent_ppm_m3(source, gas);
  EXPECT_NEAR(sum_ppm * 0.1 * 0.1 * 0.25 / inside, 1.0 - std::exp(-4.5),
              4.0 * 0.047 / std::sqrt(filaments));
}

TEST(ConcentrationSliceTest, AddsUpFilamentsBySource) {
  const Grid<CellState> open = OpenSpace(21);
  SliceRenderer renderer(open, kSources, GasParameters{});
  const Filament first{{1.05, 1.05}, 0, 0};
  const Filament second{{1.05, 1.05}, 0, 1};
  const auto layers = renderer.Render({first, second, second});
  ASSERT_EQ(layers.size(), 2u);
  const Cell cell{10, 10};
  EXPECT_NEAR(layers[0][cell], 10.0, 10.0 * kFloatShare);
  EXPECT_NEAR(layers[1][cell], 2.0 * 5.0, 10.0 * kFloatShare);
}

TEST(ConcentrationSliceTest, PutsNoGasBehindOrIntoAWall) {
  const testing::GridArt art = {
      "...#hhh",  //
      ".X.#hhh",  //
      "...#hhh",
  };
  const Grid<CellState> grid = testing::GridFromArt(art);
  GasParameters gas;
  gas.initial_sigma_m = 0.5;
  SliceRenderer renderer(grid, kSources, gas);
  const Point2 source = grid.geometry().Center(testing::CellInArt(art, 'X'));
  const auto layers = renderer.Render({{source, 0, 0}});
  for (const Cell cell : testing::CellsInArt(art, 'h')) EXPECT_EQ(layers[0][cell], 0.0F);
  for (const Cell cell : testing::CellsInArt(art, '#')) EXPECT_EQ(layers[0][cell], 0.0F);
  for (const Cell cell : testing::CellsInArt(art, '.')) EXPECT_GT(layers[0][cell], 0.0F);
}

TEST(ConcentrationSliceTest, CapsTheRadiusOfHugeFilaments) {
  const Grid<CellState> open = OpenSpace(101);
  GasParameters gas;
  gas.initial_sigma_m = 5.0;
  SliceRenderer renderer(open, kSources, gas);
  const auto layers = renderer.Render({{{5.05, 5.05}, 0, 0}});
  EXPECT_GT(layers[0][Cell(49 + LineOfSight::kMaxRadius_cells, 50)], 0.0F);
  EXPECT_EQ(layers[0][Cell(51 + LineOfSight::kMaxRadius_cells, 50)], 0.0F);
}

TEST(ConcentrationSliceTest, StaysOnTheRasterAtItsCorners) {
  const Grid<CellState> open = OpenSpace(10);
  SliceRenderer renderer(open, kSources, GasParameters{});
  const auto layers = renderer.Render({{{0.01, 0.01}, 100, 0}, {{0.99, 0.99}, 100, 0}});
  EXPECT_GT(layers[0][Cell(0, 0)], 0.0F);
  EXPECT_GT(layers[0][Cell(9, 9)], 0.0F);
}

TEST(ConcentrationSliceTest, IgnoresFilamentsOutsideTheFreeCells) {
  const Grid<CellState> wall(OpenSpace(5).geometry(), CellState::kOccupied);
  SliceRenderer renderer(wall, kSources, GasParameters{});
  const auto layers = renderer.Render({{{0.25, 0.25}, 0, 0}, {{-1.0, 9.0}, 0, 0}});
  for (const float ppm : layers[0].values()) EXPECT_EQ(ppm, 0.0F);
}

}  // namespace concentration_slice_test
}  // namespace plumescout::lab
