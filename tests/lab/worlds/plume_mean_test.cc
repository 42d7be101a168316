// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/plume_mean.h"

#include <gtest/gtest.h>

#include "lab/sim/concentration_slice.h"
#include "lab/sim/open_air.h"
#include "lab/sim/plume.h"

namespace plumescout::lab {
namespace plume_mean_test {

PlumeCase SmallCase() {
  GridGeometry geometry;
  geometry.width = 30;
  geometry.height = 20;
  return {OpenAir(geometry),
          UniformWind(geometry, {1.0, 0.0}),
          {{0, 0.55, 1.0, 0.4, 1000.0}, {1, 1.05, 0.5, 0.4, 500.0}},
          GasParameters{}};
}

TEST(PlumeMeanTest, IsTheMeanOfTheSlicesAfterTheWarmUp) {
  const PlumeCase gas_case = SmallCase();
  const PlumeMean mean = MeanOfFilaments(gas_case, {2.0, 1.0}, 3, nullptr);
  Plume plume(gas_case.raster, gas_case.wind, gas_case.sources, gas_case.gas, 3);
  SliceRenderer renderer(gas_case.raster.occupancy, gas_case.sources, gas_case.gas);
  Grid<float> expected(gas_case.raster.occupancy.geometry());
  for (int step = 1; step <= 60; ++step) {
    plume.Step();
    if (step != 50 && step != 60) continue;  // 2.5 and 3 s
    for (const Grid<float>& layer : renderer.Render(plume.filaments())) {
      for (std::size_t i = 0; i < expected.size(); ++i) expected[i] += layer[i] / 2.0F;
    }
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(mean.ppm[i], expected[i], 1e-5F * (1.0F + expected[i]));
  }
}

TEST(PlumeMeanTest, AccountsForEveryFilamentAtAnyTime) {
  const PlumeMean mean = MeanOfFilaments(SmallCase(), {4.0, 4.0}, 3, nullptr);
  ASSERT_EQ(mean.mass.size(), 17u);  // at 2 Hz from the first step on
  EXPECT_EQ(mean.mass.front().time_s, -4.0);
  for (const MassPoint& point : mean.mass) EXPECT_EQ(point.released, point.inside + point.left);
  EXPECT_EQ(mean.mass.back().released, 1600);
  EXPECT_GT(mean.mass.back().left, 0);
}

TEST(PlumeMeanTest, TellsHowFarItIs) {
  double last = 0.0;
  MeanOfFilaments(SmallCase(), {1.0, 1.0}, 3, [&last](double share) {
    EXPECT_GT(share, last);
    last = share;
  });
  EXPECT_NEAR(last, 1.0, 1e-9);
}

}  // namespace plume_mean_test
}  // namespace plumescout::lab
