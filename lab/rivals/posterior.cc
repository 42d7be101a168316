// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/posterior.h"

#include <cstddef>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout::lab {

absl::StatusOr<Posterior> PosteriorSolver::Solve(const GmrfGraph& graph,
                                                 std::span<const Evidence> evidence,
                                                 const GasOptions& options) {
  Information information = BuildInformation(graph, evidence, options);
  PLUMESCOUT_RETURN_IF_ERROR(cholesky_.Factorize(information.hessian));
  Posterior posterior;
  posterior.mean_ppm = std::move(information.negative_gradient);
  PLUMESCOUT_RETURN_IF_ERROR(cholesky_.Solve(posterior.mean_ppm, posterior.mean_ppm));
  for (double& mean_ppm : posterior.mean_ppm) mean_ppm += options.background_mean_ppm;
  posterior.variance_ppm2.resize(posterior.mean_ppm.size());
  PLUMESCOUT_RETURN_IF_ERROR(cholesky_.InverseDiagonal(posterior.variance_ppm2));
  return posterior;
}

}  // namespace plumescout::lab
