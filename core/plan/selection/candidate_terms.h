// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/plan/cost/edge_cost.h"
#include "core/types/grid.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"

namespace plumescout {

// What a path is judged by.
struct CandidateJudge {
  const EdgeCost& selection_cost;    // J of [XIT] Eq. (13)
  const Grid<float>& mean_ppm;       // NaN where not yet computed
  double background_mean_ppm = 0.0;  // m_0, taken there
};

// The candidate with every term of its price, by line integrals over `path`:
//   cost                     J under the selection cost
//   information_penalty      sum of P, in cells
//   mean_ucb                 mean of I-hat, [MIT] Eq. (3)
//   mean_concentration_ppm   mean of mu
// A path of no length has the means of its one cell.
// REQUIRES: `path` has a vertex and lies in traversable cells. Cost: O(cells crossed).
Candidate MakeCandidate(const Goal& goal, const std::vector<Point2>& path, PathSource source,
                        const CandidateJudge& judge);

}  // namespace plumescout
