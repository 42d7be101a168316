// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/advection_diffusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lab/sim/ageing_depth.h"
#include "lab/sim/concentration_slice.h"
#include "lab/sim/open_air.h"
#include "lab/sim/plume.h"
#include "lab/sim/wind.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace advection_diffusion_test {

// A depth that never changes: 0.25 m is that of a fresh filament, sqrt(2 pi) 0.1 m.
GasParameters ConstantDepth() {
  GasParameters gas;
  gas.mixing_depth_m = 0.25;
  return gas;
}

double Released_ppm_m3_per_s(const GasSource& source, const GasParameters& gas) {
  return FilamentContent_ppm_m3(source, gas) * gas.filaments_per_s;
}

// All that is released goes up where the wind flows together, at the rate of its convergence: the
// balance of the whole room, to the rounding of float layers.
TEST(AdvectionDiffusionTest, WhatIsReleasedInAClosedRoomGoesUpWithTheAir) {
  Layout layout = SmallLayout();
  layout.openings.clear();
  layout.sources.push_back({1, 3.0, 2.4, 0.4, 400.0});
  const LayoutRaster raster = *Rasterize(layout);
  MacField wind(raster.occupancy.geometry());
  for (int y = 10; y < 20; ++y) wind.u(31, y) = 0.3;  // from column 30 to column 31
  const auto layers = SteadyConcentration(raster, wind, layout.sources, ConstantDepth());
  ASSERT_TRUE(layers.ok()) << layers.status();
  for (std::size_t s = 0; s < 2; ++s) {
    double upwards = 0.0;  // ppm m^3/s
    for (int y = 10; y < 20; ++y) upwards += 0.3 * (*layers)[s][Cell(31, y)] * 0.1 * 0.25;
    const double released = Released_ppm_m3_per_s(layout.sources[s], ConstantDepth());
    EXPECT_NEAR(upwards, released, 1e-5 * released);
  }
}

// The two-dimensional Gaussian plume: along x the flow carries all, across it has the variance
// sigma_0^2 + 2 D x / u. Differences of a second-order scheme at sigma = 1.5 ... 4 cells: 5 %.
TEST(AdvectionDiffusionTest, IsTheGaussianPlumeInTheOpen) {
  GridGeometry geometry;
  geometry.width = 80;
  geometry.height = 60;
  constexpr double kWind_mps = 1.0;
  const GasSource source{0, 1.05, 3.05, 0.4, 1000.0};
  const GasParameters gas = ConstantDepth();
  const auto layers = SteadyConcentration(OpenAir(geometry),
                                          UniformWind(geometry, {kWind_mps, 0.0}), {source}, gas);
  ASSERT_TRUE(layers.ok()) << layers.status();
  const double diffusivity = gas.diffusivity_m2_per_s + gas.growth_m2_per_s / 2.0;
  for (const double x_m : {1.5, 3.0, 5.0}) {
    const double variance_m2 = 0.01 + 2.0 * diffusivity * x_m / kWind_mps;
    const double axis_ppm = Released_ppm_m3_per_s(source, gas) /
                            (kWind_mps * 0.25 * std::sqrt(2.0 * M_PI * variance_m2));
    for (const double y_m : {-0.5, -0.3, 0.0, 0.2, 0.4}) {
      const double expected = axis_ppm * std::exp(-0.5 * y_m * y_m / variance_m2);
      const Cell cell = geometry.CellAt({source.x_m + x_m, source.y_m + y_m});
      EXPECT_NEAR((*layers)[0][cell], expected, 0.05 * axis_ppm) << x_m << ", " << y_m;
    }
  }
}

// Against the filaments' mean over 60 s in a room with a box. Both are means of the same law but
// for walls, where clouds of filaments are cut off: 0.85 is the least the two must agree.
TEST(AdvectionDiffusionTest, AgreesWithTheMeanOfTheFilaments) {
  const Layout layout = SmallLayout();
  const LayoutRaster raster = *Rasterize(layout);
  const MacField wind = *SolveWind(raster.flow, {});
  const Grid<float> steady = (*SteadyConcentration(raster, wind, layout.sources, layout.gas))[0];
  Plume plume(raster, wind, layout.sources, layout.gas, 3);
  SliceRenderer renderer(raster.occupancy, layout.sources, layout.gas);
  std::vector<double> mean(steady.size());
  constexpr int kWarmUp = 600;
  constexpr int kSteps = 1200;
  for (int step = 0; step < kWarmUp + kSteps; ++step) {
    plume.Step();
    if (step < kWarmUp || step % 10 != 0) continue;
    const Grid<float> slice = renderer.Render(plume.filaments())[0];
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += slice[i] / (kSteps / 10.0);
  }
  constexpr double kFloor_ppm = 0.05;  // what a sensor can detect
  double n = 0.0;
  double a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (raster.occupancy[i] != CellState::kFree) continue;
    const double x = std::log(std::max(kFloor_ppm, mean[i]));
    const double y = std::log(std::max<double>(kFloor_ppm, steady[i]));
    n += 1.0;
    a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  const double correlation = (n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b));
  EXPECT_GE(correlation, 0.85);
}

// A closed room holds what was released: in the middle of the window, at a constant depth.
TEST(AdvectionDiffusionTest, MeanOfAClosedRoomIsWhatWasReleasedUntilItsMiddle) {
  Layout layout = SmallLayout();
  layout.openings.clear();
  const LayoutRaster raster = *Rasterize(layout);
  const MacField still(raster.occupancy.geometry());
  const MeanWindow window{50.0, 100.0};
  const auto layers = MeanConcentration(raster, still, layout.sources, ConstantDepth(), window);
  ASSERT_TRUE(layers.ok()) << layers.status();
  double content = 0.0;  // ppm m^3
  for (const float ppm : (*layers)[0].values()) content += ppm * 0.1 * 0.1 * 0.25;
  // The steps' ends are averaged: half a step later.
  const double until_s = 50.0 + 100.0 / 2.0 + kMeanStep_s / 2.0;
  const double expected = until_s * Released_ppm_m3_per_s(layout.sources[0], ConstantDepth());
  EXPECT_NEAR(content, expected, 1e-5 * expected);
}

TEST(AdvectionDiffusionTest, MeanBecomesSteady) {
  const Layout layout = SmallLayout();
  const LayoutRaster raster = *Rasterize(layout);
  const MacField wind = *SolveWind(raster.flow, {});
  const auto steady = SteadyConcentration(raster, wind, layout.sources, layout.gas);
  const auto mean =
      MeanConcentration(raster, wind, layout.sources, layout.gas, MeanWindow{2000.0, 10.0});
  ASSERT_TRUE(mean.ok()) << mean.status();
  for (std::size_t i = 0; i < raster.occupancy.size(); ++i) {
    EXPECT_NEAR((*mean)[0][i], (*steady)[0][i], 0.001 + 0.001 * (*steady)[0][i]);
  }
}

TEST(AdvectionDiffusionTest, RefusesWindowsOutOfRange) {
  const Layout layout = SmallLayout();
  const LayoutRaster raster = *Rasterize(layout);
  const MacField still(raster.occupancy.geometry());
  for (const MeanWindow& window : {MeanWindow{-1.0, 1.0}, MeanWindow{0.0, 0.0},
                                   MeanWindow{std::nan(""), 1.0}, MeanWindow{1.0, 1e300}}) {
    EXPECT_EQ(MeanConcentration(raster, still, layout.sources, layout.gas, window).status().code(),
              absl::StatusCode::kInvalidArgument);
  }
}

TEST(AdvectionDiffusionTest, KeepsGasOutOfSolidsAndIsNowhereNegative) {
  const Layout layout = SmallLayout();
  const LayoutRaster raster = *Rasterize(layout);
  const MacField wind = *SolveWind(raster.flow, {});
  const Grid<float> ppm = (*SteadyConcentration(raster, wind, layout.sources, layout.gas))[0];
  for (std::size_t i = 0; i < ppm.size(); ++i) {
    EXPECT_GE(ppm[i], 0.0F);
    if (raster.occupancy[i] != CellState::kFree) {
      EXPECT_EQ(ppm[i], 0.0F);
    }
  }
}

TEST(AdvectionDiffusionTest, RefusesARoomThatGasCannotLeave) {
  Layout layout = SmallLayout();
  layout.openings.clear();
  const LayoutRaster raster = *Rasterize(layout);
  const MacField still(raster.occupancy.geometry());
  EXPECT_EQ(SteadyConcentration(raster, still, layout.sources, layout.gas).status().code(),
            absl::StatusCode::kFailedPrecondition);
}

}  // namespace advection_diffusion_test
}  // namespace plumescout::lab
