// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/objective_truth.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/belief/objective_cells.h"
#include "core/grid/flood.h"

namespace plumescout::lab {
namespace {

Grid<std::uint8_t> Reachable(const Belief& belief) {
  std::vector<Cell> starts;
  for (const auto& [id, record] : belief.robots) {
    starts.push_back(belief.geometry().CellAt(record.state.pose.position()));
    if (record.first_place) starts.push_back(belief.geometry().CellAt(*record.first_place));
  }
  return ReachableCells(*belief.traversable, starts);
}

// What is said of a decided cell, by its mean.
bool IsSaidRight(const Belief& belief, std::size_t cell, double true_ppm, double strongest_ppm) {
  const double threshold_ppm = belief.options->objective.threshold_ppm;
  switch (belief.options->objective.kind) {
    case ObjectiveKind::kMapAboveThreshold: {
      const bool said = static_cast<double>((*belief.gas_mean_ppm)[cell]) > threshold_ppm;
      return said == (true_ppm > threshold_ppm);
    }
    case ObjectiveKind::kFindSources:
      return true_ppm <= std::max(strongest_ppm, threshold_ppm);
    case ObjectiveKind::kConfirmClean:
    case ObjectiveKind::kCompleteMap:
      break;
  }
  return true_ppm <= threshold_ppm;
}

bool IsRight(const Belief& belief, const ObjectiveTruth& truth, double told_ppm,
             Point2 greatest_at) {
  const ObjectiveOptions& objective = belief.options->objective;
  const ObjectiveStatus& status = *belief.objective;
  const bool met = status.state == ObjectiveState::kMet;
  if (!IsConcluded(status)) return false;
  switch (objective.kind) {
    case ObjectiveKind::kConfirmClean:
      return met ? truth.greatest_ppm <= objective.threshold_ppm
                 : told_ppm > objective.threshold_ppm;
    case ObjectiveKind::kMapAboveThreshold:
      return truth.right_share >= objective.confidence;
    case ObjectiveKind::kFindSources:
      return met ? Distance_m(*status.strongest, greatest_at) <= objective.radius_m
                 : truth.greatest_ppm <= objective.threshold_ppm;
    case ObjectiveKind::kCompleteMap:
      break;
  }
  return false;
}

}  // namespace

ObjectiveTruth CompareWithTruth(const Belief& belief, const Scene& truth) {
  const Grid<std::uint8_t> reachable = Reachable(belief);
  const ObjectiveCells cells = JudgeCells(belief, reachable);
  const auto true_ppm = [&](Point2 place) {
    return static_cast<double>(truth.conc_mean_ppm.At(truth.geometry().CellAt(place), 0.0F));
  };
  const ObjectiveStatus& status = *belief.objective;
  const double strongest_ppm = status.strongest ? true_ppm(*status.strongest) : 0.0;
  ObjectiveTruth result;
  Point2 greatest_at;
  double right = 0.0;
  for (std::size_t i = 0; i < reachable.size(); ++i) {
    if (reachable[i] == 0) continue;
    const Point2 place = belief.geometry().Center(belief.geometry().CellAtIndex(i));
    const double here_ppm = true_ppm(place);
    if (here_ppm > result.greatest_ppm) {
      result.greatest_ppm = here_ppm;
      greatest_at = place;
    }
    if (!(cells.margin[i] >= cells.needed)) continue;
    result.decided_cells += 1.0;
    right += IsSaidRight(belief, i, here_ppm, strongest_ppm) ? 1.0 : 0.0;
  }
  result.right_share = result.decided_cells > 0.0 ? right / result.decided_cells : 0.0;
  const double told_ppm = status.place ? true_ppm(*status.place) : 0.0;
  result.is_right = IsRight(belief, result, told_ppm, greatest_at);
  return result;
}

}  // namespace plumescout::lab
