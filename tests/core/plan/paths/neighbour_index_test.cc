// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/neighbour_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/types/rng.h"

namespace plumescout {
namespace neighbour_index_test {

using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

std::multiset<int> Near(const NeighbourIndex& index, Point2 center) {
  std::multiset<int> found;
  index.ForEachNear(center, [&found](int i, double) { found.insert(i); });
  return found;
}

TEST(NeighbourIndex, FindsWhatLookingAtAllPointsFinds) {
  Rng rng(1);
  for (const double radius_m : {0.05, 0.7, 3.0, 100.0}) {
    std::vector<Point2> points;
    for (int i = 0; i < 400; ++i) points.push_back({rng.Uniform(-3, 5), rng.Uniform(2, 12)});
    const NeighbourIndex index(points, radius_m);
    for (int query = 0; query < 100; ++query) {
      const Point2 center{rng.Uniform(-6, 8), rng.Uniform(-1, 15)};
      std::multiset<int> expected;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (Distance_m(points[i], center) <= radius_m) expected.insert(static_cast<int>(i));
      }
      EXPECT_EQ(Near(index, center), expected);
    }
  }
}

TEST(NeighbourIndex, TellsTheDistance) {
  const NeighbourIndex index({{0, 0}}, 2.0);
  index.ForEachNear({0.6, 0.8}, [](int, double distance_m) { EXPECT_DOUBLE_EQ(distance_m, 1.0); });
}

TEST(NeighbourIndex, KeepsPointsThatCoincide) {
  EXPECT_THAT(Near(NeighbourIndex({{1, 1}, {1, 1}, {4, 4}}, 0.5), {1, 1}),
              UnorderedElementsAre(0, 1));
}

TEST(NeighbourIndex, SpansWideAreasWithFewBuckets) {
  const NeighbourIndex index({{0, 0}, {1e6, 1e6}, {1e6, 1e6 + 0.05}}, 0.1);
  EXPECT_THAT(Near(index, {1e6, 1e6}), UnorderedElementsAre(1, 2));
}

TEST(NeighbourIndex, OfNothingFindsNothing) {
  EXPECT_THAT(Near(NeighbourIndex({}, 1.0), {0, 0}), IsEmpty());
}

}  // namespace neighbour_index_test
}  // namespace plumescout
