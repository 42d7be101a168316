// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/options.h"
#include "core/types/plan.h"

namespace plumescout {

// Index of the next best trajectory, -1 if there is no candidate; the first of equals.
//   kLeastCost         argmin J, [XIT] Eq. (4) and (13)
//   kMeanUcb           argmax mean I-hat along the path, [MIT] Eq. (3); of I itself it would be the
//                      same, for I-hat rises linearly with it
//   kInformationRate   argmax expected information per second of those priced; the least cost if
//                      none is (ours)
int SelectCandidate(const std::vector<Candidate>& candidates, SelectionRule rule);

// Whether `best` beats `kept`, by the rule, by more than `margin`: a share of the kept one's merit.
bool BeatsByMargin(const Candidate& best, const Candidate& kept, SelectionRule rule, double margin);

}  // namespace plumescout
