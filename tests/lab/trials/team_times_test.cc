// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_times.h"

#include "gtest/gtest.h"

namespace plumescout::lab {
namespace team_times_test {

std::vector<CurvePoint> CurveOf(const std::vector<double>& completeness) {
  std::vector<CurvePoint> curve;
  for (std::size_t i = 0; i < completeness.size(); ++i) {
    curve.push_back({5.0 * static_cast<double>(i), {}});
    curve.back().metrics.completeness = completeness[i];
  }
  return curve;
}

TEST(TeamTimes, CountFromWhereALevelIsKept) {
  const auto curve = CurveOf({0.1, 0.6, 0.4, 0.7, 0.9});
  EXPECT_EQ(RisesTo(curve, Completeness, 0.5).time_s, 15.0) << "it fell below once more";
  EXPECT_TRUE(RisesTo(curve, Completeness, 0.5).reached);
  EXPECT_EQ(RisesTo(curve, Completeness, 0.1).time_s, 0.0);
  const ReachedAt never = RisesTo(curve, Completeness, 0.95);
  EXPECT_FALSE(never.reached);
  EXPECT_EQ(never.time_s, 20.0);
  EXPECT_EQ(FallsTo(CurveOf({0.9, 0.2, 0.5, 0.1}), Completeness, 0.3).time_s, 15.0);
}

TEST(TeamTimes, ALevelIsAShareOfTheGain) {
  EXPECT_DOUBLE_EQ(LevelAtShare(CurveOf({10.0, 7.0, 5.0}), Completeness, 0.8), 6.0);
}

TEST(TeamTimes, MeansAreGeometric) {
  EXPECT_DOUBLE_EQ(GeometricMean({2.0, 8.0}), 4.0);
  EXPECT_EQ(GeometricMean({}), 1.0);
}

}  // namespace team_times_test
}  // namespace plumescout::lab
