// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/plan/cost/edge_cost.h"
#include "core/plan/cost/information_map.h"
#include "core/plan/paths/path_planner.h"
#include "lab/worlds/random_world.h"

namespace plumescout::lab {

// A world with what path planners see of it: its information map under the default options, the
// cost of [XIT] at alpha = 0, and its robot and goals.
class PlanCase {
 public:
  explicit PlanCase(RandomWorld world);
  PlanCase(const PlanCase&) = delete;  // `cost` refers to `information`
  PlanCase& operator=(const PlanCase&) = delete;

  // Holds references to this case and to `stop`.
  PathProblem Problem(std::uint64_t seed, const StopFn& stop,
                      CostKind kind = CostKind::kUcb) const {
    const EdgeCost& searched = kind == CostKind::kEuclidean ? length : cost;
    return {searched, reachable, start, world.goals, seed, 0, stop, nullptr};
  }

  RandomWorld world;
  InformationMap information;
  EdgeCost cost;
  EdgeCost length;  // for searches by distance
  Point2 start;
  Cell start_cell;
  Grid<std::uint8_t> reachable;
};

}  // namespace plumescout::lab
