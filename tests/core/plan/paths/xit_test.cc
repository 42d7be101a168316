// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/xit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/plan/cost/sampler.h"
#include "core/plan/paths/connection_radius.h"
#include "lab/worlds/grid_oracle.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace xit_test {

using testing::PathCase;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;

PlanningOptions Samples(int samples) {
  PlanningOptions options;
  options.sample_count = samples;
  return options;
}

TEST(Xit, FindsPathsFromTheStartToTheGoalCellsThatHitNothing) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const PathCase c(seed);
    const PathResult result = XitPlanner(Samples(150)).FindPaths(c.Problem(seed));
    ASSERT_EQ(result.paths.size(), c.goals.size());
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      if (!result.paths[i]) continue;
      ++found;
      const std::vector<Point2>& path = result.paths[i]->vertices;
      EXPECT_EQ(path.front(), c.start);
      EXPECT_EQ(path.back(), c.goals[i].position);
      EXPECT_TRUE(testing::StaysClear(c.information.penalty, path)) << "seed " << seed;
    }
  }
  EXPECT_GT(found, 100);  // of 120
}

TEST(Xit, PricesPathsAsTheSumOfTheirEdges) {
  for (const double alpha_per_m : {0.0, 2.0}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const PathCase c(seed, {}, CostKind::kUcb, alpha_per_m);
      for (const auto& path : XitPlanner(Samples(150)).FindPaths(c.Problem()).paths) {
        if (path) {
          EXPECT_NEAR(path->cost, PathCost(c.cost, path->vertices), kRounding);
        }
      }
    }
  }
}

TEST(Xit, ShowsATreeInWhichEveryPathIsAWayFromTheRoot) {
  const PathCase c(3);
  std::vector<TreeEdge> tree;
  PathProblem problem = c.Problem();
  problem.tree = &tree;
  const PathResult result = XitPlanner(Samples(150)).FindPaths(problem);

  EXPECT_EQ(result.paths, XitPlanner(Samples(150)).FindPaths(c.Problem()).paths);
  EXPECT_EQ(tree.size() + 1, static_cast<std::size_t>(result.effort.vertices));
  for (const auto& path : result.paths) {
    if (!path) continue;
    for (std::size_t i = 0; i + 1 < path->vertices.size(); ++i) {
      const TreeEdge edge{path->vertices[i], path->vertices[i + 1]};
      EXPECT_EQ(std::count(tree.begin(), tree.end(), edge), 1);
    }
  }
}

TEST(Xit, CostsNoLessThanTheStraightLineThroughTheBestCells) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PathCase c(seed, {}, CostKind::kUcb, 1.0);
    const PathResult result = XitPlanner(Samples(150)).FindPaths(c.Problem());
    const float min_penalty = *std::min_element(c.information.penalty.values().begin(),
                                                c.information.penalty.values().end());
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      if (!result.paths[i]) continue;
      const double line_m = Distance_m(c.start, c.goals[i].position);
      EXPECT_GE(result.paths[i]->cost, line_m * (1.0 + min_penalty / 0.1) - kRounding);
    }
  }
}

// The random geometric graph of Algorithm 1, made again from the same draws.
struct RandomGraph {
  RandomGraph(const PathCase& c, const PlanningOptions& options, std::uint64_t seed)
      : nearest_sample_count(options.nearest_sample_count) {
    const GridGeometry& geometry = c.open.geometry();
    Rng rng(seed);
    const Grid<float> mass =
        SamplingMass(c.information, c.reachable, c.start_cell, options.uniform_share);
    for (const Cell cell : DrawSamples(mass, options.sample_count, options.sampling, rng)) {
      points.push_back(geometry.Center(cell));
    }
    samples = points.size();
    const auto cells = std::count(c.reachable.values().begin(), c.reachable.values().end(), 1);
    const double area_m2 = static_cast<double>(cells) * std::pow(geometry.resolution_m, 2);
    radius_m =
        ConnectionRadius_m(area_m2, static_cast<int>(samples), geometry.resolution_m, options);
    for (const Goal& goal : c.goals) points.push_back(goal.position);
    points.push_back(c.start);
  }

  // Whether b is a sample and one of the nearest to a, which is a goal.
  bool IsGoalNeighbour(std::size_t a, std::size_t b) const {
    if (a < samples || a + 1 == points.size() || b >= samples) return false;
    const auto nearer = std::count_if(
        points.begin(), points.begin() + static_cast<std::ptrdiff_t>(samples),
        [&](Point2 p) { return Distance_m(p, points[a]) < Distance_m(points[b], points[a]); });
    return nearer < nearest_sample_count;
  }
  bool Joined(std::size_t a, std::size_t b) const {
    return Distance_m(points[a], points[b]) <= radius_m || IsGoalNeighbour(a, b) ||
           IsGoalNeighbour(b, a);
  }

  std::vector<Point2> points;  // samples, goals, root
  std::size_t samples = 0;
  double radius_m = 0.0;
  int nearest_sample_count;
};

// Prices of the cheapest ways from the root over the whole graph, every edge priced, by
// Bellman-Ford: what Algorithm 1 must find.
std::vector<double> CheapestWays(const RandomGraph& graph, const EdgeCost& cost) {
  struct Edge {
    std::size_t from, to;
    double price;
  };
  std::vector<Edge> edges;
  for (std::size_t a = 0; a < graph.points.size(); ++a) {
    for (std::size_t b = 0; b < graph.points.size(); ++b) {
      if (graph.Joined(a, b)) edges.push_back({a, b, cost(graph.points[a], graph.points[b])});
    }
  }
  std::vector<double> g(graph.points.size(), kInf);
  g.back() = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Edge& edge : edges) {
      if (!(g[edge.from] + edge.price < g[edge.to] - kRounding)) continue;
      g[edge.to] = g[edge.from] + edge.price;
      changed = true;
    }
  }
  return g;
}

TEST(Xit, FindsTheCheapestPathsOfItsGraphWhateverTheHeuristic) {
  struct Price {
    CostKind kind;
    double alpha_per_m;
  };
  for (const Price price : {Price{CostKind::kUcb, 0.0}, Price{CostKind::kUcb, 3.0},
                            Price{CostKind::kVertices, 0.5}, Price{CostKind::kEuclidean, 0.0}}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const PathCase c(seed, {}, price.kind, price.alpha_per_m);
      const PlanningOptions options = Samples(80);
      const PathResult result = XitPlanner(options).FindPaths(c.Problem(seed));
      const RandomGraph graph(c, options, seed);
      const std::vector<double> cheapest = CheapestWays(graph, c.cost);
      for (std::size_t i = 0; i < c.goals.size(); ++i) {
        const double found = result.paths[i] ? result.paths[i]->cost : kInf;
        const double expected = cheapest[graph.samples + i];
        if (expected == kInf) {
          EXPECT_EQ(found, kInf);
        } else {
          EXPECT_NEAR(found, expected, 1e-6) << "seed " << seed;
        }
      }
    }
  }
}

TEST(Xit, EndsAtTheCheapestNeighbourOfTheGoalAsPublished) {
  PlanningOptions options = Samples(80);
  options.goal_vertices = false;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const PathCase c(seed);
    const PathResult result = XitPlanner(options).FindPaths(c.Problem(seed));
    PlanningOptions no_goal_edges = options;
    no_goal_edges.nearest_sample_count = 0;
    RandomGraph graph(c, no_goal_edges, seed);
    // Samples and the root alone.
    graph.points.erase(graph.points.begin() + static_cast<std::ptrdiff_t>(graph.samples),
                       graph.points.end() - 1);
    const std::vector<double> cheapest = CheapestWays(graph, c.cost);
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      std::vector<std::size_t> set(graph.samples);
      for (std::size_t k = 0; k < set.size(); ++k) set[k] = k;
      std::sort(set.begin(), set.end(), [&](std::size_t a, std::size_t b) {
        return Distance_m(graph.points[a], c.goals[i].position) <
               Distance_m(graph.points[b], c.goals[i].position);
      });
      double expected = kInf;
      for (int k = 0; k < options.nearest_sample_count; ++k) {
        expected = std::min(expected, cheapest[set[static_cast<std::size_t>(k)]]);
      }
      const double found = result.paths[i] ? result.paths[i]->cost : kInf;
      if (expected == kInf) {
        EXPECT_EQ(found, kInf);
      } else {
        EXPECT_NEAR(found, expected, 1e-6) << "seed " << seed;
      }
    }
  }
}

TEST(Xit, PricesPathsRightUnderTheInformedHeuristic) {
  double informed_sum = 0.0;
  double cheapest_sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PathCase c(seed, {}, CostKind::kUcb, 1.0);
    PlanningOptions options = Samples(150);
    const PathResult cheapest = XitPlanner(options).FindPaths(c.Problem(seed));
    options.informed_heuristic = true;
    const PathResult informed = XitPlanner(options).FindPaths(c.Problem(seed));
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      ASSERT_EQ(informed.paths[i].has_value(), cheapest.paths[i].has_value());
      if (!informed.paths[i]) continue;
      EXPECT_NEAR(informed.paths[i]->cost, PathCost(c.cost, informed.paths[i]->vertices),
                  kRounding);
      EXPECT_GE(informed.paths[i]->cost, cheapest.paths[i]->cost - kRounding);
      informed_sum += informed.paths[i]->cost;
      cheapest_sum += cheapest.paths[i]->cost;
    }
  }
  EXPECT_LT(informed_sum, 1.1 * cheapest_sum) << "inadmissible, but no waste";
}

// Mean price over that of the 32-connected grid, of goals that were reached.
double OverOracle(int samples) {
  double sum = 0.0;
  int goals = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const PathCase c(seed);
    const Grid<double> oracle = lab::OracleCosts(c.cost, c.start_cell, 32);
    const PathResult result = XitPlanner(Samples(samples)).FindPaths(c.Problem(seed));
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      if (!result.paths[i] || c.goals[i].cell == c.start_cell) continue;
      sum += result.paths[i]->cost / oracle[c.goals[i].cell];
      ++goals;
    }
  }
  return sum / goals;
}

TEST(Xit, ApproachesTheBestPathAsSamplesGrow) {  // [XIT] Theorem 2
  const double few = OverOracle(60);
  const double more = OverOracle(400);
  const double most = OverOracle(2000);
  EXPECT_GT(few, more);
  EXPECT_GT(more, most);
  EXPECT_LT(most, 1.01);  // at 2000 of some 2200 cells straight edges beat 32 directions
}

TEST(Xit, GivesTheSameBytesForTheSameSeed) {
  const PathCase c(3);
  const XitPlanner xit(Samples(150));
  const PathResult first = xit.FindPaths(c.Problem(5));
  const PathResult second = xit.FindPaths(c.Problem(5));
  EXPECT_TRUE(first.paths == second.paths);
  EXPECT_EQ(first.effort, second.effort);
  EXPECT_FALSE(first.paths == xit.FindPaths(c.Problem(6)).paths);
}

TEST(Xit, SaysHowHardItWorked) {
  const PathCase c(3);
  const PathResult result = XitPlanner(Samples(150)).FindPaths(c.Problem());
  EXPECT_EQ(result.effort.samples, 150);
  EXPECT_GT(result.effort.vertices, 1);
  EXPECT_LE(result.effort.vertices, 150 + 4 + 1);
  EXPECT_GE(result.effort.edges_evaluated, result.effort.vertices - 1);
  EXPECT_EQ(result.effort.goals_by_guard, 0);
}

TEST(Xit, EndsWhenAllGoalsAreReachedOrTheQueueIsEmpty) {
  const PathCase c(3);
  EXPECT_EQ(XitPlanner(Samples(600)).FindPaths(c.Problem()).end, PlanEnd::kAllGoalsReached);
  PathCase sealed(3);
  sealed.goals.push_back(testing::GoalAt(testing::CellInArt({"..x"}, 'x'), sealed.open.geometry()));
  sealed.goals.back().cell = Cell{-5, -5};  // no way there
  sealed.goals.back().position = sealed.open.geometry().Center({-5, -5});
  const PathResult result = XitPlanner(Samples(600)).FindPaths(sealed.Problem());
  EXPECT_EQ(result.end, PlanEnd::kQueueExhausted);
  EXPECT_FALSE(result.paths.back().has_value());
  EXPECT_TRUE(result.paths.front().has_value());
}

TEST(Xit, StopsWhenTold) {
  PathCase c(3);
  c.stop = [] { return true; };
  const PathResult result = XitPlanner(Samples(150)).FindPaths(c.Problem());
  EXPECT_EQ(result.end, PlanEnd::kStopped);
  EXPECT_EQ(result.effort.edges_evaluated, 0);
}

TEST(Xit, StoppedHalfWayReturnsPathsThatHitNothing) {
  PathCase c(3);
  std::size_t found_before = 0;
  for (const int polls : {5, 20, 60, 150}) {
    int polled = 0;
    c.stop = [&polled, polls] { return ++polled > polls; };
    const PathResult result = XitPlanner(Samples(600)).FindPaths(c.Problem());
    std::size_t found = 0;
    for (const auto& path : result.paths) {
      if (!path) continue;
      ++found;
      EXPECT_TRUE(testing::StaysClear(c.information.penalty, path->vertices));
      EXPECT_NEAR(path->cost, PathCost(c.cost, path->vertices), kRounding);
    }
    EXPECT_GE(found, found_before);
    found_before = found;
  }
  EXPECT_GT(found_before, 0U);
}

TEST(Xit, KeepsWithinItsEdgeBudget) {
  const PathCase c(3);
  const XitPlanner xit(Samples(600));
  const int needed = xit.FindPaths(c.Problem()).effort.edges_evaluated;
  const PathResult half = xit.FindPaths(c.Problem(1, needed / 2));
  EXPECT_EQ(half.end, PlanEnd::kStopped);
  EXPECT_EQ(half.effort.edges_evaluated, needed / 2);
  EXPECT_EQ(xit.FindPaths(c.Problem(1, needed)).end, PlanEnd::kAllGoalsReached);
}

TEST(Xit, ReachesAGoalUnderTheRobotAtOnce) {
  PathCase c(3);
  c.goals = {testing::GoalAt(c.start_cell, c.open.geometry())};
  const PathResult result = XitPlanner(Samples(50)).FindPaths(c.Problem());
  ASSERT_TRUE(result.paths[0].has_value());
  EXPECT_EQ(result.paths[0]->cost, 0.0);
}

TEST(Xit, ManagesOnAMapOfOneCell) {
  PathCase c(1, {1, 1, 0, 1});
  const PathResult result = XitPlanner(Samples(300)).FindPaths(c.Problem());
  EXPECT_EQ(result.effort.samples, 0);
  EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
}

TEST(Xit, WithoutGoalsHasNothingToDo) {
  PathCase c(3);
  c.goals.clear();
  EXPECT_EQ(XitPlanner(Samples(300)).FindPaths(c.Problem()).end, PlanEnd::kAllGoalsReached);
}

}  // namespace xit_test
}  // namespace plumescout
