// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/objective_survey.h"

#include <algorithm>
#include <cstddef>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;

std::vector<std::size_t> FreeCells(const Grid<CellState>& map) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i] == CellState::kFree) cells.push_back(i);
  }
  return cells;
}

// Cells off the free ones do not count.
absl::StatusOr<Grid<ObjectiveVerdict>> AskVerdicts(const Grid<CellState>& map, const AskGas& ask) {
  const GridGeometry& geometry = map.geometry();
  Grid<ObjectiveVerdict> verdicts(geometry, ObjectiveVerdict::kDoesNotCount);
  const std::vector<std::size_t> cells = FreeCells(map);
  for (std::size_t begin = 0; begin < cells.size(); begin += kMaxPlaces) {
    const std::size_t end = std::min(begin + kMaxPlaces, cells.size());
    std::vector<Point2> places;
    for (std::size_t i = begin; i < end; ++i) {
      places.push_back(geometry.Center(geometry.CellAtIndex(cells[i])));
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<GasAtPlace> gas, ask(places));
    if (gas.size() != places.size()) {
      return absl::InternalError(
          absl::StrCat(gas.size(), " answers came for ", places.size(), " places"));
    }
    for (std::size_t i = begin; i < end; ++i) {
      verdicts[cells[i]] = gas[i - begin].verdict.value_or(ObjectiveVerdict::kDoesNotCount);
    }
  }
  return verdicts;
}

}  // namespace

absl::StatusOr<std::optional<ObjectiveOutcome>> SurveyObjective(const ObjectiveOptions& asked,
                                                                const MapSnapshot& map,
                                                                std::int64_t began_ns,
                                                                const AskGas& ask) {
  if (!map.objective || asked.kind == ObjectiveKind::kCompleteMap) return std::nullopt;
  ObjectiveOutcome outcome{
      .asked = asked,
      .status = *map.objective,
      .since_s = static_cast<double>(map.objective->since_ns - began_ns) / kNanosecondsPerSecond,
      .explanation = map.objective_explanation,
      .verdicts = {}};
  PLUMESCOUT_ASSIGN_OR_RETURN(outcome.verdicts, AskVerdicts(map.occupancy, ask));
  return outcome;
}

}  // namespace plumescout::lab
