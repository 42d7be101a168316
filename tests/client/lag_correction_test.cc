// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/lag_correction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace plumescout::client {
namespace lag_correction_test {

constexpr double kTau_s = 0.5;
constexpr std::int64_t kPeriod_ns = 500'000'000;

// The cell of a sensor with time constant kTau_s that follows `air_ppm(time_s)` in steps of 1 ms.
class LaggingSensor {
 public:
  explicit LaggingSensor(std::function<double(double)> air_ppm) : air_ppm_(std::move(air_ppm)) {}

  double ReadAt_ppm(std::int64_t time_ns) {
    for (; now_ns_ < time_ns; now_ns_ += kStep_ns) {
      const double air_ppm = air_ppm_(1e-9 * static_cast<double>(now_ns_));
      cell_ppm_ += (air_ppm - cell_ppm_) * -std::expm1(-1e-9 * kStep_ns / kTau_s);
    }
    return cell_ppm_;
  }

 private:
  static constexpr std::int64_t kStep_ns = 1'000'000;
  std::function<double(double)> air_ppm_;
  std::int64_t now_ns_ = 0;
  double cell_ppm_ = 0.0;
};

GasSample At(std::int64_t time_ns, double concentration_ppm) {
  return {time_ns, {}, {concentration_ppm, 0.0}};
}

TEST(LagCorrection, FindsTheAirBehindAStepAtOnce) {
  LaggingSensor sensor([](double) { return 100.0; });
  LagCorrection correction(kTau_s);
  correction.Correct(At(0, sensor.ReadAt_ppm(0)));
  for (int k = 1; k <= 4; ++k) {
    const GasSample measured = At(k * kPeriod_ns, sensor.ReadAt_ppm(k * kPeriod_ns));
    EXPECT_LT(measured.reading.concentration_ppm, 99.0);
    EXPECT_NEAR(correction.Correct(measured).reading.concentration_ppm, 100.0, 1e-9);
  }
}

// On a ramp the weighted average over a period is the air at its mean age: value and time agree.
TEST(LagCorrection, PutsARampBackInItsPlace) {
  constexpr double kSlope_ppm_per_s = 8.0;
  LaggingSensor sensor([](double time_s) { return kSlope_ppm_per_s * time_s; });
  LagCorrection correction(kTau_s);
  for (int k = 0; k <= 6; ++k) {
    const std::int64_t now_ns = k * kPeriod_ns;
    const GasSample air = correction.Correct(At(now_ns, sensor.ReadAt_ppm(now_ns)));
    if (k == 0) continue;
    EXPECT_LT(air.time_ns, now_ns);
    EXPECT_GT(air.time_ns, now_ns - kPeriod_ns / 2);
    // The sensor above is stepped with the air at the beginning of each millisecond.
    EXPECT_NEAR(air.reading.concentration_ppm,
                kSlope_ppm_per_s * 1e-9 * static_cast<double>(air.time_ns),
                kSlope_ppm_per_s * 1e-3);
  }
}

TEST(LagCorrection, FollowsTheRobotsWayBack) {
  LagCorrection correction(kTau_s);
  correction.Correct(At(0, 1.0));
  for (int tick = 0; tick <= 5; ++tick) {  // 1 m/s along x, then a corner, 1 m/s along y
    const double driven_m = 0.1 * tick;
    correction.NotePose(tick * 100'000'000,
                        {std::min(driven_m, 0.4), std::max(driven_m - 0.4, 0.0), 0.0});
  }
  const GasSample air = correction.Correct(
      {kPeriod_ns, {0.4, 0.1, 0.0}, {.concentration_ppm = 1.0, .variance_ppm2 = 0.0}});
  EXPECT_NEAR(air.pose.x_m, 1e-9 * static_cast<double>(air.time_ns), 1e-6);
  EXPECT_NEAR(air.pose.y_m, 0.0, 1e-12);
}

TEST(LagCorrection, SaysHowMuchNoiseItAdds) {
  LagCorrection correction(kTau_s);
  correction.Correct({0, {}, {1.0, 0.01}});
  const GasSample air = correction.Correct({kPeriod_ns, {}, {1.0, 0.01}});
  const double kept = std::exp(-1.0);
  EXPECT_NEAR(air.reading.variance_ppm2, 0.01 * (1.0 + kept * kept) / ((1.0 - kept) * (1.0 - kept)),
              1e-12);
}

TEST(LagCorrection, NeverGoesBelowNothing) {
  LagCorrection correction(kTau_s);
  correction.Correct(At(0, 100.0));
  EXPECT_EQ(correction.Correct(At(kPeriod_ns, 1.0)).reading.concentration_ppm, 0.0);
}

TEST(LagCorrection, OfASlowSeriesIsOnlyADelay) {
  LagCorrection correction(kTau_s);
  correction.Correct(At(0, 100.0));
  const GasSample air = correction.Correct(At(100 * kPeriod_ns, 1.0));
  EXPECT_NEAR(air.reading.concentration_ppm, 1.0, 1e-12);
  EXPECT_EQ(air.time_ns, 100 * kPeriod_ns - std::llround(kTau_s * 1e9));
}

TEST(LagCorrection, LeavesAloneWhatHasNoPast) {
  LagCorrection correction(kTau_s);
  EXPECT_EQ(correction.Correct(At(kPeriod_ns, 5.0)).reading.concentration_ppm, 5.0);
  const GasSample again = correction.Correct(At(kPeriod_ns, 7.0));  // the clock stood still
  EXPECT_EQ(again.reading.concentration_ppm, 7.0);
  EXPECT_EQ(again.time_ns, kPeriod_ns);
  const GasSample earlier = correction.Correct(At(0, 3.0));  // or was set back
  EXPECT_EQ(earlier.reading.concentration_ppm, 3.0);
}

TEST(LagCorrection, OfNoLagChangesNothing) {
  LagCorrection correction(0.0);
  correction.Correct(At(0, 100.0));
  correction.NotePose(kPeriod_ns, {9.0, 9.0, 0.0});
  const GasSample same = correction.Correct(At(kPeriod_ns, 1.0));
  EXPECT_EQ(same.time_ns, kPeriod_ns);
  EXPECT_EQ(same.pose, Pose2{});
  EXPECT_EQ(same.reading.concentration_ppm, 1.0);
}

TEST(UndoLag, FindsTheAirBetweenTwoReadingsHoweverFarApart) {
  for (const double elapsed_s : {0.1, 1.0, 5.0}) {
    const double kept = std::exp(-elapsed_s / 4.0);
    const GasReading later{1400.0 - 1000.0 * kept, 100.0};
    const GasReading air = UndoLag({400.0, 100.0}, later, elapsed_s, 4.0);
    EXPECT_NEAR(air.concentration_ppm, 1400.0, 1e-6);
    EXPECT_NEAR(air.variance_ppm2, 100.0 * (1.0 + kept * kept) / ((1.0 - kept) * (1.0 - kept)),
                1e-6);
  }
}

TEST(UndoLag, NeverGivesNegativeConcentrations) {
  EXPECT_EQ(UndoLag({100.0, 0.0}, {1.0, 0.0}, 0.5, 4.0).concentration_ppm, 0.0);
}

}  // namespace lag_correction_test
}  // namespace plumescout::client
