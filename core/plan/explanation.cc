// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/explanation.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/plan/right_of_way.h"
#include "core/plan/selection/selection.h"

namespace plumescout {
namespace {

std::string Destination(const Goal& goal) {
  switch (goal.kind) {
    case GoalKind::kGasFrontier:
      return absl::StrCat("a gas frontier of ", goal.frontier_cells, " cells");
    case GoalKind::kOccupancyFrontier:
      return absl::StrCat("an occupancy frontier of ", goal.frontier_cells, " cells");
    case GoalKind::kRandomFreeSpace:
      return "a random free place, for no frontier is left";
    case GoalKind::kInformation:
      return "a place where readings tell much";
    case GoalKind::kHome:
      return "home";
    case GoalKind::kSite:
      return "a sampling site";
    case GoalKind::kMakeWay:
      return "where it is in nobody's way";
  }
  return "";
}

std::string Unseen(const Candidate& candidate, const PlanningOptions& options) {
  if (!EndsAtTheUnseen(candidate)) return "";
  return absl::StrFormat(" and %.3g for what is unseen%s",
                         candidate.unseen_share * options.unseen_information_nats,
                         candidate.unseen_share < 1.0 ? " and others will not see" : "");
}

std::string Merit(const Candidate& candidate, const PlanningOptions& options) {
  switch (options.selection_rule) {
    case SelectionRule::kLeastCost:
      break;
    case SelectionRule::kMeanUcb:
      return absl::StrFormat("greatest mean information, %.2f", candidate.mean_ucb);
    case SelectionRule::kInformationRate:
      if (!candidate.expected_information_nats) break;
      return absl::StrFormat("most information expected, %.1f nats%s in %.0f s",
                             *candidate.expected_information_nats, Unseen(candidate, options),
                             candidate.duration_s);
  }
  return absl::StrFormat("least cost, %.2f", candidate.cost);
}

bool Rejects(const Plan& plan, RejectionReason reason) {
  return std::any_of(plan.rejected.begin(), plan.rejected.end(),
                     [reason](const RejectedGoal& goal) { return goal.reason == reason; });
}

bool IsWithoutWayHome(const Plan& plan) {
  return std::any_of(plan.rejected.begin(), plan.rejected.end(), [](const RejectedGoal& rejected) {
    return rejected.goal.kind == GoalKind::kHome;
  });
}

std::string UntilPassed(const Plan& plan) {
  return plan.waits_for.empty() ? "until other robots have passed"
                                : absl::StrCat("until robot \"", plan.waits_for, "\" has passed");
}

// Of a plan whose trajectory is to stop for nothing else.
std::string WaitOnTheWay(const Plan& plan) {
  const std::vector<Waypoint>& waypoints = plan.trajectory.waypoints;
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
    const Waypoint& stop = waypoints[i];
    if (stop.dwell_s == 0.0) continue;
    return absl::StrFormat("; waits %.1f s at (%.1f, %.1f) %s", stop.dwell_s, stop.pose.x_m,
                           stop.pose.y_m, UntilPassed(plan));
  }
  return "";
}

std::string Choice(const Plan& plan, const PlanningOptions& options) {
  const Candidate& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)];
  std::string text = absl::StrFormat(
      "Drive %.1f m to %s at (%.1f, %.1f): %s, of %d candidates", chosen.length_m,
      Destination(chosen.goal), chosen.goal.position.x_m, chosen.goal.position.y_m,
      plan.goal_kept ? "kept, for none is better by the margin" : Merit(chosen, options),
      plan.candidates.size());
  if (Rejects(plan, RejectionReason::kOverBudget) && chosen.goal.kind == GoalKind::kHome) {
    absl::StrAppend(&text, "; every other goal is beyond the travel budget");
  } else if (Rejects(plan, RejectionReason::kOverDeadline) && chosen.goal.kind == GoalKind::kHome) {
    absl::StrAppend(&text, "; from every other goal it would be home after the deadline");
  }
  if (const double wait_s = WaitOf_s(plan.trajectory); wait_s > 0.0) {
    absl::StrAppend(&text, absl::StrFormat("; waits %.1f s %s", wait_s, UntilPassed(plan)));
  }
  if (options.dwell_s == 0.0 && chosen.stops.empty()) text += WaitOnTheWay(plan);
  if (plan.start_escaped) absl::StrAppend(&text, "; first out of the margin around obstacles");
  if (plan.field_flat) absl::StrAppend(&text, "; the information map is flat");
  if (plan.end == PlanEnd::kStopped) absl::StrAppend(&text, "; the search was stopped early");
  return absl::StrCat(text, ".");
}

}  // namespace

std::string Explain(const Plan& plan, const PlanningOptions& options) {
  if (plan.chosen >= 0) return Choice(plan, options);
  if (plan.end == PlanEnd::kMissionComplete && Rejects(plan, RejectionReason::kOverBudget)) {
    return absl::StrCat("Stay: what is left of the travel budget is not enough for any goal, and ",
                        IsWithoutWayHome(plan) ? "there is no way home." : "the robot is home.");
  }
  if (plan.end == PlanEnd::kMissionComplete && Rejects(plan, RejectionReason::kOverDeadline)) {
    return absl::StrCat("Stay: there is no time left for any goal, and ",
                        IsWithoutWayHome(plan) ? "there is no way home." : "the robot is home.");
  }
  const bool search_failed = plan.end == PlanEnd::kQueueExhausted || plan.end == PlanEnd::kStopped;
  if (plan.phase == MissionPhase::kReturning && !search_failed) {
    return IsWithoutWayHome(plan) ? "Stay: there is no way home." : "Stay: the robot is home.";
  }
  switch (plan.end) {
    case PlanEnd::kMissionComplete:
      return "Stay: no frontier is left and random visits reveal nothing new; the mission is "
             "complete.";
    case PlanEnd::kStopped:
      return "Stay: the search was stopped before any goal had a path.";
    case PlanEnd::kNoGoals:
      return "Stay: there is no place to go to from here.";
    case PlanEnd::kStartOccupied:
      return "Stay: there is no way out from where the robot stands.";
    case PlanEnd::kAllGoalsRejected:
      return absl::StrCat("Stay: all of ", plan.rejected.size(), " goals were rejected",
                          Rejects(plan, RejectionReason::kTraffic)
                              ? absl::StrCat("; waits ", UntilPassed(plan), ".")
                              : ".");
    case PlanEnd::kAllGoalsReached:
    case PlanEnd::kQueueExhausted:
      break;
  }
  return absl::StrCat("Stay: none of ", plan.rejected.size(), " goals has a path.");
}

}  // namespace plumescout
