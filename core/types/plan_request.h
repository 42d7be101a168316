// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/types/ids.h"
#include "core/types/pose2.h"

namespace plumescout {

struct PlanRequest {
  RobotId robot;
  std::optional<Pose2> start = std::nullopt;  // default: the robot's latest pose in the belief
  bool go_home = false;                       // home is the only goal
  std::uint64_t seed = 0;  // 0: derived from the mission seed and the plan's number
  // Bound on evaluated edges, for repeatable plans; 0: none. (A deadline is the StopFn.)
  std::int64_t max_edge_evaluations = 0;
};

}  // namespace plumescout
