// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/completeness.h"

#include <gtest/gtest.h>

#include "tests/support/measured_hall.h"

namespace plumescout {
namespace completeness_test {

using support::MeasuredHall;

constexpr double kHall_m2 = 50.0;  // 20 x 10 cells of 0.25 m2

TEST(AssessCompleteness, AllOfAMeasuredHallIsObserved) {
  const MeasuredHall hall(ObjectiveOptions{});
  const Completeness found = AssessCompleteness(hall.belief);
  EXPECT_DOUBLE_EQ(found.reachable_area_m2, kHall_m2);
  EXPECT_DOUBLE_EQ(found.observed_area_m2, kHall_m2);
}

TEST(AssessCompleteness, WhatNobodyMeasuredIsReachableAlone) {
  MeasuredHall hall(ObjectiveOptions{});
  hall.Forget({7, 7});
  (*hall.variance)[Cell{8, 7}] = NAN;  // free, and in no field yet
  const Completeness found = AssessCompleteness(hall.belief);
  EXPECT_DOUBLE_EQ(found.reachable_area_m2, kHall_m2);
  EXPECT_DOUBLE_EQ(found.observed_area_m2, kHall_m2 - 0.5);
}

TEST(AssessCompleteness, WhatNoRobotCanReachIsInNeither) {
  MeasuredHall hall(ObjectiveOptions{});
  for (int y = 1; y <= 10; ++y) (*hall.traversable)[Cell{11, y}] = 0;
  const Completeness found = AssessCompleteness(hall.belief);
  EXPECT_DOUBLE_EQ(found.reachable_area_m2, kHall_m2 / 2);
  EXPECT_DOUBLE_EQ(found.observed_area_m2, kHall_m2 / 2);
}

TEST(AssessCompleteness, RobotsReachFromWhereTheyBegan) {
  MeasuredHall hall(ObjectiveOptions{});
  for (int y = 1; y <= 10; ++y) (*hall.traversable)[Cell{11, y}] = 0;
  hall.belief.robots["r"].first_place = hall.Center({15, 5});
  EXPECT_DOUBLE_EQ(AssessCompleteness(hall.belief).reachable_area_m2, kHall_m2 - 2.5);
}

TEST(AssessCompleteness, WithoutARobotNothingIsReachable) {
  MeasuredHall hall(ObjectiveOptions{});
  hall.belief.robots.clear();
  EXPECT_EQ(AssessCompleteness(hall.belief), Completeness{});
}

TEST(AssessCompleteness, StatusTellsIt) {
  MeasuredHall hall(ObjectiveOptions{});
  hall.Forget({7, 7});
  EXPECT_EQ(MakeMapStatus(hall.belief).completeness, AssessCompleteness(hall.belief));
}

}  // namespace completeness_test
}  // namespace plumescout
