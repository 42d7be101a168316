// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/travel_budget.h"

#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/grid/grid_search.h"
#include "core/plan/goals/home_goal.h"

namespace plumescout {
namespace {

std::string Account(const GoalQuery& query, const Candidate& candidate, double back_m,
                    double left_m) {
  return absl::StrFormat("%.1f m there and %.2f x %.1f m home exceed the %.1f m left of %.1f m",
                         candidate.length_m, 1.0 + query.options.return_margin_share, back_m,
                         left_m, query.options.travel_budget_m);
}

}  // namespace

void RejectOverBudget(const GoalQuery& query, Plan& plan) {
  if (query.options.travel_budget_m == 0.0 || plan.candidates.empty()) return;
  const HomeGoal home = FindHome(query);
  std::vector<Cell> ends;
  if (home.reachable) ends.push_back(home.goal.cell);
  const Grid<double> way_home_m = TravelDistances_m(query.reachable, ends);
  const double left_m = query.options.travel_budget_m - query.robot.travelled_m;
  std::vector<Candidate> affordable;
  for (Candidate& candidate : plan.candidates) {
    const Cell end = way_home_m.geometry().CellAt(candidate.path.back());
    const double back_m = way_home_m[end];
    const double needed_m = candidate.length_m + (1.0 + query.options.return_margin_share) * back_m;
    if (needed_m <= left_m || candidate.goal.kind == GoalKind::kHome) {
      affordable.push_back(std::move(candidate));
    } else {
      plan.rejected.push_back({candidate.goal, RejectionReason::kOverBudget,
                               Account(query, candidate, back_m, left_m)});
    }
  }
  plan.candidates = std::move(affordable);
}

}  // namespace plumescout
