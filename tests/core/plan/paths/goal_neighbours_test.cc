// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/goal_neighbours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/types/rng.h"

namespace plumescout {
namespace goal_neighbours_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

// Samples 0 to 3 at x = 0, 1, 2, 3; a goal of its own, vertex 4, at x = 2.2.
const std::vector<Point2> kPoints = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {2.2, 0}};

std::vector<GoalNeighbours::Edge> EdgesFrom(const GoalNeighbours& neighbours, int vertex) {
  const auto edges = neighbours.EdgesFrom(vertex);
  return {edges.begin(), edges.end()};
}

TEST(GoalNeighbours, JoinTheGoalToItsNearestSamplesInBothDirections) {
  const GoalNeighbours neighbours(kPoints, 4, {4}, 3);
  EXPECT_THAT(EdgesFrom(neighbours, 4), ElementsAre(Pair(4, 1), Pair(4, 2), Pair(4, 3)));
  EXPECT_THAT(EdgesFrom(neighbours, 1), ElementsAre(Pair(1, 4)));
  EXPECT_THAT(EdgesFrom(neighbours, 0), IsEmpty());
}

TEST(GoalNeighbours, LeaveOutTheGoalItselfIfItIsASample) {
  const GoalNeighbours neighbours(kPoints, 4, {2}, 2);
  EXPECT_THAT(EdgesFrom(neighbours, 2), ElementsAre(Pair(2, 1)));
}

TEST(GoalNeighbours, ShareSamplesAndKeepEqualGoalsOnce) {
  const GoalNeighbours neighbours(kPoints, 4, {4, 4, 3}, 1);
  EXPECT_THAT(EdgesFrom(neighbours, 2), ElementsAre(Pair(2, 4)));
  EXPECT_THAT(EdgesFrom(neighbours, 3), IsEmpty()) << "its nearest sample is itself";
}

// Of few distances, so that many are equal: then the first of them comes first.
TEST(NearestSamples, AreTheFirstOfAllByDistance) {
  Rng rng(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Point2> samples(rng.Below(30));
    for (Point2& sample : samples) sample.x_m = static_cast<double>(rng.Below(5));
    std::vector<int> all(samples.size());
    std::iota(all.begin(), all.end(), 0);
    const Point2 goal = {static_cast<double>(rng.Below(5)), 1.0};
    const auto distance_m = [&](int i) {
      return Distance_m(samples[static_cast<std::size_t>(i)], goal);
    };
    std::stable_sort(all.begin(), all.end(),
                     [&](int a, int b) { return distance_m(a) < distance_m(b); });
    const int count = static_cast<int>(rng.Below(8));
    all.resize(std::min(all.size(), static_cast<std::size_t>(count)));
    EXPECT_EQ(NearestSamples(samples, goal, count), all);
  }
}

TEST(GoalNeighbours, TakeAllSamplesIfThereAreFew) {
  EXPECT_THAT(EdgesFrom(GoalNeighbours(kPoints, 2, {4}, 9), 4),
              ElementsAre(Pair(4, 0), Pair(4, 1)));
  EXPECT_THAT(EdgesFrom(GoalNeighbours({{1, 1}}, 0, {0}, 3), 0), IsEmpty());
}

}  // namespace goal_neighbours_test
}  // namespace plumescout
