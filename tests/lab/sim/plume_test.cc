// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/plume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "lab/sim/wind.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace {

// An open square room and the same wind everywhere.
LayoutRaster OpenRoom(double size_m) {
  Layout layout = SmallLayout();
  layout.size_x_m = layout.size_y_m = size_m;
  layout.boxes.clear();
  layout.openings.clear();
  return *Rasterize(layout);
}

MacField UniformWind(const LayoutRaster& raster, double u_mps) {
  MacField wind(raster.occupancy.geometry());
  for (int y = 0; y < raster.occupancy.height(); ++y) {
    for (int x = 0; x <= raster.occupancy.width(); ++x) wind.u(x, y) = u_mps;
  }
  return wind;
}

void RunFor(Plume& plume, double duration_s) {
  const auto steps = static_cast<int>(std::lround(duration_s / Plume::kStep_s));
  for (int i = 0; i < steps; ++i) plume.Step();
}

TEST(PlumeTest, HoldsOrHasLostAllThatWasReleased) {
  const LayoutRaster raster = *Rasterize(SmallLayout());
  const MacField wind = *SolveWind(raster.flow, {});
  const std::vector<GasSource> sources = {{0, 1.05, 1.55, 0.4, 1000.0}, {1, 3.0, 2.5, 0.4, 10.0}};
  Plume plume(raster, wind, sources, GasParameters{}, 3);
  RunFor(plume, 30.0);
  std::vector<std::int64_t> inside(2);
  for (const Filament& filament : plume.filaments()) {
    ++inside[static_cast<std::size_t>(filament.source)];
  }
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(plume.released()[s], 3000);  // 100 per second
    EXPECT_EQ(plume.released()[s], inside[s] + plume.left()[s]);
    EXPECT_GT(plume.left()[s], 0);
    EXPECT_GT(inside[s], 0);
  }
}

TEST(PlumeTest, ReleasesRatesThatAreNoWholeNumberPerStep) {
  const LayoutRaster raster = OpenRoom(4.0);
  const MacField still(raster.occupancy.geometry());
  GasParameters gas;
  gas.filaments_per_s = 33.0;  // 1.65 per step
  Plume plume(raster, still, {{0, 2.0, 2.0, 0.4, 1.0}}, gas, 3);
  RunFor(plume, 20.0);
  EXPECT_EQ(plume.released()[0], 660);
}

// Filaments are independent; after age t each lies at (u t, N(0, 2 K t)).
TEST(PlumeTest, SpreadsSymmetricallyInUniformWind) {
  const LayoutRaster raster = OpenRoom(12.0);
  constexpr double kWind_mps = 0.5;
  const MacField wind = UniformWind(raster, kWind_mps);
  GasParameters gas;
  gas.diffusivity_m2_per_s = 0.02;
  const Point2 source{1.0, 6.0};
  Plume plume(raster, wind, {{0, source.x_m, source.y_m, 0.4, 1.0}}, gas, 3);
  RunFor(plume, 15.0);
  double east = 0.0;
  double north = 0.0;
  double north2 = 0.0;
  for (const Filament& filament : plume.filaments()) {
    const double age_s = filament.age_steps * Plume::kStep_s;
    const double sigma_m = std::sqrt(2.0 * gas.diffusivity_m2_per_s * age_s);
    east += (filament.position.x_m - source.x_m - kWind_mps * age_s) / sigma_m;
    north += (filament.position.y_m - source.y_m) / sigma_m;
    north2 += std::pow((filament.position.y_m - source.y_m) / sigma_m, 2.0);
  }
  // Sums of n = 1500 standard normal draws and of their squares, to 4 standard deviations.
  const auto n = static_cast<double>(plume.filaments().size());
  ASSERT_EQ(n, 1500.0);
  EXPECT_NEAR(east, 0.0, 4.0 * std::sqrt(n));
  EXPECT_NEAR(north, 0.0, 4.0 * std::sqrt(n));
  EXPECT_NEAR(north2, n, 4.0 * std::sqrt(2.0 * n));
}

TEST(PlumeTest, NeverEntersASolid) {
  Layout layout = SmallLayout();
  layout.walls = {{{2.6, 0.4}, {3.2, 2.6}, 0.1, {}}};  // thin and oblique: corners to slip through
  const LayoutRaster raster = *Rasterize(layout);
  const MacField storm = UniformWind(raster, 8.0);  // 4 cells per step, straight at the walls
  GasParameters gas;
  gas.diffusivity_m2_per_s = 0.5;
  Plume plume(raster, storm, layout.sources, gas, 3);
  for (int i = 0; i < 200; ++i) {
    plume.Step();
    for (const Filament& filament : plume.filaments()) {
      const Cell cell = raster.occupancy.geometry().CellAt(filament.position);
      ASSERT_EQ(raster.occupancy[cell], CellState::kFree);
    }
  }
  EXPECT_GT(plume.filaments().size(), 0u);
}

TEST(PlumeTest, SlidesAlongAWallItIsBlownAgainst) {
  const LayoutRaster raster = OpenRoom(6.0);
  MacField wind = UniformWind(raster, 1.0);
  for (int y = 0; y <= raster.occupancy.height(); ++y) {
    for (int x = 0; x < raster.occupancy.width(); ++x) wind.v(x, y) = -2.0;
  }
  GasParameters gas;
  gas.diffusivity_m2_per_s = 0.0;
  Plume plume(raster, wind, {{0, 1.0, 0.25, 0.4, 1.0}}, gas, 3);  // right above the southern wall
  RunFor(plume, 2.0);
  const Filament& oldest = plume.filaments().front();
  EXPECT_NEAR(oldest.position.x_m, 3.0, 1e-9);
  EXPECT_NEAR(oldest.position.y_m, 0.25, 0.1);  // within its row of cells
}

// Diffusion in a closed room fills it evenly whatever stands in it: (pi / 4 m)^2 K = 0.3 /s, so
// after 25 s nothing is left of where the gas came from.
TEST(PlumeTest, FillsAStillRoomEvenly) {
  Layout layout = SmallLayout();
  layout.openings.clear();
  layout.boxes = {{{1.0, 1.0}, {3.0, 1.6}}};
  layout.sources[0].y_m = 0.5;
  const LayoutRaster raster = *Rasterize(layout);
  const MacField still(raster.occupancy.geometry());
  GasParameters gas;
  gas.diffusivity_m2_per_s = 0.5;
  Plume plume(raster, still, layout.sources, gas, 3);
  RunFor(plume, 60.0);
  const auto in_south = [](Point2 p) { return p.y_m < 1.0; };
  double old = 0.0;
  double old_south = 0.0;
  for (const Filament& filament : plume.filaments()) {
    if (filament.age_steps * Plume::kStep_s < 25.0) continue;
    old += 1.0;
    old_south += in_south(filament.position) ? 1.0 : 0.0;
  }
  double cells = 0.0;
  double cells_south = 0.0;
  for (std::size_t i = 0; i < raster.occupancy.size(); ++i) {
    if (raster.occupancy[i] != CellState::kFree) continue;
    const GridGeometry& geometry = raster.occupancy.geometry();
    cells += 1.0;
    cells_south += in_south(geometry.Center(geometry.CellAtIndex(i))) ? 1.0 : 0.0;
  }
  const double share = cells_south / cells;
  ASSERT_GE(old, 3500.0);  // 35 s of release
  EXPECT_NEAR(old_south, share * old, 4.0 * std::sqrt(old * share * (1.0 - share)));  // binomial
}

TEST(PlumeTest, DependsOnItsSeedAlone) {
  const LayoutRaster raster = *Rasterize(SmallLayout());
  const MacField wind = UniformWind(raster, 0.1);
  const auto filaments = [&](std::uint64_t seed) {
    Plume plume(raster, wind, SmallLayout().sources, GasParameters{}, seed);
    RunFor(plume, 5.0);
    return plume.filaments();
  };
  EXPECT_TRUE(filaments(3) == filaments(3));
  EXPECT_FALSE(filaments(3) == filaments(4));
}

TEST(PlumeTest, GivesAFreshFilamentItsThreeDimensionalPeak) {
  const GasSource source{0, 0.0, 0.0, 0.4, 1750.0};
  const FilamentShape shape = ShapeAtAge(source, GasParameters{}, 0.0);
  EXPECT_NEAR(shape.peak_ppm, 17.5, 1e-12);  // the rate over 100 filaments per second
  EXPECT_NEAR(shape.sigma_m, 0.1, 1e-15);
}

TEST(PlumeTest, ConservesAFilamentsGasAsItGrows) {
  const GasSource source{0, 0.0, 0.0, 0.4, 1000.0};
  const GasParameters gas;
  for (const double age_s : {0.0, 1.0, 10.0, 1000.0}) {
    const FilamentShape shape = ShapeAtAge(source, gas, age_s);
    const double sigma2 = 0.01 + 0.0015 * age_s;  // 15 cm^2/s
    EXPECT_NEAR(shape.sigma_m * shape.sigma_m, sigma2, 1e-12);
    const double height_m = std::sqrt(2.0 * M_PI * (sigma2 + 2.0 * 0.02 * age_s));
    const double depth_m = height_m < 2.05 ? height_m : 2.05;
    // 0.01575 ppm m^3 per filament and ppm: (2 pi)^1.5 * (0.1 m)^3.
    EXPECT_NEAR(shape.peak_ppm * 2.0 * M_PI * sigma2 * depth_m, 10.0 * 0.01575, 1e-4);
  }
}

}  // namespace
}  // namespace plumescout::lab
