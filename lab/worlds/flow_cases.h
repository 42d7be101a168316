// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "lab/sim/flow_domain.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

// Textbook flows for our solver of wind. Lengths are in units of the cavity's edge, the channel's
// or the step's height, speeds in units of the lid's or the mean speed at the inlet.

// Square of cells x cells whose northern edge slides eastward.
FlowDomain CavityDomain(int cells);

// Channel of height 1 and `length`, uniform inflow in the west.
FlowDomain ChannelDomain(int cells_across, double length);

// Channel of height 1 that becomes 2 high, downwards, at x = kStepUpstream; fully developed inflow.
inline constexpr double kStepUpstream = 2.0;
FlowDomain StepDomain(int cells_per_step, double length_behind);

// When a flow counts as steady.
struct SteadyLimits {
  double change_per_time = 1e-5;  // of any face's speed
  double max_time = 400.0;        // give up looking for it
};

struct SteadyFlow {
  MacField velocity;
  double change_per_time = 0.0;  // at the end
};

// Errors: those of FlowSolver.
absl::StatusOr<SteadyFlow> RunToSteady(const FlowDomain& domain, double viscosity,
                                       const SteadyLimits& limits = {});

// A speed along a line.
struct LineSample {
  double at = 0.0;
  double speed = 0.0;
};

// u on the vertical and v on the horizontal centre line of the cavity, at faces, with the walls'
// own speeds at both ends. REQUIRES: an even number of cells.
std::vector<LineSample> CavityU(const MacField& velocity);
std::vector<LineSample> CavityV(const MacField& velocity);

// Cubic through the two samples on either side. REQUIRES: samples ascend, at least four, and `at`
// lies between the first and the last.
double Interpolate(const std::vector<LineSample>& samples, double at);

// Least speed, of the parabola through the least sample and its neighbours.
double Least(const std::vector<LineSample>& samples);

// Where air above the lower wall behind the step turns from flowing back to flowing on, in heights
// from the step; NaN if it does not.
double ReattachmentLength(const MacField& velocity);

// Distance from the inlet from which on the centre line of the channel has 99 % of its last speed.
double EntranceLength(const MacField& velocity);

}  // namespace plumescout::lab
