// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/types/grid.h"
#include "core/types/ids.h"
#include "lab/bench/load/load_robot.h"

namespace plumescout::lab {

struct TeamOptions {
  MissionId mission;
  int robots = 1;
  double scan_hz = 10.0;
  absl::Duration plan_period = absl::Seconds(1);  // 0: nobody plans
};

using Team = std::map<RobotId, std::unique_ptr<LoadRobot>>;

struct TeamFigures {
  std::vector<double> plan_wall_ms;
  double plan_failures = 0.0;
  double acknowledged = 0.0;
  double lost = 0.0;  // sent and not applied

  double PlanP50_ms() const;
  double PlanP99_ms() const;
};

// Robots robot-1, robot-2 ... that join the mission, each at a place of its own and with plans that
// are not in step. `walls` must outlive the team.
absl::StatusOr<Team> StartTeam(const std::string& target, const Grid<std::uint8_t>& walls,
                               const TeamOptions& options, std::uint64_t seed);

// Of the plans since the last such call; lost is what is not applied yet.
TeamFigures Take(const Team& team);
// All robots at once: stops them and waits until what they sent is applied, or until `drain` has
// gone by for each.
TeamFigures Stop(const Team& team, absl::Duration drain);

}  // namespace plumescout::lab
