// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/travel_budget.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"

namespace plumescout {
namespace {

std::string Account(const GoalQuery& query, const Candidate& candidate, double back_m,
                    double left_m) {
  return absl::StrFormat("%.1f m there and %.2f x %.1f m home exceed the %.1f m left of %.1f m",
                         candidate.length_m, 1.0 + query.options.return_margin_share, back_m,
                         left_m, query.options.travel_budget_m);
}

// By how long the robot would be late, seconds; 0 or less: it would not.
double Late_s(const GoalQuery& query, const Candidate& candidate, double back_m) {
  if (!query.belief.deadline_ns) return 0.0;
  constexpr double kSecondsPerNanosecond = 1e-9;
  const double left_s =
      static_cast<double>(*query.belief.deadline_ns - query.belief.sample_time_ns) *
      kSecondsPerNanosecond;
  const PlanningOptions& options = query.options;
  const double mean_mps =
      candidate.length_m > 0.0 ? candidate.length_m / candidate.duration_s : options.speed_mps;
  const double back_s = back_m / std::min(mean_mps, options.speed_mps);
  return options.planning_latency_s +
         (1.0 + options.return_margin_share) * (candidate.duration_s + back_s) - left_s;
}

// Why the candidate is not to be driven; none: it may be.
std::optional<RejectedGoal> Objection(const GoalQuery& query, const Candidate& candidate,
                                      double back_m) {
  if (candidate.goal.kind == GoalKind::kHome) return std::nullopt;
  const double budget_m = query.options.travel_budget_m;
  const double left_m = budget_m - query.robot.travelled_m;
  const double needed_m = candidate.length_m + (1.0 + query.options.return_margin_share) * back_m;
  if (budget_m > 0.0 && !(needed_m <= left_m)) {
    return RejectedGoal{candidate.goal, RejectionReason::kOverBudget,
                        Account(query, candidate, back_m, left_m)};
  }
  const double late_s = Late_s(query, candidate, back_m);
  if (late_s <= 0.0) return std::nullopt;
  return RejectedGoal{candidate.goal, RejectionReason::kOverDeadline,
                      absl::StrFormat("home %.1f s after the deadline", late_s)};
}

}  // namespace

bool IsLimited(const GoalQuery& query) {
  return query.options.travel_budget_m > 0.0 || query.belief.deadline_ns;
}

void RejectOverBudget(const GoalQuery& query, Plan& plan) {
  if (!IsLimited(query) || plan.candidates.empty()) return;
  const TravelFromStarts& from_home = query.FromHome();
  const GridGeometry& geometry = query.reachable.geometry();
  std::vector<Candidate> affordable;
  for (Candidate& candidate : plan.candidates) {
    const double back_m = from_home.Travel(geometry.CellAt(candidate.path.back()));
    if (std::optional<RejectedGoal> objection = Objection(query, candidate, back_m)) {
      plan.rejected.push_back(*std::move(objection));
    } else {
      affordable.push_back(std::move(candidate));
    }
  }
  plan.candidates = std::move(affordable);
}

}  // namespace plumescout
