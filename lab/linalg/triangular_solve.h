// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lab/linalg/supernodal_factor.h"
#include "lab/linalg/supernodal_pattern.h"

namespace plumescout::lab {

// x = A^-1 b from its factor: P^T L^-T L^-1 P b. b and x hold n values and may be the same memory.
void SolveSupernodes(const SupernodalPattern& pattern, const FactorValues& factor,
                     std::span<const double> b, std::span<double> x);

}  // namespace plumescout::lab
