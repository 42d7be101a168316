// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/options.h"
#include "core/types/plan.h"

namespace plumescout {

// The gas field has no cells behind an occupancy frontier, so what readings there would tell cannot
// be priced. It counts as this much, nats. Found by trial, where from 10 to 30 are equal
// (docs/decisions/0007-own-strategy.md): without it rooms that promise little stay unseen.
inline constexpr double kUnseen_nats = 20.0;

// Expected information, nats, and kUnseen_nats if the way ends at an occupancy frontier.
// REQUIRES: the candidate is priced.
double Worth_nats(const Candidate& candidate);

// Index of the next best trajectory, -1 if there is no candidate; the first of equals.
//   kLeastCost         argmin J, [XIT] Eq. (4) and (13)
//   kMeanUcb           argmax mean I-hat along the path, [MIT] Eq. (3); of I itself it would be the
//                      same, for I-hat rises linearly with it
//   kInformationRate   argmax of what they are worth, as below, per second of those priced; the
//                      least cost if none is (ours)
int SelectCandidate(const std::vector<Candidate>& candidates, SelectionRule rule);

// Whether `best` beats `kept`, by the rule, by more than `margin`: a share of the kept one's merit.
bool BeatsByMargin(const Candidate& best, const Candidate& kept, SelectionRule rule, double margin);

}  // namespace plumescout
