// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/convergence.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace plumescout::lab {
namespace convergence_test {

// Falls, comes near its final value, leaves it once more, and stays.
const ErrorCurve kCurve = {{0.0, 10.0}, {1.0, 4.0},  {2.0, 2.05}, {3.0, 2.5},
                           {4.0, 2.09}, {5.0, 1.91}, {6.0, 2.0}};

TEST(ConvergenceTest, CountsFromWhenTheErrorStaysWithinAShareOfItsFinalValue) {
  EXPECT_EQ(ConvergenceTime_s(kCurve, 0.05), 4.0);
}

// A sweep that mends its map a little with every sample has converged when it is done.
TEST(ConvergenceTest, TheBandOfThePaperIsTight) {
  EXPECT_EQ(ConvergenceTime_s(kCurve), 6.0);
  EXPECT_EQ(ConvergenceTime_s({{0.0, 2.0}, {1.0, 1.003}, {2.0, 1.001}, {3.0, 1.0}}), 2.0);
}

TEST(ConvergenceTest, AnErrorThatDipsBelowTheFinalValueHasNotConverged) {
  EXPECT_EQ(ConvergenceTime_s({{0.0, 2.0}, {1.0, 1.5}, {2.0, 2.0}}, 0.05), 2.0);
}

TEST(ConvergenceTest, AWiderBandIsReachedSooner) {
  EXPECT_EQ(ConvergenceTime_s(kCurve, 0.26), 2.0);
  EXPECT_EQ(ConvergenceTime_s(kCurve, 10.0), 0.0);
}

TEST(ConvergenceTest, TheEdgeOfTheBandBelongsToIt) {
  EXPECT_EQ(ConvergenceTime_s({{0.0, 3.0}, {1.0, 2.5}, {2.0, 2.0}}, 0.25), 1.0);
}

TEST(ConvergenceTest, AConstantErrorHasConvergedAtOnce) {
  EXPECT_EQ(ConvergenceTime_s({{5.0, 3.0}, {6.0, 3.0}}), 5.0);
  EXPECT_EQ(ConvergenceTime_s({{5.0, 0.0}, {6.0, 0.0}}), 5.0);
  EXPECT_EQ(ConvergenceTime_s({{7.0, 3.0}}), 7.0);
}

TEST(ConvergenceTest, NothingConvergesToNoNumber) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ConvergenceTime_s({}).has_value());
  EXPECT_FALSE(ConvergenceTime_s({{0.0, 1.0}, {1.0, kNaN}}).has_value());
  EXPECT_EQ(ConvergenceTime_s({{0.0, 1.0}, {1.0, kNaN}, {2.0, 1.0}}), 2.0);
}

TEST(ConvergenceTest, TheTimeBelowALimitIsTheFirst) {
  EXPECT_EQ(TimeBelow_s(kCurve, 2.1), 2.0);
  EXPECT_EQ(TimeBelow_s(kCurve, 2.0), 5.0);  // below, not at
  EXPECT_FALSE(TimeBelow_s(kCurve, 1.0).has_value());
  EXPECT_FALSE(TimeBelow_s({}, 1.0).has_value());
}

TEST(ConvergenceTest, FinalAndLeastErrorComeWithTheirTimes) {
  EXPECT_EQ(FinalError(kCurve), (ErrorPoint{6.0, 2.0}));
  EXPECT_EQ(LeastError(kCurve), (ErrorPoint{5.0, 1.91}));
  EXPECT_EQ(LeastError({{1.0, 2.0}, {2.0, 2.0}})->time_s, 1.0);
  EXPECT_FALSE(FinalError({}).has_value());
  EXPECT_FALSE(LeastError({}).has_value());
}

TEST(ConvergenceTest, EvenTimesIncludeAnEndThatIsReached) {
  EXPECT_EQ(EvenTimes_s(1.0, 0.5), (std::vector<double>{0.0, 0.5, 1.0}));
  EXPECT_EQ(EvenTimes_s(0.9, 0.5), (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(EvenTimes_s(0.3, 0.1).size(), 4u);
  EXPECT_EQ(EvenTimes_s(-1.0, 0.5).size(), 0u);
}

TEST(ConvergenceTest, BetweenTwoPointsTheMapIsAsItWas) {
  const std::vector<double> times_s = {-1.0, 0.0, 0.9, 1.0, 2.5, 100.0};
  const ErrorCurve expected = {{-1.0, 10.0}, {0.0, 10.0}, {0.9, 10.0},
                               {1.0, 4.0},   {2.5, 2.05}, {100.0, 2.0}};
  EXPECT_EQ(Resampled(kCurve, times_s), expected);
}

TEST(ConvergenceTest, OfTwoPointsAtOneTimeTheLaterCounts) {
  const std::vector<double> times_s = {1.0};
  EXPECT_EQ(Resampled({{1.0, 5.0}, {1.0, 3.0}}, times_s), (ErrorCurve{{1.0, 3.0}}));
}

TEST(ConvergenceTest, RunsOfDifferentLengthAreAveragedTimeByTime) {
  const std::vector<ErrorCurve> curves = {{{0.0, 4.0}, {2.0, 2.0}}, {{0.0, 8.0}, {1.0, 6.0}}};
  const std::vector<double> times_s = {0.0, 1.0, 2.0, 3.0};
  const ErrorCurve expected = {{0.0, 6.0}, {1.0, 5.0}, {2.0, 4.0}, {3.0, 4.0}};
  EXPECT_EQ(MeanCurve(curves, times_s), expected);
}

}  // namespace convergence_test
}  // namespace plumescout::lab
