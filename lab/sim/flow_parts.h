// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/status.h"
#include "lab/sim/flow_faces.h"

namespace plumescout::lab {

// Fluid cells that are connected by free faces: one pressure equation of its own. A fan that fills
// a doorway parts what lies on its two sides.
struct FlowPart {
  Cell first;                   // its cell of least index
  bool has_outlet = false;      // else pressure is known up to a constant only
  double net_inflow_mps = 0.0;  // of inlets and fans, summed over faces
};

struct FlowParts {
  static constexpr int kNone = -1;

  Grid<int> label;  // kNone on solid cells
  std::vector<FlowPart> parts;
};

FlowParts FindFlowParts(const FlowDomain& domain, const FreeFaces& free);

// Whether air can go where inlets and fans drive it. kInvalidArgument, naming a cell, if a part has
// no outlet and yet a net inflow.
absl::Status CheckContinuity(const FlowParts& parts);

}  // namespace plumescout::lab
