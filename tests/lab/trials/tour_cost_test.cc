// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/tour_cost.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace tour_cost_test {

TEST(TourCost, BothProgramsTakeTime) {
  const auto cost = MeasureTourCost(1);
  ASSERT_TRUE(cost.ok()) << cost.status();
  EXPECT_GT(cost->subsets_ms, 0.0);
  EXPECT_GT(cost->survey_ms, 0.0);
}

}  // namespace tour_cost_test
}  // namespace plumescout::lab
