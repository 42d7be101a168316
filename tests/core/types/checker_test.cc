// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/checker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout {
namespace checker_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Checker, RangesHaveTheirEnds) {
  for (const double good : {-1.0, 0.0, 2.0}) {
    EXPECT_TRUE(Checker().InRange("x", good, -1.0, 2.0).status().ok()) << good;
  }
  for (const double bad : {-1.1, 2.1, -kInfinity, kInfinity, std::nan("")}) {
    EXPECT_TRUE(absl::IsInvalidArgument(Checker().InRange("x", bad, -1.0, 2.0).status())) << bad;
  }
}

TEST(Checker, RangesAboveAnEndAreWithoutIt) {
  EXPECT_TRUE(Checker().InRangeAbove("x", 2.0, 0.0, 2.0).status().ok());
  for (const double bad : {-1.0, 0.0, 2.1, kInfinity, std::nan("")}) {
    EXPECT_FALSE(Checker().InRangeAbove("x", bad, 0.0, 2.0).status().ok()) << bad;
  }
  EXPECT_EQ(Checker().InRangeAbove("x", 0.0, 0.0, 2.0).status().message(),
            "x = 0 must be in (0, 2]");
}

TEST(Checker, RulesOfTheCallersOwnAreToldAsTheyAre) {
  EXPECT_TRUE(Checker().Require(true, "x", 3.0, "must be even").status().ok());
  EXPECT_EQ(Checker().Require(false, "x", 3.0, "must be even").status().message(),
            "x = 3 must be even");
}

TEST(Checker, ZeroIsNotNegativeAndInfinityIsNotFinite) {
  EXPECT_TRUE(Checker().NotNegative("x", 0.0).Finite("y", -3.0).status().ok());
  for (const double bad : {-0.1, kInfinity, std::nan("")}) {
    EXPECT_FALSE(Checker().NotNegative("x", bad).status().ok()) << bad;
  }
  for (const double bad : {-kInfinity, kInfinity, std::nan("")}) {
    EXPECT_FALSE(Checker().Finite("x", bad).status().ok()) << bad;
  }
}

TEST(Checker, SignsAreOfFiniteNumbers) {
  EXPECT_TRUE(Checker().Positive("x", 0.1).Negative("y", -0.1).status().ok());
  for (const double bad : {0.0, -0.1, kInfinity, std::nan("")}) {
    EXPECT_FALSE(Checker().Positive("x", bad).status().ok()) << bad;
    EXPECT_FALSE(Checker().Negative("x", -bad).status().ok()) << bad;
  }
}

TEST(Checker, TellsTheFirstViolationWithFieldValueAndRule) {
  EXPECT_EQ(Checker().Positive("a", 1.0).InRange("b.c", 3.5, 0.0, 2.0).Negative("d", 1.0).status(),
            absl::InvalidArgumentError("b.c = 3.5 must be in [0, 2]"));
}

}  // namespace checker_test
}  // namespace plumescout
