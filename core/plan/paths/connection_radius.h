// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/options.h"

namespace plumescout {

// Bounds of r_N (ours). Below three cells grid neighbours would not see each other on a small map;
// beyond five metres nearly every edge of a cluttered map is blocked.
inline constexpr double kMinRadius_cells = 3.0;
inline constexpr double kMaxRadius_m = 5.0;

// r_N of [XIT] Alg. 1 line 7 for `samples` samples on `area_m2` of free space connected to the
// robot: gamma (ln N / N)^(1/2) with gamma = radius_factor * gamma_RGG, Eq. (7) for n = 2, and
// times eps^(-1/2) with options.mixture_radius (section IV-D); clamped.
double ConnectionRadius_m(double area_m2, int samples, double resolution_m,
                          const PlanningOptions& options);

}  // namespace plumescout
