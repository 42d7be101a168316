// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/plan_case.h"

#include <utility>

#include "core/grid/flood.h"

namespace plumescout::lab {

PlanCase::PlanCase(RandomWorld made)
    : world(std::move(made)),
      information(MakeInformationMap(
          {*world.belief.traversable, *world.belief.gas_mean_ppm, *world.belief.gas_variance_ppm2,
           world.belief.options->gas, world.belief.options->frontier},
          PlanningOptions{})),
      cost(information, CostKind::kUcb, 0.0),
      length(information, CostKind::kEuclidean, 0.0),
      start(world.belief.robots.at(world.robot).state.pose.position()),
      start_cell(world.belief.geometry().CellAt(start)),
      reachable(ReachableCells(*world.belief.traversable, {start_cell})) {}

}  // namespace plumescout::lab
