// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/objective_assessment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/belief/objective_cells.h"
#include "core/frontier/occupancy_frontier.h"
#include "core/grid/flood.h"
#include "core/types/normal.h"

namespace plumescout {
namespace {

std::vector<Cell> PlacesOfRobots(const Belief& belief) {
  std::vector<Cell> cells;
  const auto add = [&](Point2 place) {
    const Cell cell = belief.geometry().CellAt(place);
    if (belief.geometry().Contains(cell)) cells.push_back(cell);
  };
  for (const auto& [id, record] : belief.robots) {
    if (record.state.has_pose) add(record.state.pose.position());
    if (record.first_place) add(*record.first_place);
  }
  return cells;
}

bool IsGivenUp(const Frontier& frontier, const Belief& belief) {
  const Point2 place = belief.geometry().Center(frontier.goal_cell);
  return std::any_of(belief.set_aside.begin(), belief.set_aside.end(),
                     [&](const SetAsideGoal& aside) {
                       return aside.goal.kind == GoalKind::kOccupancyFrontier &&
                              Distance_m(aside.goal.position, place) < kClaimRadius_m;
                     });
}

int OpenFrontiers(const Belief& belief, const std::vector<Cell>& starts) {
  const std::vector<Frontier> frontiers =
      FindOccupancyFrontiers(*belief.occupancy, *belief.traversable, starts,
                             belief.options->frontier.min_occupancy_cell_count);
  return static_cast<int>(
      std::count_if(frontiers.begin(), frontiers.end(), [&](const Frontier& frontier) {
        return frontier.reachable && !frontier.too_small && !IsGivenUp(frontier, belief);
      }));
}

// Of the cells that count.
struct Tally {
  std::size_t undecided = 0;
  std::optional<std::size_t> worst;           // of least margin
  std::optional<std::size_t> worst_measured;  // of those that are measured
};

Tally Count(const ObjectiveCells& cells) {
  Tally tally;
  float least = std::numeric_limits<float>::infinity();
  float least_measured = least;
  for (std::size_t i = 0; i < cells.margin.size(); ++i) {
    const float margin = cells.margin[i];
    if (margin < cells.needed) ++tally.undecided;
    if (margin < least) {
      least = margin;
      tally.worst = i;
    }
    if (margin < least_measured && std::isfinite(margin)) {
      least_measured = margin;
      tally.worst_measured = i;
    }
  }
  return tally;
}

void Locate(const Belief& belief, std::size_t cell, ObjectiveStatus& status) {
  status.place = belief.geometry().Center(belief.geometry().CellAtIndex(cell));
  const float mean_ppm = (*belief.gas_mean_ppm)[cell];
  const float variance_ppm2 = (*belief.Gas(0).published_variance_ppm2())[cell];
  if (std::isnan(mean_ppm) || std::isnan(variance_ppm2)) return;
  status.mean_ppm = static_cast<double>(mean_ppm);
  status.stddev_ppm = std::sqrt(static_cast<double>(variance_ppm2));
}

ObjectiveState StateOf(ObjectiveKind kind, const ObjectiveCells& cells, const Tally& tally,
                       const ObjectiveStatus& status) {
  const bool is_known = tally.undecided == 0 && status.open_frontiers == 0;
  if (kind == ObjectiveKind::kConfirmClean && tally.worst_measured &&
      cells.margin[*tally.worst_measured] <= -cells.needed) {
    return ObjectiveState::kRefuted;
  }
  if (!is_known) return ObjectiveState::kPursued;
  const bool is_without = kind == ObjectiveKind::kFindSources && !cells.source_found;
  return is_without ? ObjectiveState::kRefuted : ObjectiveState::kMet;
}

}  // namespace

ObjectiveStatus AssessObjective(const Belief& belief) {
  const std::vector<Cell> starts = PlacesOfRobots(belief);
  const ObjectiveCells cells = JudgeCells(belief, ReachableCells(*belief.traversable, starts));
  const Tally tally = Count(cells);
  const GridGeometry& geometry = belief.geometry();
  ObjectiveStatus status;
  status.open_frontiers = OpenFrontiers(belief, starts);
  status.undecided_area_m2 =
      static_cast<double>(tally.undecided) * geometry.resolution_m * geometry.resolution_m;
  if (cells.strongest) status.strongest = geometry.Center(geometry.CellAtIndex(*cells.strongest));
  const std::optional<std::size_t> told = tally.worst ? tally.worst : cells.strongest;
  if (!told || belief.gas_counters.readings == 0) return status;

  const ObjectiveKind kind = belief.options->objective.kind;
  status.state = StateOf(kind, cells, tally, status);
  const bool is_unclean =
      kind == ObjectiveKind::kConfirmClean && status.state == ObjectiveState::kRefuted;
  const std::size_t shown = is_unclean ? *tally.worst_measured : *told;
  Locate(belief, shown, status);
  const float margin = tally.worst ? cells.margin[shown] : cells.needed;
  status.confidence = NormalProbability(static_cast<double>(is_unclean ? -margin : margin));
  return status;
}

}  // namespace plumescout
