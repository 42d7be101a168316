// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>

#include "core/grid/flood.h"
#include "core/plan/goals/goal_offer.h"
#include "tests/support/plan_map.h"

namespace plumescout::testing {

// Robot "r" on a drawn map, for which goals are sought; frontiers of one cell count.
struct GoalCase {
  explicit GoalCase(const GridArt& art)
      : belief(BeliefFromArt(art)),
        start(CellInArt(art, 'S')),
        reachable(ReachableCells(*belief.traversable, {start})) {
    MissionOptions mission;
    mission.frontier.min_occupancy_cell_count = 1;
    mission.frontier.min_gas_cell_count = 1;
    SetMission(mission);
    options.goal_policy = GoalPolicy::kGasFirst;
    options.min_goal_distance_m = 0.05;
  }

  void SetMission(const MissionOptions& mission) {
    belief.options = std::make_shared<const MissionOptions>(mission);
  }

  // Gas of `mean_ppm`, measured, in the cells drawn 'g' or 'S'; nothing measured elsewhere.
  void AddGas(const GridArt& art, float mean_ppm) {
    Grid<float> mean(belief.geometry(), std::numeric_limits<float>::quiet_NaN());
    Grid<float> variance = mean;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      if ((*belief.occupancy)[i] != CellState::kFree) continue;
      const char mark = ArtAt(art, mean.geometry().CellAtIndex(i));
      const bool measured = mark == 'g' || mark == 'S';
      mean[i] = measured ? mean_ppm : 0.0F;
      variance[i] = measured ? 0.01F : 1.0F;
    }
    belief.gas_mean_ppm = std::make_shared<const Grid<float>>(mean);
    belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(variance);
  }

  GoalQuery Query() const { return {belief, belief.robots.at("r"), start, reachable, options}; }

  Belief belief;
  Cell start;
  Grid<std::uint8_t> reachable;
  PlanningOptions options;
};

}  // namespace plumescout::testing
