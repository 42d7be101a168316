// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/options.h"
#include "core/types/plan.h"

namespace plumescout {

// Index of the next best trajectory, -1 if there is no candidate; the first of equals.
//   kLeastCost   argmin J, [XIT] Eq. (4) and (13)
//   kMeanUcb     argmax mean I-hat along the path, [MIT] Eq. (3)
int SelectCandidate(const std::vector<Candidate>& candidates, SelectionRule rule);

}  // namespace plumescout
