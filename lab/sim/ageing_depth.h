// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lab/sim/layout.h"

namespace plumescout::lab {

// Square of a filament's width: sigma_0^2 + gamma age ([XIT] Table I, GADEN).
double FilamentVariance_m2(const GasParameters& gas, double age_s);

// Height that gas of an age fills. The model is flat, air is not: in the vertical a filament also
// grows and walks, so its gas fills sqrt(2 pi (sigma^2 + 2 K age)), which gives it the peak of a
// three-dimensional Gaussian, until that reaches the mixing depth. Near sources a constant depth
// would lose most of the peak.
double DepthAtAge_m(const GasParameters& gas, double age_s);

// weight * exp(-rate * age).
struct DecayTerm {
  double rate_per_s = 0.0;
  double weight_per_m = 0.0;
};

// 1 / DepthAtAge_m as a sum of decays, whose first never ends; to 5 % at any age by
// default, 12 % for depths up to 6 m. Gas thinned out that way obeys linear equations, one for each
// term.
std::vector<DecayTerm> InverseDepthTerms(const GasParameters& gas);

}  // namespace plumescout::lab
