// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/tour_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/types/cell.h"

namespace plumescout {
namespace tour_graph_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string Refusal(const TourGraph& graph) {
  const absl::Status status = Validate(graph);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  return std::string(status.message());
}

TEST(TourGraph, AnEdgeThatLeadsNowhereIsRefusedByIndexAndValue) {
  EXPECT_THAT(Refusal({3, {{0, 1, 1.0}, {1, 3, 2.5}}}), HasSubstr("edges[1] = (1, 3, 2.5 m)"));
  EXPECT_THAT(Refusal({3, {{-1, 1, 1.0}}}), HasSubstr("edges[0] = (-1, 1, 1 m)"));
}

TEST(TourGraph, AnEdgeBackToItsNodeIsRefused) {
  EXPECT_THAT(Refusal({3, {{2, 2, 1.0}}}), HasSubstr("leads back"));
}

TEST(TourGraph, ASecondEdgeBetweenTwoNodesIsRefused) {
  EXPECT_THAT(Refusal({3, {{0, 1, 1.0}, {1, 0, 2.0}}}), HasSubstr("edges[1]"));
}

TEST(TourGraph, CostsThatAreNoLengthAreRefused) {
  for (const double cost_m : {std::nan(""), -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(Refusal({2, {{0, 1, cost_m}}}), HasSubstr("edges[0]")) << cost_m;
  }
}

TEST(TourGraph, NoNodesAreRefused) {
  EXPECT_THAT(Refusal({0, {}}), HasSubstr("nodes = 0"));
  EXPECT_THAT(Refusal({-5, {}}), HasSubstr("nodes = -5"));
}

TEST(TourGraph, EdgesThatCostNothingAreTaken) { EXPECT_TRUE(Validate({2, {{0, 1, 0.0}}}).ok()); }

TEST(TourGraph, LatticePointsGoRowByRow) {
  EXPECT_THAT(LatticePoints(2, 2), ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{0, 1}, Cell{1, 1}));
  EXPECT_THAT(LatticePoints(0, 3), IsEmpty());
}

TEST(TourGraph, AMeshJoinsEightNeighboursOnce) {
  const TourGraph graph = MeshGraph(LatticePoints(4, 3), 10.0);
  EXPECT_EQ(graph.nodes, 12);
  EXPECT_TRUE(Validate(graph).ok());
  int straight = 0;
  int diagonal = 0;
  for (const TourEdge& edge : graph.edges) {
    straight += edge.cost_m == 10.0 ? 1 : 0;
    diagonal += edge.cost_m == 10.0 * std::numbers::sqrt2 ? 1 : 0;
  }
  EXPECT_EQ(straight, 3 * 3 + 4 * 2);
  EXPECT_EQ(diagonal, 2 * 3 * 2);
  EXPECT_EQ(graph.edges.size(), 17U + 12U);
}

TEST(TourGraph, AMeshLeadsAroundPointsThatAreMissing) {
  const std::vector<Cell> corner = {{5, 5}, {-3, 2}, {6, 6}, {6, 5}, {8, 5}};
  const TourGraph graph = MeshGraph(corner, 1.0);
  EXPECT_EQ(graph.nodes, 5);
  ASSERT_EQ(graph.edges.size(), 3U);  // 0-2, 0-3, 2-3
  for (const TourEdge& edge : graph.edges) {
    EXPECT_THAT((std::vector<int>{edge.a, edge.b}), testing::Each(testing::AnyOf(0, 2, 3)));
  }
}

}  // namespace tour_graph_test
}  // namespace plumescout
