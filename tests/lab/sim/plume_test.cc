// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/plume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "lab/sim/ageing_depth.h"
#include "lab/sim/concentration_slice.h"
#include "lab/sim/open_air.h"
#include "lab/sim/wind.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace plume_test {

// An open square room.
LayoutRaster OpenRoom(double size_m) {
  Layout layout = SmallLayout();
  layout.size_x_m = layout.size_y_m = size_m;
  layout.boxes.clear();
  layout.openings.clear();
  return *Rasterize(layout);
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
  const MacField wind = UniformWind(raster.occupancy.geometry(), {kWind_mps, 0.0});
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

// The analytic plume in uniform wind u: with t = x / u and sigma^2 = sigma_0^2 + (gamma + 2 K) t,
//   c(x, y) = release / (u depth(t) sqrt(2 pi) sigma) exp(-y^2 / (2 sigma^2)).
// It leaves out what diffuses along the wind: a share of the order of D / (u x).
//
// Each of the n filaments that pass during the mean adds G(y - eta; s^2), s^2 = sigma_0^2 + gamma
// t, with eta ~ N(0, 2 K t): by E G^2 = G(y; s^2 / 2 + 2 K t) / (2 s sqrt(pi)) the mean of n of
// them has the relative variance (E G^2 / (E G)^2 - 1) / n.
TEST(PlumeTest, IsTheGaussianPlumeInTheOpen) {
  GridGeometry geometry;
  geometry.width = 90;
  geometry.height = 40;
  constexpr double kWind_mps = 1.0;
  const LayoutRaster raster = OpenAir(geometry);
  const MacField wind = UniformWind(raster.occupancy.geometry(), {kWind_mps, 0.0});
  const GasSource source{0, 1.05, 2.05, 0.4, 1000.0};
  const GasParameters gas;
  Plume plume(raster, wind, {source}, gas, 3);
  SliceRenderer renderer(raster.occupancy, {source}, gas);
  RunFor(plume, 20.0);
  constexpr int kSlices = 600;
  std::vector<double> mean(geometry.size());
  for (int k = 0; k < kSlices; ++k) {
    const Grid<float> slice = renderer.Render(plume.filaments())[0];
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += slice[i] / kSlices;
    RunFor(plume, 0.2);
  }
  const double passed = gas.filaments_per_s * kSlices * 0.2;
  const double release = FilamentContent_ppm_m3(source, gas) * gas.filaments_per_s;
  const double growth = gas.growth_m2_per_s + 2.0 * gas.diffusivity_m2_per_s;
  const auto normal = [](double y, double variance) {
    return std::exp(-0.5 * y * y / variance) / std::sqrt(2.0 * M_PI * variance);
  };
  for (const double x_m : {2.0, 4.0, 6.0}) {
    for (const double y_m : {-0.8, -0.4, 0.0, 0.4, 0.8}) {
      const double age_s = x_m / kWind_mps;
      const double variance = 0.01 + growth * age_s;
      const double expected =
          release / (kWind_mps * DepthAtAge_m(gas, age_s)) * normal(y_m, variance);
      const double walk = 2.0 * gas.diffusivity_m2_per_s * age_s;
      const double cloud = variance - walk;
      const double square = normal(y_m, cloud / 2.0 + walk) / (2.0 * std::sqrt(M_PI * cloud));
      const double noise =
          std::sqrt((square / std::pow(normal(y_m, variance), 2.0) - 1.0) / passed);
      const double along_wind = growth / 2.0 / (kWind_mps * x_m) * (1.0 + y_m * y_m / variance);
      constexpr double kCutOff = 0.0111;  // exp(-4.5): beyond 3 sigma of each filament
      const std::size_t cell =
          geometry.Index(geometry.CellAt({source.x_m + x_m, source.y_m + y_m}));
      EXPECT_NEAR(mean[cell] / expected, 1.0, 4.0 * noise + along_wind + kCutOff)
          << x_m << ", " << y_m;
    }
  }
}

// In an eddy of 1 rad/s a filament stays at its distance. Euler's steps of angle a = 0.05 would
// stretch it by sqrt(1 + a^2) each, 4.5-fold in 60 s; those of the midpoint rule by
// sqrt(1 + a^4 / 4), 1e-3 in all.
TEST(PlumeTest, KeepsGasOnItsWayAroundAnEddy) {
  GridGeometry geometry;
  geometry.width = geometry.height = 40;
  const LayoutRaster raster = OpenAir(geometry);
  MacField eddy(geometry);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const Cell cell = geometry.CellAtIndex(i);
    const Point2 center = geometry.Center(cell);
    eddy.u(cell.x, cell.y) = -(center.y_m - 2.0);
    eddy.v(cell.x, cell.y) = center.x_m - 2.0;
  }
  GasParameters gas;
  gas.diffusivity_m2_per_s = 0.0;
  gas.filaments_per_s = 1.0;
  Plume plume(raster, eddy, {{0, 3.0, 2.0, 0.4, 1.0}}, gas, 3);
  RunFor(plume, 60.0);
  ASSERT_EQ(plume.left()[0], 0);
  for (const Filament& filament : plume.filaments()) {
    // The staggered wind is constant along a cell's edge: radii waver by a cell.
    EXPECT_NEAR(Distance_m(filament.position, {2.0, 2.0}), 1.0, 0.1);
  }
}

TEST(PlumeTest, ReleasesAsItsSchedulesSay) {
  const LayoutRaster raster = OpenRoom(4.0);
  const MacField still(raster.occupancy.geometry());
  std::vector<GasSource> sources(4, {0, 2.0, 2.0, 0.4, 1.0});
  sources[1].release.start_s = -5.0;
  sources[2].release = {-8.0, 1.0, {}, {}};
  sources[3].release = {-9.0, {}, 2.0, 3.0};
  Plume plume(raster, still, sources, GasParameters{}, 3, -10.0);
  const auto expect_released = [&](std::vector<std::int64_t> expected) {
    EXPECT_EQ(plume.released(), expected) << plume.time_s();
  };
  EXPECT_EQ(plume.time_s(), -10.0);
  RunFor(plume, 1.0);
  expect_released({100, 0, 0, 0});
  RunFor(plume, 3.0);  // until -6 s
  expect_released({400, 0, 200, 200});
  RunFor(plume, 8.0);  // until 2 s
  expect_released({1200, 700, 900, 500});
}

TEST(PlumeTest, HoldsOrHasLostAllOfSourcesThatComeAndGo) {
  const LayoutRaster raster = *Rasterize(SmallLayout());
  const MacField wind = UniformWind(raster.occupancy.geometry(), {1.0, 0.0});
  std::vector<GasSource> sources(2, SmallLayout().sources[0]);
  sources[0].release = {2.0, 6.0, {}, {}};
  sources[1].release = {0.0, {}, 0.5, 1.5};
  Plume plume(raster, wind, sources, GasParameters{}, 3);
  for (int i = 0; i < 600; ++i) {
    plume.Step();
    std::vector<std::int64_t> accounted = plume.left();
    for (const Filament& filament : plume.filaments()) {
      ++accounted[static_cast<std::size_t>(filament.source)];
    }
    ASSERT_EQ(plume.released(), accounted);
  }
  EXPECT_EQ(plume.released()[0], 400);
  EXPECT_GT(plume.left()[0], 0);
}

TEST(PlumeTest, NeverEntersASolid) {
  Layout layout = SmallLayout();
  layout.walls = {{{2.6, 0.4}, {3.2, 2.6}, 0.1, {}}};  // thin and oblique: corners to slip through
  const LayoutRaster raster = *Rasterize(layout);
  const MacField storm = UniformWind(raster.occupancy.geometry(),
                                     {8.0, 0.0});  // 4 cells per step, straight at the walls
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
  const MacField wind = UniformWind(raster.occupancy.geometry(), {1.0, -2.0});
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
  const MacField wind = UniformWind(raster.occupancy.geometry(), {0.1, 0.0});
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

}  // namespace plume_test
}  // namespace plumescout::lab
