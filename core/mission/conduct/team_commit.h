// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/mission/conduct/mission_conduct.h"
#include "core/plan/team/team_plan.h"

namespace plumescout {

struct CommittedTeam {
  std::vector<Plan> plans;  // with their numbers, in the order in which they were committed
  std::vector<LeftOut> left_out;
  int order_count = 0;
};

// Commits one plan after the other, under the lease that its robot has now, and assigns them. None
// of them yields to what it replaces: robots of the team that follow a plan are first given one to
// stay. So who is left out with a plan to stay, or since its commit was refused, stays; who is left
// out since no plan was found follows the one that it has.
CommittedTeam CommitTeam(TeamPlan team, MissionConduct& conduct);

}  // namespace plumescout
