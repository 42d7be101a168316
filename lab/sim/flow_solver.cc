// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/flow_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout::lab {

absl::StatusOr<FlowSolver> FlowSolver::Create(const FlowDomain& domain, double viscosity_m2_per_s) {
  const FreeFaces free(domain);
  PLUMESCOUT_ASSIGN_OR_RETURN(Projection projection, Projection::Create(domain, free));
  FlowSolver solver(domain, free, std::move(projection), viscosity_m2_per_s);
  PLUMESCOUT_RETURN_IF_ERROR(solver.projection_.Project(solver.velocity_));
  return solver;
}

FlowSolver::FlowSolver(const FlowDomain& domain, const FreeFaces& free, Projection projection,
                       double viscosity_m2_per_s)
    : viscosity_m2_per_s_(viscosity_m2_per_s),
      momentum_(domain, free),
      projection_(std::move(projection)),
      velocity_(domain.fluid.geometry()),
      rate_mps2_(velocity_.values().size()) {
  for (const BoundaryFace& opening : domain.openings) {
    const OpeningFaces faces = FacesOf(opening);
    velocity_.values()[IndexOf(faces.outer, velocity_)] =
        faces.inward * opening.inflow_mps.value_or(0.0);
  }
  for (const FanFace& fan : domain.fans) {
    velocity_.values()[IndexOf(FaceOf(fan), velocity_)] = fan.speed_mps;
  }
  for (const double speed : domain.edge_speeds_mps) {
    fastest_edge_mps_ = std::max(fastest_edge_mps_, std::abs(speed));
  }
}

double FlowSolver::StableStep_s() const {
  const double h = velocity_.geometry().resolution_m;
  const double fastest_mps = std::max(velocity_.FastestCell_mps(), fastest_edge_mps_);
  return 1.0 / (fastest_mps / h + 4.0 * viscosity_m2_per_s_ / (h * h));
}

void FlowSolver::Accelerate(double step_s) {
  momentum_.Rate(velocity_, viscosity_m2_per_s_, rate_mps2_);
  const std::span<double> speeds = velocity_.values();
  for (const std::uint32_t face : momentum_.moving()) speeds[face] += step_s * rate_mps2_[face];
}

// Heun's method in its strong-stability-preserving form: the mean of the old state and of two Euler
// steps.
absl::Status FlowSolver::Step(double step_s) {
  before_ = velocity_;
  Accelerate(step_s);
  PLUMESCOUT_RETURN_IF_ERROR(projection_.Project(velocity_));
  Accelerate(step_s);
  velocity_.AddScaled(velocity_, -0.5);
  velocity_.AddScaled(before_, 0.5);
  return projection_.Project(velocity_);
}

}  // namespace plumescout::lab
