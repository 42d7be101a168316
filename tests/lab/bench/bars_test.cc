// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/bars.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace bars_test {

TEST(Bars, AFigureMeetsItsBarUpToTheLimit) {
  EXPECT_TRUE((Bar{"p99, ms", 60.0, 60.0}).met());
  EXPECT_FALSE((Bar{"p99, ms", 60.1, 60.0}).met());
  EXPECT_TRUE((Bar{"frames", 1e9}).met()) << "for information";
}

TEST(Bars, WhatWasNotMeasuredMeetsNoBar) {
  EXPECT_FALSE((Bar{"p99, ms", std::nan(""), 60.0}).met());
}

TEST(Bars, AFactMustHold) {
  EXPECT_TRUE(MustHold("server ended", true).met());
  EXPECT_FALSE(MustHold("server ended", false).met());
}

TEST(Bars, AllAreMetIfNoneIsMissed) {
  EXPECT_TRUE(AllMet({}));
  EXPECT_TRUE(AllMet({{"a", 1.0, 1.0}, {"b", 5.0}}));
  EXPECT_FALSE(AllMet({{"a", 1.0, 1.0}, {"b", 5.0, 4.0}}));
}

TEST(Bars, MissedBarsAreSaidToBe) {
  EXPECT_EQ(ToString({"frames", 12.0}), "frames: 12");
  EXPECT_EQ(ToString({"p99, ms", 12.5, 60.0}), "p99, ms: 12.5 (at most 60)");
  EXPECT_EQ(ToString({"p99, ms", 61.0, 60.0}), "p99, ms: 61 (at most 60) MISSED");
}

}  // namespace bars_test
}  // namespace plumescout::lab
