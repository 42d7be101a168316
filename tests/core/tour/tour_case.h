// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/tour/tour_graph.h"
#include "core/types/rng.h"

namespace plumescout {

inline constexpr double kNoTour_m = std::numeric_limits<double>::infinity();

// nodes x nodes by rows; infinite where there is no edge.
inline std::vector<double> CostMatrix_m(const TourGraph& graph) {
  const auto nodes = static_cast<std::size_t>(graph.nodes);
  std::vector<double> cost_m(nodes * nodes, kNoTour_m);
  for (const auto& [a, b, edge_m] : graph.edges) {
    cost_m[static_cast<std::size_t>(a) * nodes + static_cast<std::size_t>(b)] = edge_m;
    cost_m[static_cast<std::size_t>(b) * nodes + static_cast<std::size_t>(a)] = edge_m;
  }
  return cost_m;
}

// Length of the closed tour in this order; infinite if it takes an edge that is not there.
inline double TourLength_m(const TourGraph& graph, const std::vector<int>& order) {
  if (order.size() == 1) return 0.0;
  const std::vector<double> cost_m = CostMatrix_m(graph);
  double length_m = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int next = order[(i + 1) % order.size()];
    length_m += cost_m[static_cast<std::size_t>(order[i] * graph.nodes + next)];
  }
  return length_m;
}

// Oracle: every order of the nodes. Cost: O(nodes!).
inline double BruteForceTour_m(const TourGraph& graph) {
  std::vector<int> order(static_cast<std::size_t>(graph.nodes));
  std::iota(order.begin(), order.end(), 0);
  double best_m = kNoTour_m;
  do {
    best_m = std::min(best_m, TourLength_m(graph, order));
  } while (std::next_permutation(order.begin() + 1, order.end()));
  return best_m;
}

// Oracle: dynamic programme over subsets, for up to 16 nodes. Cost: O(2^nodes nodes^2).
inline double HeldKarpTour_m(const TourGraph& graph) {
  const auto nodes = static_cast<std::size_t>(graph.nodes);
  const std::vector<double> cost_m = CostMatrix_m(graph);
  const std::size_t subsets = std::size_t{1} << nodes;
  std::vector<double> way_m(subsets * nodes,
                            kNoTour_m);  // from node 0 through a subset to its last
  way_m[1 * nodes + 0] = 0.0;
  for (std::size_t subset = 1; subset < subsets; ++subset) {
    for (std::size_t last = 0; last < nodes; ++last) {
      for (std::size_t next = 0; next < nodes; ++next) {
        if ((subset >> next & 1U) != 0) continue;
        double& longer_m = way_m[(subset | std::size_t{1} << next) * nodes + next];
        longer_m = std::min(longer_m, way_m[subset * nodes + last] + cost_m[last * nodes + next]);
      }
    }
  }
  double best_m = kNoTour_m;
  for (std::size_t last = 0; last < nodes; ++last) {
    best_m = std::min(best_m, way_m[(subsets - 1) * nodes + last] + cost_m[last * nodes]);
  }
  return best_m;
}

// Random points on a square of 50 m, joined by straight edges with the given probability.
inline TourGraph RandomGraph(int nodes, double density, std::uint64_t seed) {
  constexpr double kSide_m = 50.0;
  Rng rng(seed);
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i < nodes; ++i) {
    const double x_m = rng.Uniform(0.0, kSide_m);
    points.emplace_back(x_m, rng.Uniform(0.0, kSide_m));
  }
  TourGraph graph{nodes, {}};
  for (int a = 0; a < nodes; ++a) {
    for (int b = a + 1; b < nodes; ++b) {
      const auto [ax_m, ay_m] = points[static_cast<std::size_t>(a)];
      const auto [bx_m, by_m] = points[static_cast<std::size_t>(b)];
      if (rng.Uniform01() < density) {
        graph.edges.push_back({a, b, std::hypot(ax_m - bx_m, ay_m - by_m)});
      }
    }
  }
  return graph;
}

// Two triangles of 2 m edges, node i of one 1 m from node i + 3 of the other.
inline TourGraph Prism() {
  return {6,
          {{0, 1, 2.0},
           {1, 2, 2.0},
           {0, 2, 2.0},
           {3, 4, 2.0},
           {4, 5, 2.0},
           {3, 5, 2.0},
           {0, 3, 1.0},
           {1, 4, 1.0},
           {2, 5, 1.0}}};
}

}  // namespace plumescout
