// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "core/gas/gmrf_graph.h"
#include "core/linalg/symmetric_matrix.h"
#include "core/types/options.h"

namespace plumescout {

// What the readings of one cell say, merged: all that Eq. (3) needs to know of them.
struct Evidence {
  double precision = 0.0;           // sum of lambda_k, ppm^-2
  double weighted_deviation = 0.0;  // sum of lambda_k (z_k - m_0), ppm^-1
  double weighted_square = 0.0;     // sum of lambda_k (z_k - m_0)^2
  double count = 0.0;               // of k

  Evidence& operator+=(const Evidence& other) {
    precision += other.precision;
    weighted_deviation += other.weighted_deviation;
    weighted_square += other.weighted_square;
    count += other.count;
    return *this;
  }
};

// The system H dm = -g of [IPP] Eq. (3), linearised at m = m_0 in every cell, where prior and
// background factors have no gradient: g_i = sum_k lambda_k (m_0 - z_k), Eq. (5).
struct Information {
  SymmetricMatrix hessian;                // H = J^T Lambda J
  std::vector<double> negative_gradient;  // -g
};

// `evidence` is by variable. H_ii = lambda_d + sum_k lambda_k + lambda_p * neighbours,
// H_ij = -lambda_p for neighbours i, j. Cost: O(variables).
Information BuildInformation(const GmrfGraph& graph, std::span<const Evidence> evidence,
                             const GasOptions& options);

}  // namespace plumescout
