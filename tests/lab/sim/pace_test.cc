// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plumescout::lab {
namespace pace_test {

constexpr double kTick_s = 0.1;

TEST(Pace, IsThatOfThePathUnlessAskedFor) {
  Pace pace({}, 1);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(pace.MayMove(5.0, kTick_s * i));
  EXPECT_TRUE(pace.MayMove(5.0, kTick_s * 99)) << "at once";
}

TEST(Pace, KeepsTheTopSpeedInTicksOfAFasterPath) {
  constexpr double kMove_m = 0.125;  // 1.25 m/s
  for (const double top_mps : {0.3, 0.5, 0.8, 1.0, 1.25}) {
    Pace pace({.top_speed_mps = top_mps}, 1);
    double gone_m = 0.0;
    for (int i = 1; i <= 200; ++i) {
      if (pace.MayMove(kMove_m, kTick_s * i)) gone_m += kMove_m;
    }
    // What is gone at once, and a move more or less.
    EXPECT_NEAR(gone_m, 20.0 * top_mps, 0.25 * top_mps + kMove_m) << top_mps;
  }
}

TEST(Pace, WhoStandsIsWhereThePathWantsIt) {
  Pace pace({.top_speed_mps = 0.1, .most_late_s = 5.0}, 1);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(pace.MayMove(0.0, kTick_s * i));
}

TEST(Pace, LegsAreLateByNoMoreThanSaid) {
  Pace pace({.most_late_s = 1.0}, 1);
  double most_s = 0.0;
  double least_s = 1.0;
  int tick = 0;
  for (int leg = 0; leg < 50; ++leg) {
    int held = 0;
    for (int i = 0; i < 100; ++i) held += pace.MayMove(0.1, kTick_s * ++tick) ? 0 : 1;
    EXPECT_LE(kTick_s * held, 1.0 + 1e-9);
    most_s = std::max(most_s, kTick_s * held);
    least_s = std::min(least_s, kTick_s * held);
    pace.BeginLeg();
  }
  EXPECT_GE(most_s, 0.7);
  EXPECT_LE(least_s, 0.3);
}

TEST(Pace, NamesWhatIsOutOfRange) {
  EXPECT_TRUE(Validate(PaceOptions{}).ok());
  for (const double bad : {0.0, -1.0, 101.0, std::nan("")}) {
    EXPECT_EQ(Validate(PaceOptions{.top_speed_mps = bad}).code(),
              absl::StatusCode::kInvalidArgument);
  }
  for (const double bad : {-0.1, 61.0, std::nan("")}) {
    EXPECT_EQ(Validate(PaceOptions{.most_late_s = bad}).code(), absl::StatusCode::kInvalidArgument);
  }
}

}  // namespace pace_test
}  // namespace plumescout::lab
