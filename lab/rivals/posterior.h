// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/gmrf_graph.h"
#include "core/gas/information.h"
#include "core/types/options.h"
#include "lab/linalg/sparse_cholesky.h"

namespace plumescout::lab {

// Marginals of the field, by variable.
struct Posterior {
  std::vector<double> mean_ppm;
  std::vector<double> variance_ppm2;
};

// Computes exact posteriors; keeps the ordering of the last graph for the next call.
class PosteriorSolver {
 public:
  // [IPP] Eq. (2)-(4), (6): m = m_0 + H^-1 (-g), variance = diag(H^-1).
  // Errors: those of SparseCholesky::Factorize.
  absl::StatusOr<Posterior> Solve(const GmrfGraph& graph, std::span<const Evidence> evidence,
                                  const GasOptions& options);

 private:
  SparseCholesky cholesky_;
};

}  // namespace plumescout::lab
