// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/closed_tour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "tests/core/tour/tour_case.h"

namespace plumescout {
namespace closed_tour_test {

using testing::ElementsAre;

// The solver's tolerance, 1e-7 of the longest edge for each node, of at most 100 nodes.
double Tolerance_m(const TourGraph& graph) {
  double longest_m = 0.0;
  for (const TourEdge& edge : graph.edges) longest_m = std::max(longest_m, edge.cost_m);
  return 1e-5 * longest_m;
}

// Length of the tour, which is checked to be one; kNoTour_m if there is none.
double Solve_m(const TourGraph& graph) {
  const absl::StatusOr<ClosedTour> tour = ShortestClosedTour(graph);
  if (tour.status().code() == absl::StatusCode::kNotFound) return kNoTour_m;
  EXPECT_TRUE(tour.ok()) << tour.status();
  if (!tour.ok()) return std::nan("");
  std::vector<int> nodes = tour->order;
  std::sort(nodes.begin(), nodes.end());
  std::vector<int> all(static_cast<std::size_t>(graph.nodes));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(nodes, all);
  EXPECT_NEAR(tour->length_m, TourLength_m(graph, tour->order), 1e-9 * tour->length_m);
  return tour->length_m;
}

void ExpectLength(const TourGraph& graph, double length_m) {
  const double found_m = Solve_m(graph);
  if (std::isinf(length_m)) {
    EXPECT_EQ(found_m, length_m);
  } else {
    EXPECT_NEAR(found_m, length_m, Tolerance_m(graph));
  }
}

TEST(ClosedTour, SmallGridsAreToursOfTheDynamicProgramme) {
  for (const Cell size : {Cell{2, 2}, Cell{2, 3}, Cell{3, 3}, Cell{3, 4}, Cell{4, 4}, Cell{3, 5}}) {
    SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
    const TourGraph graph = MeshGraph(LatticePoints(size.x, size.y), 10.0);
    ExpectLength(graph, HeldKarpTour_m(graph));
  }
}

TEST(ClosedTour, GridsWithAnEvenSideNeedNoDiagonal) {
  for (const Cell size : {Cell{5, 6}, Cell{6, 6}, Cell{7, 8}, Cell{8, 8}}) {
    SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
    ExpectLength(MeshGraph(LatticePoints(size.x, size.y), 10.0), size.x * size.y * 10.0);
  }
}

TEST(ClosedTour, GridsWithOddSidesNeedOneDiagonal) {
  for (const Cell size : {Cell{3, 3}, Cell{5, 5}, Cell{5, 7}, Cell{7, 7}}) {
    SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
    ExpectLength(MeshGraph(LatticePoints(size.x, size.y), 10.0),
                 (size.x * size.y - 1 + std::numbers::sqrt2) * 10.0);
  }
}

TEST(ClosedTour, AGridWithAMissingNodeIsATourAroundIt) {
  const std::vector<Cell> grid = LatticePoints(4, 4);
  for (std::size_t missing = 0; missing < grid.size(); ++missing) {
    std::vector<Cell> points = grid;
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(missing));
    const TourGraph graph = MeshGraph(points, 10.0);
    ExpectLength(graph, HeldKarpTour_m(graph));
  }
}

TEST(ClosedTour, SparseRandomGraphsAreToursOfBruteForceOrNone) {
  int without = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const TourGraph graph = RandomGraph(8, 0.45, seed);
    const double length_m = BruteForceTour_m(graph);
    without += std::isinf(length_m) ? 1 : 0;
    ExpectLength(graph, length_m);
  }
  EXPECT_GT(without, 5);  // both kinds occur
  EXPECT_LT(without, 35);
}

TEST(ClosedTour, CompleteRandomGraphsAreToursOfTheDynamicProgramme) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const TourGraph graph = RandomGraph(13, 1.0, seed);
    ExpectLength(graph, HeldKarpTour_m(graph));
  }
}

TEST(ClosedTour, CostsNeedNotBeDistances) {
  Rng rng(7);
  for (int round = 0; round < 10; ++round) {
    TourGraph graph = RandomGraph(10, 0.8, 1);
    for (TourEdge& edge : graph.edges) edge.cost_m = std::pow(rng.Uniform01(), 4.0);
    ExpectLength(graph, HeldKarpTour_m(graph));
  }
}

TEST(ClosedTour, TheScaleOfCostsDoesNotMatter) {
  for (const double spacing_m : {0.0, 1e-9, 1e9, 1e300}) {
    SCOPED_TRACE(spacing_m);
    const TourGraph graph = MeshGraph(LatticePoints(3, 3), spacing_m);
    ExpectLength(graph, (8.0 + std::numbers::sqrt2) * spacing_m);
  }
}

TEST(ClosedTour, GraphsThatComeApartHaveNoTour) {
  TourGraph graph = Prism();
  graph.edges.resize(6);  // without links
  ExpectLength(graph, kNoTour_m);
  graph.edges.push_back({2, 3, 1.0});  // a bridge would have to be crossed twice
  ExpectLength(graph, kNoTour_m);
}

TEST(ClosedTour, APetersenGraphHasNoTour) {
  TourGraph graph{10, {}};
  for (int i = 0; i < 5; ++i) {
    graph.edges.push_back({i, (i + 1) % 5, 1.0});
    graph.edges.push_back({i, i + 5, 1.0});
    graph.edges.push_back({i + 5, (i + 2) % 5 + 5, 1.0});
  }
  ExpectLength(graph, kNoTour_m);
}

TEST(ClosedTour, ARowOfPointsHasNoTour) {
  ExpectLength(MeshGraph(LatticePoints(5, 1), 10.0), kNoTour_m);
  ExpectLength({3, {}}, kNoTour_m);
}

TEST(ClosedTour, TwoNodesAreATourThereAndBack) {
  ExpectLength({2, {{1, 0, 3.5}}}, 7.0);
  ExpectLength({2, {}}, kNoTour_m);
}

TEST(ClosedTour, OneNodeIsATourOfNoLength) { ExpectLength({1, {}}, 0.0); }

TEST(ClosedTour, OrderBeginsAtNodeZeroTowardsItsLesserNeighbour) {
  const TourGraph ring = {5, {{0, 3, 1.0}, {3, 1, 1.0}, {1, 4, 1.0}, {4, 2, 1.0}, {2, 0, 1.0}}};
  const absl::StatusOr<ClosedTour> tour = ShortestClosedTour(ring);
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_THAT(tour->order, ElementsAre(0, 2, 4, 1, 3));
  EXPECT_EQ(tour->length_m, 5.0);
}

TEST(ClosedTour, MalformedGraphsAreRefused) {
  for (const TourGraph& graph :
       {TourGraph{0, {}}, TourGraph{3, {{0, 3, 1.0}}}, TourGraph{2, {{0, 1, std::nan("")}}}}) {
    EXPECT_EQ(ShortestClosedTour(graph).status().code(), absl::StatusCode::kInvalidArgument);
  }
}

TEST(ClosedTour, ASearchThatIsStoppedSaysSo) {
  EXPECT_EQ(ShortestClosedTour(Prism(), [] { return true; }).status().code(),
            absl::StatusCode::kDeadlineExceeded);
}

TEST(ClosedTour, SeveralThreadsFindTheTourOfOne) {
  const TourGraph grid = MeshGraph(LatticePoints(7, 7), 10.0);
  const TourGraph complete = RandomGraph(25, 1.0, 3);
  const auto orders = [&] {
    return std::vector<std::vector<int>>{ShortestClosedTour(grid)->order,
                                         ShortestClosedTour(complete)->order};
  };
  const std::vector<std::vector<int>> alone = orders();
  std::vector<std::vector<std::vector<int>>> together(4);
  std::vector<std::thread> threads;
  for (auto& mine : together) threads.emplace_back([&mine, &orders] { mine = orders(); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(together, testing::Each(alone));
}

}  // namespace closed_tour_test
}  // namespace plumescout
