// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/tour_cases.h"

namespace plumescout::lab {

std::vector<Point2> RandomTourPlaces(int count, Rng& rng) {
  constexpr double kSide_m = 50.0;
  std::vector<Point2> places;
  for (int i = 0; i < count; ++i) {
    const double x_m = rng.Uniform(0.0, kSide_m);
    places.push_back({x_m, rng.Uniform(0.0, kSide_m)});
  }
  return places;
}

SubsetTourProblem SubsetTourCase::Problem() const {
  SubsetTourProblem problem = {from_start_m, between_m, rewards};
  problem.wanted = 10;
  problem.cycle_s = 50.0;
  problem.sampling_s = 2.0;
  problem.speed_mps = 5.0;
  return problem;
}

SubsetTourCase RandomSubsetTourCase(int cells, Rng& rng) {
  SubsetTourCase random;
  const std::vector<Point2> places = RandomTourPlaces(cells, rng);
  for (const Point2& place : places) {
    random.from_start_m.push_back(Distance_m({}, place));
    random.rewards.push_back(rng.Uniform01());
    for (const Point2& other : places) random.between_m.push_back(Distance_m(place, other));
  }
  return random;
}

}  // namespace plumescout::lab
