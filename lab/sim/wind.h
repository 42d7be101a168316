// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "lab/sim/flow_domain.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

enum class WindModel {
  kNavierStokes,
  kPotential,  // inviscid and without eddies: one solve instead of thousands, but no jets or wakes
};

struct WindOptions {
  WindModel model = WindModel::kNavierStokes;
  double viscosity_m2_per_s = 0.03;  // of the turbulent air, (0, 10]
  double flow_s = 30.0;              // simulated; the second half is averaged, (0, 3600]
  double stability_share = 0.9;      // of the longest stable step, (0, 1]
};

// Told the finished share now and then.
using FractionFn = std::function<void(double fraction)>;

// kInvalidArgument naming field, value and range.
absl::Status Validate(const WindOptions& options);

// Mean wind of a building from its plan alone: two-dimensional incompressible Navier-Stokes on the
// staggered grid, from the moment that inlets and fans begin to blow (FlowSolver, which is tried on
// published flows by the experiment wind_validation).
//   momentum   second order, limited, with a constant turbulent viscosity
//   walls      no slip
//   openings   inlets at a given speed; outlets at ambient pressure
//   fans       faces held at a speed; they need no opening
//   step       as long as is stable: changes with the fastest air, depends on nothing else, so the
//              same domain gives the same bytes
// The result has no net flow into any fluid cell, up to rounding, whatever the model. At rest where
// nothing blows.
//
// The defaults, measured in the bundled hall: with this viscosity the flow becomes steady, and the
// mean of the second half of 30 s differs from that of 120 s by 3 % (15 s: 14 %; 60 s: 0.2 %). With
// a third of it the means of 60 s and 120 s still differ by 13 %, with a tenth by 21 %.
// Smagorinsky's model at this resolution comes to a sixtieth of it, in the mean: there would be no
// mean wind to speak of, so it is not offered.
//
// Errors: kInvalidArgument from Validate and CheckContinuity; those of SparseCholesky. Cost:
// O(steps * cells log cells); 160 x 200 cells take some 2000 steps, 7 s.
absl::StatusOr<MacField> SolveWind(const FlowDomain& domain, const WindOptions& options,
                                   const FractionFn& progress = nullptr);

}  // namespace plumescout::lab
