// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/wind.h"

#include <algorithm>

#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "lab/sim/flow_solver.h"

namespace plumescout::lab {
namespace {

constexpr double kMaxViscosity_m2_per_s = 10.0;
constexpr double kMaxFlow_s = 3600.0;

}  // namespace

absl::Status Validate(const WindOptions& options) {
  return Checker()
      .InRangeAbove("wind.viscosity_m2_per_s", options.viscosity_m2_per_s, 0.0,
                    kMaxViscosity_m2_per_s)
      .InRangeAbove("wind.flow_s", options.flow_s, 0.0, kMaxFlow_s)
      .InRangeAbove("wind.stability_share", options.stability_share, 0.0, 1.0)
      .status();
}

absl::StatusOr<MacField> SolveWind(const FlowDomain& domain, const WindOptions& options,
                                   const FractionFn& progress) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  MacField mean(domain.fluid.geometry());
  PLUMESCOUT_ASSIGN_OR_RETURN(FlowSolver solver,
                              FlowSolver::Create(domain, options.viscosity_m2_per_s));
  if (options.model == WindModel::kPotential) {
    if (progress) progress(1.0);
    return solver.velocity();
  }
  double time_s = 0.0;
  double averaged_s = 0.0;
  while (time_s < options.flow_s) {
    const double step_s = options.stability_share * solver.StableStep_s();
    PLUMESCOUT_RETURN_IF_ERROR(solver.Step(step_s));
    time_s += step_s;
    if (progress) progress(std::min(1.0, time_s / options.flow_s));
    if (time_s < options.flow_s / 2.0) continue;
    // Running mean: a mean of divergence-free fields is divergence-free.
    averaged_s += step_s;
    const double share = step_s / averaged_s;
    mean.AddScaled(mean, -share);
    mean.AddScaled(solver.velocity(), share);
  }
  return mean;
}

}  // namespace plumescout::lab
