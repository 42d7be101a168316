// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/team_commit.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout {

namespace {

absl::StatusOr<PlanId> Assign(const Plan& plan, MissionConduct& conduct) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t token, conduct.mission().LeaseToken(plan.robot));
  return conduct.Commit(plan, token, /*assigned=*/true);
}

// What it would rather do was rejected by a search whose plan it may yet have.
Plan ToStay(const Plan& plan) {
  if (plan.chosen < 0) return plan;
  Plan stay = plan;
  stay.chosen = -1;
  stay.candidates.clear();
  stay.rejected.clear();
  stay.trajectory = {};
  stay.explanation = "Stay until there is a plan for the team.";
  return stay;
}

// `later` are the plans to be committed after it. Their robots are stopped only where they are in
// its way, and only if it stands then.
absl::StatusOr<PlanId> AssignBefore(std::span<const Plan> later, const Plan& plan,
                                    MissionConduct& conduct) {
  absl::StatusOr<PlanId> id = Assign(plan, conduct);
  std::set<RobotId> others;
  for (const Plan& other : later) others.insert(other.robot);
  others.erase(plan.robot);
  if (!absl::IsAborted(id.status()) || conduct.InTheWayOf(plan, others)) return id;
  if (conduct.mission().FindKeptOut(plan)) return id;  // nor would it be taken then
  while (const std::optional<RobotId> robot = conduct.InTheWayOf(plan)) {
    const auto other = std::find_if(later.begin(), later.end(),
                                    [&](const Plan& one) { return one.robot == *robot; });
    if (other == later.end() || !conduct.mission().HasWay(*robot)) return id;
    if (!Assign(ToStay(*other), conduct).ok()) return id;
  }
  return Assign(plan, conduct);
}

}  // namespace

CommittedTeam CommitTeam(TeamPlan team, MissionConduct& conduct) {
  CommittedTeam committed;
  committed.left_out = std::move(team.left_out);
  committed.order_count = team.order_count;
  for (std::size_t i = 0; i < team.plans.size(); ++i) {
    Plan& plan = team.plans[i];
    if (plan.chosen < 0) {  // it will ask itself, and is told the same
      if (conduct.mission().HasWay(plan.robot)) Assign(plan, conduct).IgnoreError();
      committed.left_out.push_back({plan.robot, plan.explanation});
      continue;
    }
    const auto id = AssignBefore(std::span(team.plans).subspan(i + 1), plan, conduct);
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
