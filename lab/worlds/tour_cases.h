// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/tour/subset_tour.h"
#include "core/types/pose2.h"
#include "core/types/rng.h"

namespace plumescout::lab {

// Tours as in [LHR] section IV.

inline constexpr double kSurveySpacing_m = 10.0;  // alpha d_res

// Places drawn evenly in the region of 50 m x 50 m.
std::vector<Point2> RandomTourPlaces(int count, Rng& rng);

// Random cells and rewards; the robot in a corner of the region.
struct SubsetTourCase {
  std::vector<double> from_start_m;
  std::vector<double> between_m;
  std::vector<double> rewards;

  // T = 10 in 50 s, 2 s each, 5 m/s. Refers to the case.
  SubsetTourProblem Problem() const;
};
SubsetTourCase RandomSubsetTourCase(int cells, Rng& rng);

}  // namespace plumescout::lab
