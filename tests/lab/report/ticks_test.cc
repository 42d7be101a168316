// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/ticks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace ticks_test {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

constexpr double kTolerance = 1e-12;  // a few roundings of numbers near 1

TEST(Ticks, AreRoundAndWithinTheRange) {
  EXPECT_THAT(LinearTicks(0.0, 1.0, 4),
              Pointwise(DoubleNear(kTolerance), {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}));
  EXPECT_THAT(LinearTicks(-7.0, 12.0, 4), ElementsAre(-5, 0, 5, 10));
  EXPECT_THAT(LinearTicks(3.0, 299.0, 3), ElementsAre(100, 200));
}

TEST(Ticks, ZeroIsNeverNegative) {
  const auto ticks = LinearTicks(-1e-12, 10.0, 2);
  ASSERT_FALSE(ticks.empty());
  EXPECT_FALSE(std::signbit(ticks[0]));
}

TEST(Ticks, StayFewForAnyRange) {
  for (double span = 1e-6; span < 1e9; span *= 1.37) {
    const auto ticks = LinearTicks(-0.3 * span, 0.7 * span, 4);
    EXPECT_GE(ticks.size(), 2U) << span;  // steps are at most 1.5 times the wanted one ...
    EXPECT_LE(ticks.size(), 7U) << span;  // ... and at least 1.5 / 2.5 of it
  }
}

TEST(Ticks, DecadesArePowersOfTen) {
  EXPECT_THAT(DecadeTicks(0.46, 458.0), ElementsAre(1, 10, 100));
  EXPECT_THAT(DecadeTicks(1.0, 1000.0), ElementsAre(1, 10, 100, 1000));
  EXPECT_THAT(DecadeTicks(2.0, 9.0), ElementsAre());
}

TEST(Ticks, RoundNumbersAreOneTwoAndFive) {
  EXPECT_DOUBLE_EQ(RoundDown125(1.0), 1.0);
  EXPECT_DOUBLE_EQ(RoundDown125(1.99), 1.0);
  EXPECT_DOUBLE_EQ(RoundDown125(4.9), 2.0);
  EXPECT_DOUBLE_EQ(RoundDown125(0.07), 0.05);
  EXPECT_DOUBLE_EQ(RoundDown125(1000.0), 1000.0);
}

TEST(Ticks, LabelsAreShort) {
  EXPECT_EQ(TickLabel(0.1 + 0.2), "0.3");
  EXPECT_EQ(TickLabel(1200.0), "1200");
  EXPECT_EQ(TickLabel(2.5e7), "2.5e+07");
}

}  // namespace ticks_test
}  // namespace plumescout::lab
