// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/information.h"

namespace plumescout::lab {

// Mean, as deviation from the background, and variance of each variable.
struct PeerPosterior {
  std::vector<double> deviation_ppm;
  std::vector<double> variance_ppm2;
};

// What one writes with a library and the textbook: its simplicial Cholesky, ordered by AMD from
// scratch, a solve for the mean, and Takahashi's recursion entry by entry for the variances.
// CHOLMOD is as the auditor has it (core/linalg/cholmod_solve.h). Errors: kInternal if the
// factorisation fails.
absl::StatusOr<PeerPosterior> SolveByCholmod(const Information& information);
absl::StatusOr<PeerPosterior> SolveByEigen(const Information& information);

// The inverse written out, O(n^3).
PeerPosterior SolveDensely(const Information& information);

}  // namespace plumescout::lab
