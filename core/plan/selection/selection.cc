// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/selection.h"

#include <algorithm>

namespace plumescout {

int SelectCandidate(const std::vector<Candidate>& candidates, SelectionRule rule) {
  if (candidates.empty()) return -1;
  const auto better = [rule](const Candidate& a, const Candidate& b) {
    return rule == SelectionRule::kLeastCost ? a.cost < b.cost : a.mean_ucb > b.mean_ucb;
  };
  return static_cast<int>(std::min_element(candidates.begin(), candidates.end(), better) -
                          candidates.begin());
}

}  // namespace plumescout
