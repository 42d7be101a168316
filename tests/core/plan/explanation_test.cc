// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/explanation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumescout {
namespace explanation_test {

using ::testing::HasSubstr;

PlanningOptions By(SelectionRule rule) {
  PlanningOptions options;
  options.selection_rule = rule;
  return options;
}

Plan ChosenPlan(GoalKind kind) {
  Plan plan;
  plan.end = PlanEnd::kAllGoalsReached;
  Candidate candidate;
  candidate.goal.kind = kind;
  candidate.goal.position = {3.25, 4.0};
  candidate.goal.frontier_cells = 23;
  candidate.length_m = 5.43;
  candidate.cost = 12.345;
  candidate.mean_ucb = 0.75;
  plan.candidates = {candidate, candidate};
  plan.chosen = 1;
  return plan;
}

TEST(Explain, NamesGoalPlaceAndReason) {
  EXPECT_EQ(Explain(ChosenPlan(GoalKind::kGasFrontier), By(SelectionRule::kLeastCost)),
            "Drive 5.4 m to a gas frontier of 23 cells at (3.2, 4.0): least cost, 12.35, of 2 "
            "candidates.");
  EXPECT_THAT(Explain(ChosenPlan(GoalKind::kOccupancyFrontier), By(SelectionRule::kMeanUcb)),
              HasSubstr("an occupancy frontier of 23 cells at (3.2, 4.0): greatest mean "
                        "information, 0.75"));
}

TEST(Explain, NamesTheInformationExpected) {
  Plan plan = ChosenPlan(GoalKind::kGasFrontier);
  plan.candidates[1].duration_s = 12.0;
  EXPECT_THAT(Explain(plan, By(SelectionRule::kInformationRate)), HasSubstr("least cost"));
  plan.candidates[1].expected_information_nats = 34.56;
  EXPECT_THAT(Explain(plan, By(SelectionRule::kInformationRate)),
              HasSubstr("most information expected, 34.6 nats in 12 s"));
  plan.candidates[1].goal.kind = GoalKind::kOccupancyFrontier;
  PlanningOptions options = By(SelectionRule::kInformationRate);
  EXPECT_THAT(Explain(plan, options),
              HasSubstr("most information expected, 34.6 nats and 20 for what is unseen in 12 s"));
  options.unseen_information_nats = 7.5;
  EXPECT_THAT(Explain(plan, options), HasSubstr("34.6 nats and 7.5 for what is unseen in 12 s"));
  plan.candidates[1].unseen_share = 0.2;
  EXPECT_THAT(Explain(plan, options),
              HasSubstr("34.6 nats and 1.5 for what is unseen and others will not see in 12 s"));
}

TEST(Explain, SaysThatTheGoalWasKept) {
  Plan plan = ChosenPlan(GoalKind::kGasFrontier);
  plan.goal_kept = true;
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)), HasSubstr("kept"));
}

TEST(Explain, SaysWhyThereIsNoWayOn) {
  Plan plan;
  plan.end = PlanEnd::kStartOccupied;
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)), HasSubstr("no way out"));
  plan.end = PlanEnd::kAllGoalsRejected;
  plan.rejected.resize(3);
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)),
              HasSubstr("all of 3 goals were rejected."));
  plan.rejected[2].reason = RejectionReason::kTraffic;
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)),
              HasSubstr("rejected; waits until other robots have passed."));
  plan.waits_for = "b";
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)),
              HasSubstr("rejected; waits until robot \"b\" has passed."));
}

TEST(Explain, SaysWhenNoFrontierIsLeft) {
  EXPECT_THAT(Explain(ChosenPlan(GoalKind::kRandomFreeSpace), By(SelectionRule::kLeastCost)),
              HasSubstr("a random free place, for no frontier is left"));
}

TEST(Explain, SaysWhomTheRobotWaitsFor) {
  Plan plan = ChosenPlan(GoalKind::kGasFrontier);
  plan.trajectory.waypoints.resize(3);
  plan.trajectory.waypoints[0].dwell_s = 2.5;
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)),
              HasSubstr("; waits 2.5 s until other robots have passed"));
  plan.waits_for = "b";
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)),
              HasSubstr("; waits 2.5 s until robot \"b\" has passed"));
  plan.trajectory.waypoints[0].dwell_s = 0.0;
  plan.trajectory.waypoints[1] = {{1.0, 2.0, 0.0}, 1.0, 2.5};
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)),
              HasSubstr("; waits 2.5 s at (1.0, 2.0) until robot \"b\" has passed"));
}

TEST(Explain, SaysThatReadingsTellMuchThere) {
  EXPECT_THAT(Explain(ChosenPlan(GoalKind::kInformation), By(SelectionRule::kLeastCost)),
              HasSubstr("Drive 5.4 m to a place where readings tell much at (3.2, 4.0)"));
}

TEST(Explain, MentionsWhatLimitedThePlan) {
  Plan plan = ChosenPlan(GoalKind::kGasFrontier);
  plan.start_escaped = true;
  plan.field_flat = true;
  plan.end = PlanEnd::kStopped;
  const std::string text = Explain(plan, By(SelectionRule::kLeastCost));
  EXPECT_THAT(text, HasSubstr("first out of the margin around obstacles"));
  EXPECT_THAT(text, HasSubstr("the information map is flat"));
  EXPECT_THAT(text, HasSubstr("the search was stopped early"));
}

TEST(Explain, SaysWhyTheRobotStays) {
  Plan plan;
  const auto stays_because = [&plan](PlanEnd end) {
    plan.end = end;
    return Explain(plan, By(SelectionRule::kLeastCost));
  };
  EXPECT_THAT(stays_because(PlanEnd::kMissionComplete), HasSubstr("the mission is complete"));
  EXPECT_THAT(stays_because(PlanEnd::kNoGoals), HasSubstr("no place to go to"));
  EXPECT_THAT(stays_because(PlanEnd::kStopped), HasSubstr("stopped before any goal"));
  plan.rejected.resize(3);
  EXPECT_THAT(stays_because(PlanEnd::kQueueExhausted), HasSubstr("none of 3 goals has a path"));
}

TEST(Explain, SaysWhyTheRobotGoesHomeOrStaysThere) {
  Plan plan = ChosenPlan(GoalKind::kHome);
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)), HasSubstr("Drive 5.4 m to home at"));
  plan.rejected = {{{}, RejectionReason::kOverBudget, ""}};
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)),
              HasSubstr("every other goal is beyond the travel budget"));
  plan.chosen = -1;
  plan.end = PlanEnd::kMissionComplete;
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)), HasSubstr("and the robot is home"));
  Goal home;
  home.kind = GoalKind::kHome;
  plan.rejected.push_back({home, RejectionReason::kUnreachable, ""});
  EXPECT_THAT(Explain(plan, By(SelectionRule::kLeastCost)), HasSubstr("and there is no way home"));
}

TEST(Explain, NamesASamplingSite) {
  EXPECT_THAT(Explain(ChosenPlan(GoalKind::kSite), By(SelectionRule::kLeastCost)),
              HasSubstr("to a sampling site at (3.2, 4.0)"));
}

}  // namespace explanation_test
}  // namespace plumescout
