// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/tour_graph.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// What is wrong with an edge by itself; empty if nothing is.
const char* Fault(const TourEdge& edge, int nodes) {
  const auto is_node = [nodes](int node) { return node >= 0 && node < nodes; };
  if (!is_node(edge.a) || !is_node(edge.b)) return " leads to no node";
  if (edge.a == edge.b) return " leads back to its node";
  if (!(std::isfinite(edge.cost_m) && edge.cost_m >= 0.0)) return " must be finite and >= 0";
  return "";
}

absl::Status Malformed(const TourGraph& graph, std::size_t index, const char* fault) {
  const TourEdge& edge = graph.edges[index];
  return absl::InvalidArgumentError(absl::StrCat("edges[", index, "] = (", edge.a, ", ", edge.b,
                                                 ", ", edge.cost_m, " m) of ", graph.nodes,
                                                 " nodes", fault));
}

}  // namespace

absl::Status Validate(const TourGraph& graph) {
  PLUMESCOUT_RETURN_IF_ERROR(Checker().AtLeast("nodes", graph.nodes, 1).status());
  std::set<std::pair<int, int>> joined;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const char* const fault = Fault(graph.edges[i], graph.nodes);
    if (*fault != '\0') return Malformed(graph, i, fault);
    if (!joined.insert(std::minmax(graph.edges[i].a, graph.edges[i].b)).second) {
      return Malformed(graph, i, " joins nodes that have an edge already");
    }
  }
  return absl::OkStatus();
}

std::vector<Cell> LatticePoints(int width, int height) {
  std::vector<Cell> points;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) points.push_back({x, y});
  }
  return points;
}

TourGraph MeshGraph(std::span<const Cell> points, double spacing_m) {
  // Half of U of [LHR] Eq. (2): each edge is met from one of its ends.
  constexpr Cell kSteps[] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
  std::map<Cell, int> node_at;
  for (const Cell point : points) node_at.emplace(point, static_cast<int>(node_at.size()));
  TourGraph graph{static_cast<int>(points.size()), {}};
  for (int node = 0; node < graph.nodes; ++node) {
    const Cell point = points[static_cast<std::size_t>(node)];
    for (const Cell step : kSteps) {
      const auto other = node_at.find({point.x + step.x, point.y + step.y});
      if (other == node_at.end()) continue;
      const bool diagonal = step.x != 0 && step.y != 0;
      const double steps = diagonal ? std::numbers::sqrt2 : 1.0;
      graph.edges.push_back({node, other->second, steps * spacing_m});
    }
  }
  return graph;
}

}  // namespace plumescout
