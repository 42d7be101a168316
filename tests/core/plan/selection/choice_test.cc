// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/choice.h"

#include <gtest/gtest.h>

#include <memory>

#include "core/gas/gas_map.h"

namespace plumescout {
namespace choice_test {

// An empty room whose west has been read all over.
Belief HalfReadRoom() {
  const Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, 60, 20}, CellState::kFree);
  GasMap gas{GasOptions()};
  for (int x = 1; x < 30; x += 2) {
    for (int y = 1; y < 20; y += 2) gas.Add(0, states.geometry().Center({x, y}), {1.0, {}});
  }
  EXPECT_TRUE(gas.Refresh(states, 0).ok());
  Belief belief;
  belief.options = std::make_shared<const MissionOptions>();
  belief.occupancy = std::make_shared<const Grid<CellState>>(states);
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm());
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2());
  belief.gas_what_if = gas.what_if();
  return belief;
}

Candidate Way(Point2 to, double cost) {
  Candidate candidate;
  candidate.path = {{3.0, 1.0}, to};
  candidate.goal.position = to;
  candidate.cost = cost;
  candidate.duration_s = 2.0;
  return candidate;
}

Plan WestOrEast() {
  Plan plan;
  plan.robot = "r";
  plan.candidates = {Way({0.5, 1.0}, 1.0), Way({5.5, 1.0}, 1.5)};
  return plan;
}

PlanningOptions By(SelectionRule rule, double margin = 0.0) {
  PlanningOptions options;
  options.selection_rule = rule;
  options.commitment_margin_share = margin;
  return options;
}

TEST(Choose, TakesTheWayThatTellsMostIfAsked) {
  const Belief belief = HalfReadRoom();
  Plan plan = WestOrEast();
  Choose(belief, By(SelectionRule::kLeastCost), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 0);
  EXPECT_FALSE(plan.candidates[0].expected_information_nats.has_value()) << "nobody asked";
  Choose(belief, By(SelectionRule::kInformationRate), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 1) << "the east is unread";
  EXPECT_GT(*plan.candidates[1].expected_information_nats,
            2.0 * *plan.candidates[0].expected_information_nats);
}

TEST(Choose, FallsBackToTheCostIfThereIsNoTimeToPrice) {
  Plan plan = WestOrEast();
  Choose(
      HalfReadRoom(), By(SelectionRule::kInformationRate), [] { return true; }, plan);
  EXPECT_EQ(plan.chosen, 0);
}

TEST(Choose, KeepsTheGoalUnderWayUnlessAnotherIsBetterByTheMargin) {
  Belief belief = HalfReadRoom();
  belief.claims = {{"r", 1, WestOrEast().candidates[1].goal, belief.sample_time_ns + 1}};
  Plan plan = WestOrEast();
  Choose(belief, By(SelectionRule::kLeastCost, 0.5), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 1);
  EXPECT_TRUE(plan.goal_kept);
  plan = WestOrEast();
  Choose(belief, By(SelectionRule::kLeastCost, 0.2), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 0);
  EXPECT_FALSE(plan.goal_kept);
}

TEST(Choose, KeepsTheVeryGoalUnderWayAndNotItsNeighbour) {
  Belief belief = HalfReadRoom();
  Plan plan = WestOrEast();
  plan.candidates.push_back(Way({5.5, 1.3}, 1.4));  // within the claim's radius of the east
  belief.claims = {{"r", 1, plan.candidates[2].goal, belief.sample_time_ns + 1}};
  Choose(belief, By(SelectionRule::kLeastCost, 1.0), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 2);
}

TEST(Choose, DoesNotKeepWhatAnotherRobotDrivesToOrWhatHasExpired) {
  Belief belief = HalfReadRoom();
  const Goal east = WestOrEast().candidates[1].goal;
  belief.claims = {{"other", 1, east, belief.sample_time_ns + 1},
                   {"r", 2, east, belief.sample_time_ns}};
  Plan plan = WestOrEast();
  Choose(belief, By(SelectionRule::kLeastCost, 1.0), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 0);
}

TEST(Choose, OfNothingIsNothing) {
  Plan plan;
  Choose(HalfReadRoom(), By(SelectionRule::kInformationRate, 0.5), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, -1);
}

}  // namespace choice_test
}  // namespace plumescout
