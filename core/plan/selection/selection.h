// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/options.h"
#include "core/types/plan.h"

namespace plumescout {

// Whether there is more to learn at the end of the way than can be priced: the gas field has no
// cells behind an occupancy frontier.
bool EndsAtTheUnseen(const Candidate& candidate);

// `options` with unseen_information_nats as it counts in this field: in proportion to what a
// reading in air that nobody has read tells of its own cell, 1/2 ln(1 + lambda_o epsilon_inf), over
// that with the published precisions. Where readings tell more, so would those behind a frontier.
PlanningOptions InField(PlanningOptions options, const GasOptions& gas);

// Expected information, nats, and its unseen_share of options.unseen_information_nats if the way
// ends at the unseen.
// REQUIRES: the candidate is priced.
double Worth_nats(const Candidate& candidate, const PlanningOptions& options);

// What kInformationRate goes by if the information expected were `nats`: worth per second.
double InformationRate(const Candidate& candidate, double nats, const PlanningOptions& options);

// Index of the next best trajectory by options.selection_rule, -1 if there is no candidate; the
// first of equals.
//   kLeastCost         argmin J, [XIT] Eq. (4) and (13)
//   kMeanUcb           argmax mean I-hat along the path, [MIT] Eq. (3); of I itself it would be the
//                      same, for I-hat rises linearly with it
//   kInformationRate   argmax of what they are worth, as below, per second of those priced; the
//                      least cost if none is (ours)
int SelectCandidate(const std::vector<Candidate>& candidates, const PlanningOptions& options);

// Whether `best` beats `kept`, by the same rule, by more than options.commitment_margin_share: a
// share of the kept one's merit.
bool BeatsByMargin(const Candidate& best, const Candidate& kept, const PlanningOptions& options);

}  // namespace plumescout
