// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/status.h"
#include "lab/sim/flow_domain.h"
#include "lab/sim/layout.h"

namespace plumescout::lab {

// Adds the faces that `fans` hold. A fan is a straight line at right angles to its direction; it
// holds each face whose two cell centres lie on different sides of the line, at the part of its
// velocity that is at right angles to the face. So it moves width * speed of air at any angle, to
// within a face.
// Errors, kInvalidArgument, one that reaches into a wall or into another fan, is
// too narrow for the raster, or drives air into a space that has no other way for it.
// REQUIRES: `flow` has its openings already.
absl::Status AddFans(const std::vector<Fan>& fans, FlowDomain& flow);

}  // namespace plumescout::lab
