// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/tour/tour_graph.h"
#include "core/types/stop.h"

namespace plumescout {

struct ClosedTour {
  std::vector<int> order;  // every node once, from node 0 towards the lesser of its two neighbours
  double length_m = 0.0;   // with the way back from the last node to the first
};

// Shortest closed tour of all nodes, [LHR] (P1), proven up to 1e-7 of the longest edge for each
// node. A tour of two nodes goes there and back, one of a single node is 0 m long.
//
// [LHR] Remark 2: solved without subtour constraints; those that the solution violates are added
// until there are none. Ours: first with edges that may be taken in part, where a constraint costs
// a few steps of the simplex method instead of an integer search.
//
// `stop` is asked between solutions and at every node of the integer search. Deterministic.
// Errors:
//   kInvalidArgument   malformed graph, see Validate
//   kNotFound          there is no closed tour
//   kDeadlineExceeded  stopped before the tour was known
//   kInternal          the solver gave up
// Cost: exponential at worst; see docs/performance.md for what it takes.
absl::StatusOr<ClosedTour> ShortestClosedTour(const TourGraph& graph,
                                              const StopFn& stop = NeverStop());

}  // namespace plumescout
