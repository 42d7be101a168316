// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/team_commit.h"

#include <utility>

namespace plumescout {

CommittedTeam CommitTeam(TeamPlan team, MissionConduct& conduct) {
  CommittedTeam committed;
  committed.order_count = team.order_count;
  for (Plan& plan : team.plans) {
    if (plan.chosen < 0) {  // it will ask itself, and is told the same
      committed.left_out.push_back({plan.robot, plan.explanation});
      continue;
    }
    const auto token = conduct.mission().LeaseToken(plan.robot);
    const auto id = token.ok() ? conduct.Commit(plan, *token, /*assigned=*/true)
                               : absl::StatusOr<PlanId>(token.status());
    if (!id.ok()) {
      committed.left_out.push_back({plan.robot, std::string(id.status().message())});
      continue;
    }
    plan.id = *id;
    committed.plans.push_back(std::move(plan));
  }
  return committed;
}

}  // namespace plumescout
