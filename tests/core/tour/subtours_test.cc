// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/subtours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/core/tour/tour_case.h"

namespace plumescout {
namespace subtours_test {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Subtours, TwoTrianglesAreTwoSubtours) {
  const std::vector<double> x = {1, 1, 1, 1, 1, 1, 0, 0, 0};
  EXPECT_THAT(FindSubtours(Prism(), x), ElementsAre(ElementsAre(0, 1, 2), ElementsAre(3, 4, 5)));
}

TEST(Subtours, ATourOfAllNodesHasNone) {
  const std::vector<double> x = {1, 1, 0, 1, 1, 0, 1, 0, 1};
  EXPECT_THAT(FindSubtours(Prism(), x), IsEmpty());
}

TEST(Subtours, EdgesTakenInPartJoin) {
  const std::vector<double> x = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 1, 1, 1};
  EXPECT_THAT(FindSubtours(Prism(), x), IsEmpty());
}

TEST(Subtours, RoundingOfTheSolverDoesNotJoin) {
  const std::vector<double> x = {1, 1, 1, 1, 1, 1, 1e-9, 1e-9, 1e-9};
  EXPECT_THAT(FindSubtours(Prism(), x), testing::SizeIs(2));
}

TEST(Subtours, NodesJoinedInAnyOrderOfEdgesAreFound) {
  const TourGraph graph = {7, {{6, 5, 1}, {4, 6, 1}, {5, 4, 1}, {3, 2, 1}, {2, 1, 1}, {1, 0, 1}}};
  const std::vector<double> x(graph.edges.size(), 1.0);
  EXPECT_THAT(FindSubtours(graph, x), ElementsAre(ElementsAre(0, 1, 2, 3), ElementsAre(4, 5, 6)));
}

}  // namespace subtours_test
}  // namespace plumescout
