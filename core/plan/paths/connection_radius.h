// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/options.h"

namespace plumescout {

// The least r_N (ours): below three cells grid neighbours would not see each other on a small map.
inline constexpr double kMinRadius_cells = 3.0;

// r_N of [XIT] Alg. 1 line 7 for `samples` samples on `area_m2` of free space connected to the
// robot: gamma (ln N / N)^(1/2) with gamma = radius_factor * gamma_RGG, Eq. (7) for n = 2, and
// times eps^(-1/2) with options.mixture_radius (section IV-D). At most
// options.max_connection_radius_m, and at least kMinRadius_cells in any case.
double ConnectionRadius_m(double area_m2, int samples, double resolution_m,
                          const PlanningOptions& options);

}  // namespace plumescout
