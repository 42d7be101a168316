// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <string>

#include "core/mission/fleet.h"

namespace plumescout::support {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;
inline constexpr int kMaxRobots = 3;

inline Fleet FleetOf(std::initializer_list<std::string> robots) {
  Fleet fleet;
  for (const std::string& robot : robots) {
    EXPECT_TRUE(fleet.Register({robot, 0.2, 1}, kMaxRobots).ok());
  }
  return fleet;
}

inline Plan PlanTo(const RobotId& robot, Point2 position,
                   GoalKind kind = GoalKind::kOccupancyFrontier) {
  Plan plan;
  plan.robot = robot;
  Candidate candidate;
  candidate.goal = {kind, {}, position, position, 10};
  plan.candidates = {candidate};
  plan.chosen = 0;
  plan.phase =
      kind == GoalKind::kRandomFreeSpace ? MissionPhase::kFallback : MissionPhase::kExploring;
  plan.trajectory.duration_s = 10.0;
  return plan;
}

}  // namespace plumescout::support
