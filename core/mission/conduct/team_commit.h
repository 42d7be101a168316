// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/mission/conduct/mission_conduct.h"
#include "core/plan/team/team_plan.h"

namespace plumescout {

// A robot of a team that got no plan.
struct LeftOut {
  RobotId robot;
  std::string why;  // what its plan to stay says, or what its commit was refused for
};

struct CommittedTeam {
  std::vector<Plan> plans;  // with their numbers, in the order in which they were committed
  std::vector<LeftOut> left_out;
  int order_count = 0;
};

// Commits one plan after the other, under the lease that its robot has now, and assigns them.
CommittedTeam CommitTeam(TeamPlan team, MissionConduct& conduct);

}  // namespace plumescout
