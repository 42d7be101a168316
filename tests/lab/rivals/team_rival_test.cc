// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/team_rival.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "core/plan/trajectory_timing.h"
#include "tests/support/plan_map.h"
#include "tests/support/scripted_strategy.h"

namespace plumescout::lab {
namespace team_rival_test {

using support::ScriptedStrategy;
using ::testing::HasSubstr;

constexpr std::int64_t kNow_ns = 1'000'000'000;

// 12 m by 1 m, known but for what is east of x = 11 m. "r" asks, from (4.05, 0.55).
Belief HallBelief() {
  const std::string row = std::string(110, '.') + std::string(10, '?');
  testing::GridArt art(10, row);
  art[4][40] = 'S';
  Belief belief = testing::BeliefFromArt(art);
  belief.sample_time_ns = kNow_ns;
  return belief;
}

void Stands(const RobotId& robot, double x_m, Belief& belief) {
  RobotRecord& record = belief.robots[robot];
  record.state.id = robot;
  record.state.has_pose = true;
  record.state.pose = {x_m, 0.55, 0.0};
}

Goal FrontierAt(double x_m, const Belief& belief) {
  Goal goal = testing::GoalAt(belief.geometry().CellAt({x_m, 0.55}), belief.geometry());
  goal.kind = GoalKind::kOccupancyFrontier;
  return goal;
}

Candidate WayTo(double x_m, const Belief& belief) {
  Candidate candidate;
  candidate.goal = FrontierAt(x_m, belief);
  candidate.path = {{4.05, 0.55}, candidate.goal.position};
  candidate.duration_s = TimeTrajectory(candidate.path, 0.5, {}).duration_s;
  return candidate;
}

// Has frontiers 1.5 m to the east and 3 m to the west, and takes the nearer.
Plan EastOrWest(const Belief& belief) {
  Plan plan;
  plan.robot = "r";
  plan.phase = MissionPhase::kExploring;
  plan.candidates = {WayTo(5.55, belief), WayTo(1.05, belief)};
  plan.chosen = 0;
  return plan;
}

Plan PlanBy(TeamRule rule, const Belief& belief, Plan plan) {
  const auto rival = MakeTeamRival(
      rule, {},
      std::make_unique<const ScriptedStrategy>(
          [plan = std::move(plan)](const Belief&, const PlanRequest&,
                                   const StopFn&) -> absl::StatusOr<Plan> { return plan; }));
  PlanRequest request;
  request.robot = "r";
  auto planned = rival->Plan(belief, request, NeverStop(), nullptr);
  EXPECT_TRUE(planned.ok()) << planned.status();
  return planned.ok() ? *std::move(planned) : Plan();
}

TEST(TeamRival, AloneARobotGoesToTheNearest) {
  const Belief belief = HallBelief();
  for (const TeamRule rule : {TeamRule::kBurgard, TeamRule::kMatching}) {
    EXPECT_EQ(PlanBy(rule, belief, EastOrWest(belief)).chosen, 0) << NameOf(rule);
  }
}

TEST(TeamRival, TheTrajectoryIsThatOfTheChoice) {
  Belief belief = HallBelief();
  Stands("other", 6.05, belief);
  const Plan plan = PlanBy(TeamRule::kMatching, belief, EastOrWest(belief));
  EXPECT_EQ(plan.chosen, 1);
  EXPECT_EQ(plan.trajectory, TimeTrajectory(plan.candidates[1].path, 0.5, {}));
  EXPECT_THAT(plan.explanation, HasSubstr("matching"));
}

TEST(TeamRival, MatchingLeavesToOthersWhatTheyAreNearerTo) {
  Belief belief = HallBelief();
  // "r" east and it west: 1.5 m + 5 m; the other way round 3 m + 0.5 m.
  Stands("other", 6.05, belief);
  EXPECT_EQ(PlanBy(TeamRule::kMatching, belief, EastOrWest(belief)).chosen, 1);
  // Who is silent is not reckoned with.
  belief.robots.at("other").state.silent = true;
  EXPECT_EQ(PlanBy(TeamRule::kMatching, belief, EastOrWest(belief)).chosen, 0);
}

TEST(TeamRival, MatchingHandsOutClaimedFrontiersToOthersAlone) {
  Belief belief = HallBelief();
  // The other has a frontier of its own 0.5 m farther east, so "r" need not leave it the near one.
  Stands("other", 6.05, belief);
  Plan plan = EastOrWest(belief);
  plan.rejected = {{FrontierAt(6.55, belief), RejectionReason::kClaimed, ""}};
  EXPECT_EQ(PlanBy(TeamRule::kMatching, belief, plan).chosen, 0);
  plan.rejected[0].reason = RejectionReason::kTooSmall;
  EXPECT_EQ(PlanBy(TeamRule::kMatching, belief, plan).chosen, 1);
}

TEST(TeamRival, BurgardKeepsAwayFromWhereOthersDriveTo) {
  Belief belief = HallBelief();
  // 1 m from (5.55): 1 - 7/8 - 1.5/8 is below 1 - 2.5/8 - 3/8 of the west.
  belief.claims = {{"other", 1, FrontierAt(6.55, belief), kNow_ns + 1}};
  EXPECT_EQ(PlanBy(TeamRule::kBurgard, belief, EastOrWest(belief)).chosen, 1);
  belief.claims[0].expires_ns = kNow_ns;
  EXPECT_EQ(PlanBy(TeamRule::kBurgard, belief, EastOrWest(belief)).chosen, 0);
  belief.claims = {{"r", 1, FrontierAt(6.55, belief), kNow_ns + 1}};
  EXPECT_EQ(PlanBy(TeamRule::kBurgard, belief, EastOrWest(belief)).chosen, 0) << "its own";
}

TEST(TeamRival, RrtExplorationGoesByUnknownArea) {
  const Belief belief = HallBelief();
  Plan plan = EastOrWest(belief);
  // About 1 m^2 of the unknown is within 1 m of (11.05): 3 m^2 less 7 m against less 1.5 m.
  plan.candidates[1] = WayTo(11.05, belief);
  EXPECT_EQ(PlanBy(TeamRule::kRrtExploration, belief, plan).chosen, 0);
  // From 2 m it is worth twice that.
  Belief nearer = belief;
  nearer.robots.at("r").state.pose.x_m = 9.05;
  EXPECT_EQ(PlanBy(TeamRule::kRrtExploration, nearer, plan).chosen, 1);
}

TEST(TeamRival, LeavesAloneWhatIsNoFrontier) {
  const Belief belief = HallBelief();
  Plan stays;
  stays.robot = "r";
  EXPECT_EQ(PlanBy(TeamRule::kBurgard, belief, stays), stays);
  Plan fallback = EastOrWest(belief);
  fallback.phase = MissionPhase::kFallback;
  EXPECT_EQ(PlanBy(TeamRule::kBurgard, belief, fallback), fallback);
}

}  // namespace team_rival_test
}  // namespace plumescout::lab
