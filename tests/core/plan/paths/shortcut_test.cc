// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/shortcut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/path_case.h"

namespace plumescout {
namespace shortcut_test {

using ::testing::ElementsAre;
using testing::PathCase;

constexpr double kRounding = 1e-9;

// A chain of open cells that wanders at random.
std::vector<Point2> RandomWalk(const PathCase& c, int steps, Rng& rng) {
  std::vector<Point2> path = {c.start};
  while (static_cast<int>(path.size()) <= steps) {
    const Point2 next{path.back().x_m + rng.Uniform(-0.5, 0.5),
                      path.back().y_m + rng.Uniform(-0.5, 0.5)};
    if (c.cost(path.back(), next) < std::numeric_limits<double>::infinity()) path.push_back(next);
  }
  return path;
}

// The least price over all 2^(n-2) choices of vertices between the ends.
double CheapestSubsequence(const EdgeCost& cost, const std::vector<Point2>& path) {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t between = path.size() - 2;
  for (std::size_t choice = 0; choice < (std::size_t{1} << between); ++choice) {
    std::vector<Point2> chosen = {path.front()};
    for (std::size_t i = 0; i < between; ++i) {
      if ((choice >> i & 1U) != 0) chosen.push_back(path[i + 1]);
    }
    chosen.push_back(path.back());
    least = std::min(least, PathCost(cost, chosen));
  }
  return least;
}

TEST(Shortcut, FindsTheCheapestChoiceOfVertices) {
  Rng rng(1);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PathCase c(seed);
    const std::vector<Point2> path = RandomWalk(c, 9, rng);
    EdgePrices prices(c.cost);
    const ShortcutPath shortcut = Shortcut(prices, path, NeverStop());
    EXPECT_NEAR(shortcut.cost, CheapestSubsequence(c.cost, path), kRounding);
    EXPECT_NEAR(shortcut.cost, PathCost(c.cost, shortcut.vertices), kRounding);
    EXPECT_EQ(shortcut.vertices.front(), path.front());
    EXPECT_EQ(shortcut.vertices.back(), path.back());
    EXPECT_GT(shortcut.edges_evaluated, 0);
  }
}

TEST(Shortcut, NeverMakesALongPathDearer) {
  Rng rng(2);
  const PathCase c(4);
  const std::vector<Point2> path = RandomWalk(c, 200, rng);
  EdgePrices prices(c.cost);
  EXPECT_LE(Shortcut(prices, path, NeverStop()).cost, PathCost(c.cost, path) + kRounding);
}

TEST(Shortcut, TakesThePathAsItIsWhenStopped) {
  Rng rng(3);
  const PathCase c(5);
  const std::vector<Point2> path = RandomWalk(c, 20, rng);
  EdgePrices prices(c.cost);
  const ShortcutPath shortcut = Shortcut(prices, path, [] { return true; });
  EXPECT_EQ(shortcut.vertices, path);
  EXPECT_NEAR(shortcut.cost, PathCost(c.cost, path), kRounding);
}

TEST(Shortcut, OfOneVertexIsThatVertex) {
  const PathCase c(6);
  EdgePrices prices(c.cost);
  const ShortcutPath shortcut = Shortcut(prices, {c.start}, NeverStop());
  EXPECT_THAT(shortcut.vertices, ElementsAre(c.start));
  EXPECT_EQ(shortcut.cost, 0.0);
}

TEST(WithoutCollinear, KeepsEndsAndTurns) {
  EXPECT_THAT(WithoutCollinear({{0, 0}, {1, 0}, {2, 0}, {3, 1}, {4, 2}, {4, 3}}),
              ElementsAre(Point2{0, 0}, Point2{2, 0}, Point2{4, 2}, Point2{4, 3}));
}

TEST(WithoutCollinear, KeepsTheTurningPointOfAWayBack) {
  EXPECT_THAT(WithoutCollinear({{0, 0}, {2, 0}, {1, 0}}),
              ElementsAre(Point2{0, 0}, Point2{2, 0}, Point2{1, 0}));
}

TEST(WithoutCollinear, OfTwoVerticesChangesNothing) {
  EXPECT_THAT(WithoutCollinear({{0, 0}, {2, 0}}), ElementsAre(Point2{0, 0}, Point2{2, 0}));
}

}  // namespace shortcut_test
}  // namespace plumescout
