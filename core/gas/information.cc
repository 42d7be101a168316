// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/information.h"

#include <cassert>
#include <cstddef>

namespace plumescout {
namespace {

constexpr std::size_t kMostEntriesPerColumn = 3;  // the variable itself, east, north

// Number of prior factors of each variable.
std::vector<int> Degrees(const GmrfGraph& graph) {
  std::vector<int> degree(static_cast<std::size_t>(graph.variables()), 0);
  for (int i = 0; i < graph.variables(); ++i) {
    for (const VariableIndex j : graph.later_neighbours(VariableIndex{i})) {
      if (j == VariableIndex::kNone) continue;
      ++degree[static_cast<std::size_t>(i)];
      ++degree[ToSize(j)];
    }
  }
  return degree;
}

}  // namespace

Information BuildInformation(const GmrfGraph& graph, std::span<const Evidence> evidence,
                             const GasOptions& options) {
  const std::size_t n = static_cast<std::size_t>(graph.variables());
  assert(evidence.size() == n);
  const std::vector<int> degree = Degrees(graph);
  Information information;
  SymmetricMatrix& h = information.hessian;
  h.n = graph.variables();
  h.column_start.reserve(n + 1);
  h.row.reserve(kMostEntriesPerColumn * n);
  h.value.reserve(kMostEntriesPerColumn * n);
  information.negative_gradient.reserve(n);
  for (int i = 0; i < h.n; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    h.row.push_back(i);
    h.value.push_back(options.background_precision_per_ppm2 + evidence[k].precision +
                      degree[k] * options.prior_precision_per_ppm2);
    for (const VariableIndex j : graph.later_neighbours(VariableIndex{i})) {
      if (j == VariableIndex::kNone) continue;
      h.row.push_back(static_cast<int>(j));
      h.value.push_back(-options.prior_precision_per_ppm2);
    }
    h.column_start.push_back(static_cast<int>(h.row.size()));
    information.negative_gradient.push_back(evidence[k].weighted_deviation);
  }
  return information;
}

}  // namespace plumescout
