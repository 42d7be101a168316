// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/decaying_plume.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace decaying_plume_test {

// How far the plume is from  u dc/dx = D (c_xx + c_rr + c_r / r) - c / tau, as a share of c / tau,
// by central differences.
double Residual(const DecayingPlume& plume, double x_m, double r_m) {
  constexpr double kStep_m = 1e-3;
  const auto c = [&](double dx, double dr) {
    return plume.PerRate_s_per_m3(x_m + dx * kStep_m, r_m + dr * kStep_m);
  };
  const double along = (c(1, 0) - c(-1, 0)) / (2.0 * kStep_m);
  const double outward = (c(0, 1) - c(0, -1)) / (2.0 * kStep_m);
  const double curvature =
      (c(1, 0) + c(-1, 0) + c(0, 1) + c(0, -1) - 4.0 * c(0, 0)) / (kStep_m * kStep_m);
  const double loss = c(0, 0) / plume.lifetime_s;
  return (plume.diffusivity_m2_per_s * (curvature + outward / r_m) - plume.wind_mps * along -
          loss) /
         loss;
}

// Truncation: the fourth derivatives are some 1 / 0.3 m^4 of c at most here, times h^2 / 12, over
// 1 / tau: 1e-4. Rounding: 1e-16 / h^2 over 1 / tau: 1e-9.
TEST(DecayingPlumeTest, SolvesAdvectionDiffusionAndDecay) {
  for (const DecayingPlume& plume : {DecayingPlume{}, DecayingPlume{0.5, 2.0, 30.0, 0.5}}) {
    for (const double x_m : {-3.0, -0.8, 1.0, 7.0, 40.0}) {
      for (const double r_m : {0.6, 2.0, 5.0}) {
        EXPECT_NEAR(Residual(plume, x_m, r_m), 0.0, 2e-3) << x_m << " " << r_m;
      }
    }
  }
}

// In the steady state as much decays everywhere as the source releases: the integral of c is tau.
// In spherical shells, with t = the square root of 1 - cos(angle) to be fine near the axis.
TEST(DecayingPlumeTest, HoldsWhatTheSourceReleasesInALifetime) {
  DecayingPlume plume;
  plume.particle_radius_m = 1e-6;
  constexpr double kShell_m = 0.1;
  constexpr int kShells = 4000;  // to 400 m: exp(-400 / 24) is left out
  constexpr int kAngles = 600;
  double held_s = 0.0;
  for (int i = 0; i < kShells; ++i) {
    const double r_m = (i + 0.5) * kShell_m;
    for (int k = 0; k < kAngles; ++k) {
      const double dt = std::sqrt(2.0) / kAngles;
      const double t = (k + 0.5) * dt;
      const double cosine = 1.0 - t * t;
      const double sine = std::sqrt(1.0 - cosine * cosine);
      const double solid_angle = 2.0 * M_PI * 2.0 * t * dt;
      held_s +=
          plume.PerRate_s_per_m3(r_m * cosine, r_m * sine) * r_m * r_m * solid_angle * kShell_m;
    }
  }
  EXPECT_NEAR(held_s, plume.lifetime_s, 2e-3 * plume.lifetime_s);
}

// Far downwind: a Gaussian of variance 2 D x / u, thinned by 1 / (4 pi D x) and exp(-x / (u tau)).
// The next terms are shares of D / (u^2 tau) = 1 / 72 of x / (u tau) and of r^2 / x^2.
TEST(DecayingPlumeTest, IsTheGaussianPlumeNearItsAxis) {
  const DecayingPlume plume;
  for (const double x_m : {5.0, 12.0}) {
    const double gaussian = std::exp(-x_m / 24.0 - 0.5 / (2.0 * x_m / 3.0)) / (4.0 * M_PI * x_m);
    EXPECT_NEAR(plume.PerRate_s_per_m3(x_m, 1.0) / gaussian, 1.0, 0.03);
  }
}

TEST(DecayingPlumeTest, GrowsNoMoreWithinAParticle) {
  const DecayingPlume plume;
  const double surface = plume.PerRate_s_per_m3(0.0, plume.particle_radius_m);
  EXPECT_EQ(plume.PerRate_s_per_m3(0.0, 0.0), surface);
  EXPECT_GT(surface, plume.PerRate_s_per_m3(0.0, 1.01 * plume.particle_radius_m));
}

TEST(DecayingPlumeTest, WithoutWindIsTheSameInAllDirections) {
  const DecayingPlume plume{0.0, 1.0, 8.0, 0.5};
  EXPECT_DOUBLE_EQ(plume.PerRate_s_per_m3(-3.0, 4.0), plume.PerRate_s_per_m3(5.0, 0.0));
}

}  // namespace decaying_plume_test
}  // namespace plumescout::lab
