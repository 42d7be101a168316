// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "core/tour/tour_graph.h"
#include "core/types/stop.h"

namespace plumescout {

// The integer program [LHR] (P1) with the subtour constraints that have been added so far: which
// edges to take, two at each node, at least cost. The only user of GLPK; see
// docs/decisions/0008-survey-tours.md.
//
// A solution is a value per edge, and the best one up to 1e-7 of the longest edge for each node,
// the solver's tolerance. The same calls give the same bytes. Threads may solve programs at the
// same time, each its own: a program is made, used and destroyed in one thread. Errors: kNotFound
// if nothing fulfils the constraints, kInternal if the solver gives up.
class TourProgram {
 public:
  // REQUIRES: Validate(graph).ok().
  explicit TourProgram(const TourGraph& graph);
  ~TourProgram();

  // (P1b) for these nodes: between them, fewer edges than nodes are taken.
  void ForbidSubtour(const std::vector<int>& nodes);

  // With edges that may be taken in part.
  absl::StatusOr<std::vector<double>> SolveRelaxed();

  // With edges that are taken, 1, or not, 0. kDeadlineExceeded if it is stopped.
  absl::StatusOr<std::vector<double>> Solve(const StopFn& stop);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace plumescout
