// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/release_schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace plumescout::lab {
namespace release_schedule_test {

ReleaseSchedule Turns() { return {10.0, 100.0, 4.0, 6.0}; }

TEST(ReleaseSchedule, ReleasesAlwaysIfNothingIsSaid) {
  EXPECT_EQ(ReleasingTime_s({}, -180.0, 20.0), 200.0);
  EXPECT_EQ(ReleasingTime_s({}, 20.0, 20.0), 0.0);
}

TEST(ReleaseSchedule, ReleasesFromItsStartToItsEnd) {
  ReleaseSchedule schedule;
  schedule.start_s = -30.0;
  EXPECT_EQ(ReleasingTime_s(schedule, -180.0, 20.0), 50.0);
  schedule.end_s = 10.0;
  EXPECT_EQ(ReleasingTime_s(schedule, -180.0, 20.0), 40.0);
  EXPECT_EQ(ReleasingTime_s(schedule, -10.0, 5.0), 15.0);
  EXPECT_EQ(ReleasingTime_s(schedule, 10.0, 20.0), 0.0);
  EXPECT_EQ(ReleasingTime_s(schedule, -180.0, -30.0), 0.0);
}

// Against counting milliseconds, from any time to any other.
TEST(ReleaseSchedule, ReleasesByTurns) {
  const auto releases = [](double time_s) {
    return time_s >= 10.0 && time_s < 100.0 && std::fmod(time_s - 10.0, 10.0) < 4.0;
  };
  for (double from_s = -5.0; from_s < 120.0; from_s += 3.7) {
    for (double to_s = from_s; to_s < 120.0; to_s += 11.3) {
      constexpr double kTick_s = 1e-3;
      double counted_s = 0.0;
      for (double t = from_s + kTick_s / 2.0; t < to_s; t += kTick_s) {
        counted_s += releases(t) ? kTick_s : 0.0;
      }
      // A tick at either end and at each of up to 20 switches.
      EXPECT_NEAR(ReleasingTime_s(Turns(), from_s, to_s), counted_s, 22.0 * kTick_s);
    }
  }
}

TEST(ReleaseSchedule, NamesWhatIsWrongWithIt) {
  const auto message = [](const ReleaseSchedule& schedule) {
    return std::string(Validate(schedule).message());
  };
  EXPECT_TRUE(Validate(ReleaseSchedule{}).ok());
  EXPECT_TRUE(Validate(Turns()).ok());
  ReleaseSchedule schedule = Turns();
  schedule.end_s = 10.0;
  EXPECT_EQ(message(schedule), "end_s = 10 must be after start_s = 10");
  schedule = Turns();
  schedule.start_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(schedule), "start_s = nan must be in [-1e+06, 1e+06]");
  schedule = Turns();
  schedule.on_s = 0.0;
  EXPECT_EQ(message(schedule), "on_s = 0 must be in [0.001, 1e+06]");
  schedule = Turns();
  schedule.off_s = std::numeric_limits<double>::infinity();
  EXPECT_EQ(message(schedule), "off_s = inf must be in [0.001, 1e+06]");
  schedule = Turns();
  schedule.off_s.reset();
  EXPECT_EQ(message(schedule), "on_s and off_s must come together");
  schedule = Turns();
  schedule.start_s.reset();
  EXPECT_EQ(message(schedule), "on_s and off_s must come with start_s");
}

}  // namespace release_schedule_test
}  // namespace plumescout::lab
