// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/gas_query.h"

#include <cmath>

#include "core/belief/completeness.h"
#include "core/belief/objective_cells.h"
#include "core/frontier/gas_frontier.h"
#include "core/grid/flood.h"
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

// None: the mission is for a complete map.
std::optional<ObjectiveCells> JudgedCells(const Belief& belief) {
  if (belief.options->objective.kind == ObjectiveKind::kCompleteMap) return std::nullopt;
  return JudgeCells(belief, ReachableCells(*belief.traversable, PlacesOfRobots(belief)));
}

}  // namespace

std::vector<GasAtPlace> QueryGas(const Belief& belief, const std::vector<Point2>& places,
                                 std::size_t species, bool with_verdicts) {
  const std::optional<ObjectiveCells> judged = with_verdicts ? JudgedCells(belief) : std::nullopt;
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
    if (judged) {
      gas.verdict =
          VerdictOf(*judged, belief.options->objective.kind, belief.geometry().Index(cell));
    }
  }
  return answers;
}

}  // namespace plumescout
