// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/gas_query.h"

#include <cmath>

#include "core/frontier/gas_frontier.h"
#include "core/types/species.h"

namespace plumescout {
namespace {

std::optional<double> IfKnown(float value) {
  if (!std::isfinite(value)) return std::nullopt;
  return static_cast<double>(value);
}

// A variance in the options is on the scale of the first gas.
FrontierOptions JudgingBy(const MissionOptions& options, std::size_t species) {
  FrontierOptions frontier = options.frontier;
  if (species > 0) frontier.observed_variance_ppm2.reset();
  return frontier;
}

}  // namespace

std::vector<GasAtPlace> QueryGas(const Belief& belief, const std::vector<Point2>& places,
                                 std::size_t species) {
  const GasField field = belief.Gas(species);
  const double observed_ppm2 = ObservedVariance_ppm2(JudgingBy(*belief.options, species),
                                                     GasOptionsOf(*belief.options, species));
  std::vector<GasAtPlace> answers;
  answers.reserve(places.size());
  for (const Point2 place : places) {
    GasAtPlace& gas = answers.emplace_back();
    if (field.sampled_cells != nullptr) gas.nearest_reading = field.sampled_cells->Nearest(place);
    const Cell cell = belief.geometry().CellAt(place);
    if (!belief.occupancy->Contains(cell)) continue;
    gas.state = (*belief.occupancy)[cell];
    gas.mean_ppm = IfKnown((*field.mean_ppm)[cell]);
    gas.variance_ppm2 = IfKnown((*field.published_variance_ppm2())[cell]);
    const std::optional<double> of_model_ppm2 = IfKnown((*field.variance_ppm2)[cell]);
    gas.observed = of_model_ppm2 && *of_model_ppm2 <= observed_ppm2;
  }
  return answers;
}

}  // namespace plumescout
