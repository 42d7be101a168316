// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/gaussian_plume.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/types/rng.h"
#include "lab/sim/ageing_depth.h"
#include "lab/sim/plume.h"

namespace plumescout::lab {
namespace gaussian_plume_test {

GaussianPlume Plume1000() {
  GaussianPlume plume;
  plume.source.rate_ppm_per_s = 1000.0;
  plume.wind_mps = 2.0;
  return plume;
}

// What flows through a section across the wind is what was released.
TEST(GaussianPlumeTest, CarriesTheReleaseThroughEverySection) {
  const GaussianPlume plume = Plume1000();
  const double release = FilamentContent_ppm_m3(plume.source, plume.gas) * 100.0;
  for (const double x_m : {0.5, 3.0, 20.0}) {
    double flow = 0.0;  // ppm m^3/s, by the trapezoidal rule
    for (double y_m = -10.0; y_m < 10.0; y_m += 0.01) flow += plume.At_ppm(x_m, y_m) * 0.01;
    flow *= 2.0 * DepthAtAge_m(plume.gas, x_m / 2.0);
    EXPECT_NEAR(flow, release, 1e-6 * release);
  }
}

TEST(GaussianPlumeTest, GrowsAsFilamentsDoAndWalk) {
  const GaussianPlume plume = Plume1000();
  const double variance = 0.01 + (0.0015 + 0.04) * 3.0;  // at 3 s
  EXPECT_NEAR(plume.At_ppm(6.0, 0.5) / plume.At_ppm(6.0, 0.0), std::exp(-0.5 * 0.25 / variance),
              1e-9);
}

// The noise by drawing: means of 50 clouds at random places, 4000 times. The standard deviation of
// a standard deviation from 4000 values is 1.1 %; the shares that are no noise are subtracted.
TEST(GaussianPlumeTest, ToleranceIsFourDeviationsOfTheMeanOfClouds) {
  const GaussianPlume plume = Plume1000();
  constexpr double kX_m = 6.0, kY_m = 0.4, kAge_s = 3.0;
  constexpr int kClouds = 50, kMeans = 4000;
  const double cloud = 0.01 + 0.0015 * kAge_s;
  const double walk = 0.04 * kAge_s;
  Rng rng(5);
  double sum = 0.0, squares = 0.0;
  for (int m = 0; m < kMeans; ++m) {
    double mean = 0.0;
    for (int c = 0; c < kClouds; ++c) {
      const double off = kY_m - std::sqrt(walk) * rng.Gaussian();
      mean += std::exp(-0.5 * off * off / cloud) / kClouds;
    }
    sum += mean / kMeans;
    squares += mean * mean / kMeans;
  }
  const double noise = std::sqrt(squares - sum * sum) / sum;
  const double others = plume.Tolerance(kX_m, kY_m, 1e12);
  EXPECT_NEAR((plume.Tolerance(kX_m, kY_m, kClouds) - others) / 4.0, noise, 0.05 * noise);
  EXPECT_LT(others, 0.02);
}

}  // namespace gaussian_plume_test
}  // namespace plumescout::lab
