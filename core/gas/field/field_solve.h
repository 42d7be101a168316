// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "core/gas/field/field_factor.h"

namespace plumescout {

// H^-1 g for a right-hand side g by slot; 0 off the active cells, whatever g is there. Cost: reads
// the fronts twice, once those below which g is 0.
std::vector<double> SolveField(const FieldFactor& factor, std::span<const double> right_side);

}  // namespace plumescout
