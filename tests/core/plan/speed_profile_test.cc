// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/speed_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/types/rng.h"

namespace plumescout {
namespace speed_profile_test {

constexpr double kRounding = 1e-12;

// The quickest speeds at evenly spaced places, by a pass forwards that speeds up and one backwards
// that brakes.
std::vector<double> SpeedsByPasses_mps(double step_m, int steps, double max_mps, double limit) {
  std::vector<double> speed_mps(static_cast<std::size_t>(steps) + 1, 0.0);
  for (std::size_t i = 1; i < speed_mps.size(); ++i) {
    const double before_mps = speed_mps[i - 1];
    speed_mps[i] = std::min(max_mps, std::sqrt(before_mps * before_mps + 2.0 * limit * step_m));
  }
  speed_mps.back() = 0.0;
  for (std::size_t i = speed_mps.size() - 1; i-- > 0;) {
    const double after_mps = speed_mps[i + 1];
    speed_mps[i] = std::min(speed_mps[i], std::sqrt(after_mps * after_mps + 2.0 * limit * step_m));
  }
  return speed_mps;
}

TEST(SpeedProfile, AgreesWithAnIntegrationInSmallSteps) {
  Rng rng(3);
  for (int trial = 0; trial < 50; ++trial) {
    const double length_m = rng.Uniform(0.05, 20.0);
    const double max_mps = rng.Uniform(0.1, 3.0);
    const double limit_mps2 = rng.Uniform(0.05, 4.0);
    const SpeedProfile profile(length_m, max_mps, limit_mps2);
    constexpr int kSteps = 4000;
    const double step_m = length_m / kSteps;
    const std::vector<double> speed_mps = SpeedsByPasses_mps(step_m, kSteps, max_mps, limit_mps2);
    // Steps within a ramp or the cruise are exact. Over one that holds a corner of the trapezoid
    // the speed errs by at most what it changes in it, a * step / peak; so the time by a * step^2 /
    // peak^3. There are two such steps; twice that, for the higher orders.
    const double peak_mps = *std::max_element(speed_mps.begin(), speed_mps.end());
    const double tolerance_s = 4.0 * limit_mps2 * step_m * step_m / std::pow(peak_mps, 3);
    // Near the end the root of what is left makes 1e-8 of a rounding.
    constexpr double kRoundingOfRoots_s = 1e-6;
    double time_s = 0.0;
    for (std::size_t i = 1; i < speed_mps.size(); ++i) {
      time_s += 2.0 * step_m / (speed_mps[i - 1] + speed_mps[i]);
      const double driven_m = std::min(static_cast<double>(i) * step_m, length_m);
      ASSERT_NEAR(profile.TimeAt_s(driven_m), time_s, tolerance_s + kRoundingOfRoots_s);
    }
    EXPECT_NEAR(profile.duration_s(), time_s, tolerance_s + 1e-9);
  }
}

TEST(SpeedProfile, IsATrapezoidWhereThereIsRoomToCruise) {
  const SpeedProfile profile(3.0, 1.0, 0.5);  // one metre and two seconds for either ramp
  EXPECT_NEAR(profile.ramp_m(), 1.0, kRounding);
  EXPECT_NEAR(profile.duration_s(), 2.0 + 1.0 + 2.0, kRounding);
  EXPECT_NEAR(profile.TimeAt_s(1.5), 2.5, kRounding);
  EXPECT_NEAR(profile.SpeedAt_mps(0.25), 0.5, kRounding);
  EXPECT_NEAR(profile.SpeedAt_mps(1.5), 1.0, kRounding);
  EXPECT_NEAR(profile.SpeedAt_mps(2.75), 0.5, kRounding);
  EXPECT_EQ(profile.SpeedAt_mps(3.0), 0.0);
}

TEST(SpeedProfile, IsATriangleWhereThereIsNone) {
  const SpeedProfile profile(0.5, 1.0, 0.5);
  EXPECT_NEAR(profile.ramp_m(), 0.25, kRounding);
  EXPECT_NEAR(profile.SpeedAt_mps(0.25), 0.5, kRounding);
  EXPECT_NEAR(profile.duration_s(), 2.0, kRounding);
}

TEST(SpeedProfile, WithoutABoundOnAccelerationIsAllCruise) {
  const SpeedProfile profile(3.0, 1.5, 0.0);
  EXPECT_EQ(profile.ramp_m(), 0.0);
  EXPECT_EQ(profile.duration_s(), 2.0);
  EXPECT_EQ(profile.TimeAt_s(1.5), 1.0);
  EXPECT_EQ(profile.SpeedAt_mps(1.5), 0.0);
}

TEST(SpeedProfile, OfNoLengthTakesNoTime) {
  EXPECT_EQ(SpeedProfile(0.0, 1.0, 0.5).duration_s(), 0.0);
  EXPECT_EQ(SpeedProfile(0.0, 1.0, 0.0).duration_s(), 0.0);
}

}  // namespace speed_profile_test
}  // namespace plumescout
