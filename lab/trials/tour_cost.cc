// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/tour_cost.h"

#include "core/tour/closed_tour.h"
#include "core/tour/subset_tour.h"
#include "core/types/status_macros.h"
#include "lab/about/cpu_time.h"
#include "lab/worlds/tour_cases.h"

namespace plumescout::lab {

absl::StatusOr<TourCost> MeasureTourCost(std::uint64_t seed) {
  constexpr int kRepeats = 5;
  constexpr int kCells = 15;
  constexpr int kMeshSide = 6;
  Rng rng(seed);
  const SubsetTourCase random = RandomSubsetTourCase(kCells, rng);
  const TourGraph mesh = MeshGraph(LatticePoints(kMeshSide, kMeshSide), kSurveySpacing_m);
  TourCost cost;
  absl::Status status;
  cost.subsets_ms =
      MedianCpu_ms(kRepeats, [&] { status.Update(BestSubsetTour(random.Problem()).status()); });
  cost.survey_ms =
      MedianCpu_ms(kRepeats, [&] { status.Update(ShortestClosedTour(mesh).status()); });
  PLUMESCOUT_RETURN_IF_ERROR(status);
  return cost;
}

}  // namespace plumescout::lab
