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
// staggered grid by Chorin's projection (1968), started from rest.
//   momentum   explicit Euler, first-order upwind advection, constant turbulent viscosity
//   pressure   Poisson equation, factorised once, solved directly in every step
//   walls      no slip, half a cell inside the solid cell (solid faces simply carry 0)
//   openings   inlets at a given speed; outlets at ambient pressure, reached without a gradient
//   step       as long as explicit Euler allows: changes with the fastest air, depends on nothing
//              else, so the same domain gives the same bytes
// Why not less: potential flow knows no wakes and blows gas into the wrong rooms. The result has no
// net flow into any fluid cell, up to rounding. At rest without openings.
//
// Errors: kInvalidArgument from Validate; those of SparseCholesky. Cost: O(steps * cells log
// cells); 160 x 200 cells take some 1400 steps, 2 s.
absl::StatusOr<MacField> SolveWind(const FlowDomain& domain, const WindOptions& options,
                                   const FractionFn& progress = nullptr);

}  // namespace plumescout::lab
