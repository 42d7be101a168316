// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "lab/linalg/supernodal_pattern.h"

namespace plumescout::lab {

// Values of L, panel by panel as `pattern` lays them out; the upper triangle of a panel's diagonal
// block means nothing. Padded at the end so that a row tile may be read at any panel's end.
using FactorValues = std::vector<double>;

// L of P A P^T = L L^T for A with the pattern that was analysed, multifrontal: each supernode
// gathers its entries of A and the Schur complements of its children in a dense front, factorises
// its columns and hands the rest on to its parent.
// Errors: kFailedPrecondition naming an unknown of A if A is not positive definite.
absl::StatusOr<FactorValues> FactorizeSupernodes(const SupernodalPattern& pattern,
                                                 std::span<const double> matrix_values);

}  // namespace plumescout::lab
