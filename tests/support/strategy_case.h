// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/plan/strategy.h"
#include "tests/support/plan_map.h"

namespace plumescout::testing {

// A room that is open in the east and, through a door, in the west. 'i': too near a wall.
inline const GridArt kRoom = {"################",  //
                              "?iiiiiiiiiiiiii#",  //
                              "?.....iiii.....?",  //
                              "?.....i##i.....?",  //
                              "?...S.i##i.....?",  //
                              "?.....iiii.....?",  //
                              "?..............?",  //
                              "?iiiiiiiiiiiiii#",  //
                              "################"};
inline PlanRequest For(const RobotId& robot, std::uint64_t seed = 0) {
  PlanRequest request;
  request.robot = robot;
  request.seed = seed;
  return request;
}

// Of the paper's strategy: gas frontiers first, the path of least cost.
inline PlanningOptions XitGff() {
  PlanningOptions options;
  options.strategy = "xit_gff";
  const bool applied = ApplyStrategyRow(options).ok();
  return applied ? options : PlanningOptions{};
}

inline absl::StatusOr<Plan> TryPlan(const Belief& belief, const PlanRequest& request,
                                    const PlanningOptions& options = XitGff(),
                                    const StopFn& stop = NeverStop()) {
  const auto strategy = MakeStrategy(options);
  if (!strategy.ok()) return strategy.status();
  return (*strategy)->Plan(belief, request, stop);
}

// The frontiers of drawn maps are small.
inline Belief SmallBelief(const GridArt& art) {
  Belief belief = BeliefFromArt(art);
  MissionOptions mission;
  mission.frontier.min_occupancy_cell_count = 3;
  belief.options = std::make_shared<const MissionOptions>(mission);
  return belief;
}

inline const Candidate& Chosen(const Plan& plan) {
  return plan.candidates.at(static_cast<std::size_t>(plan.chosen));
}

}  // namespace plumescout::testing
