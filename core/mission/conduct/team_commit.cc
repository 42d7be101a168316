// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/team_commit.h"

#include <cstdint>
#include <string>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout {

namespace {

absl::StatusOr<PlanId> Assign(const Plan& plan, MissionConduct& conduct) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t token, conduct.mission().LeaseToken(plan.robot));
  return conduct.Commit(plan, token, /*assigned=*/true);
}

Plan ToStay(const Plan& plan) {
  if (plan.chosen < 0) return plan;
  Plan stay = plan;
  stay.chosen = -1;
  stay.candidates.clear();
  stay.trajectory = {};
  stay.explanation = "Stay until there is a plan for the team.";
  return stay;
}

}  // namespace

CommittedTeam CommitTeam(TeamPlan team, MissionConduct& conduct) {
  CommittedTeam committed;
  committed.left_out = std::move(team.left_out);
  committed.order_count = team.order_count;
  for (const Plan& plan : team.plans) {
    if (!conduct.mission().HasWay(plan.robot)) continue;
    Assign(ToStay(plan), conduct).IgnoreError();  // then its plan stands in the others' way still
  }
  for (Plan& plan : team.plans) {
    if (plan.chosen < 0) {  // it will ask itself, and is told the same
      committed.left_out.push_back({plan.robot, plan.explanation});
      continue;
    }
    const auto id = Assign(plan, conduct);
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
