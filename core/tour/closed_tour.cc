// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/closed_tour.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "absl/status/status.h"
#include "core/tour/subtours.h"
#include "core/tour/tour_program.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

absl::StatusOr<ClosedTour> ThereAndBack(const TourGraph& graph) {
  if (graph.nodes == 1) return ClosedTour{{0}, 0.0};
  if (graph.edges.empty()) return absl::NotFoundError("there is no way between the two nodes");
  return ClosedTour{{0, 1}, 2.0 * graph.edges[0].cost_m};
}

// The tour that is made of the edges with x = 1.
ClosedTour FollowEdges(const TourGraph& graph, std::span<const double> x) {
  std::vector<std::vector<TourEdge>> leaving(static_cast<std::size_t>(graph.nodes));
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (x[i] == 0.0) continue;
    const auto [a, b, cost_m] = graph.edges[i];
    leaving[static_cast<std::size_t>(a)].push_back({a, b, cost_m});
    leaving[static_cast<std::size_t>(b)].push_back({b, a, cost_m});
  }
  const auto at_lesser = [](const TourEdge& left, const TourEdge& right) {
    return left.b < right.b;
  };
  TourEdge step = *std::min_element(leaving[0].begin(), leaving[0].end(), at_lesser);
  ClosedTour tour{{0}, step.cost_m};
  while (step.b != 0) {
    tour.order.push_back(step.b);
    const std::vector<TourEdge>& ways = leaving[static_cast<std::size_t>(step.b)];
    step = ways[0].b == step.a ? ways[1] : ways[0];
    tour.length_m += step.cost_m;
  }
  return tour;
}

}  // namespace

absl::StatusOr<ClosedTour> ShortestClosedTour(const TourGraph& graph, const StopFn& stop) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(graph));
  if (graph.nodes <= 2) return ThereAndBack(graph);
  TourProgram program(graph);
  for (bool whole_edges = false;;) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<double> x,
                                whole_edges ? program.Solve(stop) : program.SolveRelaxed());
    const std::vector<std::vector<int>> subtours = FindSubtours(graph, x);
    if (subtours.empty() && whole_edges) return FollowEdges(graph, x);
    if (stop()) return absl::DeadlineExceededError("stopped before the shortest tour was found");
    if (subtours.empty()) whole_edges = true;
    for (const std::vector<int>& nodes : subtours) program.ForbidSubtour(nodes);
  }
}

}  // namespace plumescout
