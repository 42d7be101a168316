// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lab/linalg/supernodal_factor.h"
#include "lab/linalg/supernodal_pattern.h"

namespace plumescout::lab {

// diagonal[i] = (A^-1)_ii for all i, from the factor of A.
//
// Takahashi's recursion by supernodes, roots first. With L = [L11; L21] of a supernode S and the
// rows R below it, X = L11^-1 and Y = L21 X, the inverse Z of A obeys
//   Z_RS = -Z_RR Y,   Z_SS = X^T X + Y^T Z_RR Y,
// and Z_RR lies wholly within the parent's block of Z: no entry outside L's pattern is formed.
void InverseDiagonalSupernodes(const SupernodalPattern& pattern, const FactorValues& factor,
                               std::span<double> diagonal);

}  // namespace plumescout::lab
