// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/connection_radius.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout {
namespace connection_radius_test {

constexpr double kResolution_m = 0.1;

PlanningOptions Factor(double radius_factor) {
  PlanningOptions options;
  options.radius_factor = radius_factor;
  return options;
}

TEST(ConnectionRadius, FollowsEquation7) {
  // gamma_RGG = 2 (3/2)^(1/2) (150 / pi)^(1/2); r = 1.1 gamma_RGG (ln 300 / 300)^(1/2).
  const double gamma_rgg = 2.0 * std::pow(1.5, 0.5) * std::pow(150.0 / M_PI, 0.5);
  EXPECT_NEAR(ConnectionRadius_m(150.0, 300, kResolution_m, Factor(1.1)),
              1.1 * gamma_rgg * std::pow(std::log(300.0) / 300.0, 0.5), 1e-12);
}

TEST(ConnectionRadius, WidensForTheMixtureIfTold) {
  PlanningOptions options = Factor(1.1);
  const double plain_m = ConnectionRadius_m(100.0, 1000, kResolution_m, options);
  options.mixture_radius = true;
  options.uniform_share = 0.25;
  EXPECT_NEAR(ConnectionRadius_m(100.0, 1000, kResolution_m, options), 2.0 * plain_m, 1e-12);
  options.uniform_share = 0.0;  // no uniform part to widen for
  EXPECT_EQ(ConnectionRadius_m(100.0, 1000, kResolution_m, options), plain_m);
}

TEST(ConnectionRadius, ShrinksWithMoreSamples) {
  EXPECT_LT(ConnectionRadius_m(150.0, 3000, kResolution_m, Factor(1.1)),
            ConnectionRadius_m(150.0, 300, kResolution_m, Factor(1.1)));
}

TEST(ConnectionRadius, IsThreeCellsAtLeast) {
  EXPECT_DOUBLE_EQ(ConnectionRadius_m(0.01, 1, kResolution_m, Factor(1.1)), 0.3);
  EXPECT_DOUBLE_EQ(ConnectionRadius_m(0.0, 0, kResolution_m, Factor(1.1)), 0.3);
  EXPECT_DOUBLE_EQ(ConnectionRadius_m(1e6, 300, 2.0, Factor(1.1)), 6.0) << "coarse cells";
}

TEST(ConnectionRadius, StaysWithinItsLimit) {
  PlanningOptions options = Factor(1.1);
  EXPECT_DOUBLE_EQ(ConnectionRadius_m(1e6, 300, kResolution_m, options), 5.0);
  options.max_connection_radius_m = 8.0;
  EXPECT_DOUBLE_EQ(ConnectionRadius_m(1e6, 300, kResolution_m, options), 8.0);
  options.max_connection_radius_m = 0.1;
  EXPECT_DOUBLE_EQ(ConnectionRadius_m(1e6, 300, kResolution_m, options), 0.3);
}

TEST(ConnectionRadius, FollowsEquation7OnAnyAreaWithoutALimit) {
  PlanningOptions options = Factor(1.1);
  options.max_connection_radius_m = 0.0;
  const double gamma_rgg = 2.0 * std::pow(1.5, 0.5) * std::pow(1e6 / M_PI, 0.5);
  EXPECT_NEAR(ConnectionRadius_m(1e6, 300, kResolution_m, options),
              1.1 * gamma_rgg * std::pow(std::log(300.0) / 300.0, 0.5), 1e-9);
  EXPECT_DOUBLE_EQ(ConnectionRadius_m(0.01, 1, kResolution_m, options), 0.3);
}

}  // namespace connection_radius_test
}  // namespace plumescout
