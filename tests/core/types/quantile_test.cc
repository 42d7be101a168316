// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/quantile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plumescout {
namespace quantile_test {

TEST(Quantile, IsLinearBetweenOrderStatistics) {
  const std::vector<double> values = {40.0, 10.0, 30.0, 20.0, 50.0};
  EXPECT_EQ(Quantile(values, 0.0), 10.0);
  EXPECT_EQ(Quantile(values, 0.25), 20.0);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.35), 24.0);
  EXPECT_EQ(Quantile(values, 1.0), 50.0);
  EXPECT_EQ(Quantile(std::vector<float>{2.5F}, 0.99), 2.5);
}

TEST(Quantile, OfNothingIsNoNumber) {
  EXPECT_TRUE(std::isnan(Quantile(std::vector<float>{}, 0.5)));
}

TEST(Median, IsTheMiddleOrTheMeanOfBothMiddles) {
  EXPECT_EQ(Median(std::vector<double>{3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(Median(std::vector<double>{4.0, 1.0, 2.0, 3.0}), 2.5);
}

}  // namespace quantile_test
}  // namespace plumescout
