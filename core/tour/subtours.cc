// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/subtours.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

namespace plumescout {
namespace {

// An edge is taken if it is so by more: the solver's rounding is finer.
constexpr double kTaken = 1e-6;

// Sets of nodes, joined step by step; a set goes by its least node.
class DisjointSets {
 public:
  explicit DisjointSets(int nodes) : lesser_(static_cast<std::size_t>(nodes)) {
    std::iota(lesser_.begin(), lesser_.end(), 0);
  }

  int SetOf(int node) {
    while (Lesser(node) != node) node = Lesser(node) = Lesser(Lesser(node));
    return node;
  }

  void Join(int a, int b) {
    const auto [least, other] = std::minmax({SetOf(a), SetOf(b)});
    Lesser(other) = least;
  }

 private:
  int& Lesser(int node) { return lesser_[static_cast<std::size_t>(node)]; }

  std::vector<int> lesser_;  // of each node, in its set; itself if it is the least
};

}  // namespace

std::vector<std::vector<int>> FindSubtours(const TourGraph& graph, std::span<const double> x) {
  DisjointSets sets(graph.nodes);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (x[i] > kTaken) sets.Join(graph.edges[i].a, graph.edges[i].b);
  }
  std::map<int, std::vector<int>> nodes_of;
  for (int node = 0; node < graph.nodes; ++node) nodes_of[sets.SetOf(node)].push_back(node);
  std::vector<std::vector<int>> subtours;
  if (nodes_of.size() < 2) return subtours;
  for (auto& [set, nodes] : nodes_of) subtours.push_back(std::move(nodes));
  return subtours;
}

}  // namespace plumescout
