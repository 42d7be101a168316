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
// yields to what those after it replace: a robot of the team that is in the way with the plan that
// it follows is first given one to stay, if that is all it takes. So who is left out since its
// commit was refused follows the plan that it has unless that was in another's way, and who is left
// out since no plan was found always does; who is left out with a plan to stay stays.
CommittedTeam CommitTeam(TeamPlan team, MissionConduct& conduct);

}  // namespace plumescout
