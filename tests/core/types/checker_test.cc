// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/checker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
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

TEST(Checker, RangesBelowAnEndAreWithoutIt) {
  EXPECT_TRUE(Checker().InRangeBelow("x", 0.0, 0.0, 2.0).status().ok());
  for (const double bad : {-0.1, 2.0, kInfinity, std::nan("")}) {
    EXPECT_FALSE(Checker().InRangeBelow("x", bad, 0.0, 2.0).status().ok()) << bad;
  }
  EXPECT_EQ(Checker().InRangeBelow("x", 2.0, 0.0, 2.0).status().message(),
            "x = 2 must be in [0, 2)");
}

TEST(Checker, WholeNumbersAreToldDigitByDigit) {
  constexpr std::int64_t kEnd = std::int64_t{1} << 62;
  EXPECT_TRUE(
      Checker().InRange("n", kEnd, -1, kEnd).InRangeBelow("n", kEnd - 1, 0, kEnd).status().ok());
  // As doubles the two would be the same.
  EXPECT_EQ(Checker().InRange("n", kEnd + 1, 0, kEnd).status().message(),
            "n = 4611686018427387905 must be in [0, 4611686018427387904]");
  EXPECT_EQ(Checker().InRangeBelow("n", kEnd, 1'000'000, kEnd).status().message(),
            "n = 4611686018427387904 must be in [1000000, 4611686018427387904)");
  EXPECT_EQ(Checker().Require(false, "n", 1'234'567, "must be even").status().message(),
            "n = 1234567 must be even");
}

TEST(Checker, WholeNumbersOfOtherSignednessKeepTheirOrder) {
  constexpr std::size_t kCount = 3;
  EXPECT_TRUE(Checker().InRangeBelow("n", -1, -1, kCount).status().ok());
  EXPECT_FALSE(Checker().InRange("n", -2, -1, kCount).status().ok());
  EXPECT_FALSE(Checker().InRange("n", kCount, 0, -1).status().ok());
}

TEST(Checker, TheLeastIsEnough) {
  EXPECT_TRUE(Checker().AtLeast("n", 1, 1).AtLeast("m", std::int64_t{7}, 1).status().ok());
  EXPECT_EQ(Checker().AtLeast("n", 0, 1).status().message(), "n = 0 must be >= 1");
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
