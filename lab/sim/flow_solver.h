// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "lab/sim/flow_domain.h"
#include "lab/sim/mac_field.h"
#include "lab/sim/momentum.h"
#include "lab/sim/projection.h"

namespace plumescout::lab {

// Two-dimensional incompressible Navier-Stokes on the staggered grid, in time:
//
//   PLUMESCOUT_ASSIGN_OR_RETURN(FlowSolver solver, FlowSolver::Create(domain, viscosity_m2_per_s));
//   while (...) PLUMESCOUT_RETURN_IF_ERROR(solver.Step(share * solver.StableStep_s()));
//
// Second order in space (momentum.h) and in time: Heun's method, each stage projected
// (projection.h). A steady state does not depend on the step.
class FlowSolver {
 public:
  // Begins with the potential flow that inlets and fans drive: what air set in motion at once does.
  // Errors: those of Projection. REQUIRES: viscosity > 0.
  static absl::StatusOr<FlowSolver> Create(const FlowDomain& domain, double viscosity_m2_per_s);

  // At which explicit Euler with first-order upwinding keeps the weight of a face's own old value
  // positive, 1 - dt ((|u| + |v|) / h + 4 nu / h^2), in the fastest cell. Heun's method with the
  // limiter bears as much in practice: measured in halls with jets of 3 m/s.
  double StableStep_s() const;
  absl::Status Step(double step_s);

  const MacField& velocity() const { return velocity_; }

 private:
  FlowSolver(const FlowDomain& domain, const FreeFaces& free, Projection projection,
             double viscosity_m2_per_s);

  // velocity += step * forces on it.
  void Accelerate(double step_s);

  double viscosity_m2_per_s_;
  double fastest_edge_mps_ = 0.0;
  Momentum momentum_;
  Projection projection_;
  MacField velocity_;
  MacField before_;  // at the beginning of the step
  std::vector<double> rate_mps2_;
};

}  // namespace plumescout::lab
