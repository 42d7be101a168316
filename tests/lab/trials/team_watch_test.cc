// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/gas/gas_map.h"
#include "core/plan/selection/selection.h"
#include "tests/support/corridor_team.h"

namespace plumescout::lab {
namespace team_watch_test {

using testing::CorridorTeam;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kLidarRange_m = 3.0;

// Two that want past each other in a corridor.
CorridorTeam HeadOn() {
  CorridorTeam team;
  team.Stands("a", 2.0);
  team.Wants("a", 9.0, 0.0);
  team.Stands("b", 4.0);
  team.Wants("b", 1.0, 0.0);
  return team;
}

TEST(TeamWatch, CountsARingOnceItHasLasted) {
  CorridorTeam team = HeadOn();
  TeamWatch watch(kLidarRange_m);
  for (int second = 0; second < 10; ++second) {
    watch.OnTime(team.belief);
    EXPECT_EQ(watch.findings(), TeamFindings{}) << second;
    team.belief.sample_time_ns += kSecond_ns;
  }
  for (int second = 0; second < 5; ++second) {
    watch.OnTime(team.belief);
    EXPECT_EQ(watch.findings().deadlocks, 1) << "of two robots";
    EXPECT_EQ(watch.findings().held_up, 2);
    team.belief.sample_time_ns += kSecond_ns;
  }
}

TEST(TeamWatch, WhatWasResolvedInTimeIsNone) {
  CorridorTeam team = HeadOn();
  TeamWatch watch(kLidarRange_m);
  for (int second = 0; second < 60; ++second) {
    // Every five seconds one of them is out of the way for a moment.
    team.belief.robots["b"].state.silent = second % 5 == 4;
    watch.OnTime(team.belief);
    team.belief.sample_time_ns += kSecond_ns;
  }
  EXPECT_EQ(watch.findings(), TeamFindings{});
}

TEST(TeamWatch, WhoHasNoWayPastOneThatStandsIsHeldUpAndNotInARing) {
  CorridorTeam team;
  team.Stands("a", 2.0);
  team.Wants("a", 9.0, 0.0);
  team.Stands("b", 4.0);
  TeamWatch watch(kLidarRange_m);
  watch.OnTime(team.belief);
  team.belief.sample_time_ns += 11 * kSecond_ns;
  watch.OnTime(team.belief);
  EXPECT_EQ(watch.findings().held_up, 1);
  EXPECT_EQ(watch.findings().deadlocks, 0);
}

Plan PlanOfA(Point2 goal) {
  Plan plan;
  plan.robot = "a";
  plan.chosen = 0;
  Candidate& candidate = plan.candidates.emplace_back();
  candidate.goal = {GoalKind::kInformation, {}, goal, goal, 0};
  candidate.path = {CorridorTeam::At(2.0), goal};
  return plan;
}

EndedLeg Blocked(double nearest_m) { return {10.0, "a", 1, ProgressOutcome::kBlocked, nearest_m}; }

TEST(TeamWatch, TellsBlockedLegsByRobotsFromOthers) {
  TeamWatch watch(kLidarRange_m);
  watch.OnLeg(Blocked(1.91), 0.2);
  EXPECT_EQ(watch.findings().blocked_by_robot, 0);
  watch.OnLeg(Blocked(1.89), 0.2);
  EXPECT_EQ(watch.findings().blocked_by_robot, 1);
  EndedLeg aborted = Blocked(0.5);
  aborted.outcome = ProgressOutcome::kAborted;
  watch.OnLeg(aborted, 0.2);
  EXPECT_EQ(watch.findings().blocked_by_robot, 1);
}

TEST(TeamWatch, FindsGoalsThatWereSetAsideForARobot) {
  CorridorTeam team;
  team.Stands("a", 2.0);
  const Plan plan = PlanOfA(CorridorTeam::At(6.0));
  TeamWatch watch(kLidarRange_m);
  watch.OnPlan(team.belief, plan);
  watch.OnLeg(Blocked(0.5), 0.2);
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().set_aside_for_robot, 0) << "it was not";
  team.belief.set_aside = {{plan.candidates[0].goal, "visited without change", 0}};
  watch.OnLeg(Blocked(0.5), 0.2);
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().set_aside_for_robot, 0) << "it was for another reason";
  team.belief.set_aside = {{plan.candidates[0].goal, "reported blocked", 0}};
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().set_aside_for_robot, 0) << "no leg was blocked since";
  watch.OnLeg(Blocked(0.5), 0.2);
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().set_aside_for_robot, 1);
}

TEST(TeamWatch, FindsEdgesOfTheUnseenThatOthersAreToSee) {
  CorridorTeam team;
  team.Stands("a", 2.0);
  team.Stands("b", 1.0);
  Plan plan = PlanOfA(CorridorTeam::At(6.0));
  TeamWatch watch(kLidarRange_m);
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().unseen_goals, 0) << "it goes elsewhere";
  plan.candidates[0].goal.kind = GoalKind::kOccupancyFrontier;
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().unseen_goals, 1);
  team.Drives("b", 2.5);
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().unseen_in_others_sight, 0) << "none from so far away";
  team.Drives("b", 4.0);
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().unseen_in_others_sight, 1);
  auto walled = std::make_shared<Grid<CellState>>(*team.belief.occupancy);
  const int wall_x = walled->geometry().CellAt(CorridorTeam::At(5.0)).x;
  for (int y = 0; y < walled->geometry().height; ++y) {
    (*walled)[Cell{wall_x, y}] = CellState::kOccupied;
  }
  team.belief.occupancy = walled;
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().unseen_in_others_sight, 1) << "not through a wall";
  EXPECT_EQ(watch.findings().unseen_goals, 4);
}

TEST(TeamWatch, CountsWhatIsPaidForEdgesInSight) {
  CorridorTeam team;
  team.Stands("a", 2.0);
  team.Stands("b", 1.0);
  Plan plan = PlanOfA(CorridorTeam::At(6.0));
  Candidate& candidate = plan.candidates[0];
  candidate.goal.kind = GoalKind::kOccupancyFrontier;
  TeamWatch watch(kLidarRange_m);
  watch.OnPlan(team.belief, plan);
  EXPECT_EQ(watch.findings().unseen_paid_nats, 0.0) << "it was not chosen by its information";
  candidate.expected_information_nats = 3.0;
  const MissionOptions& mission = *team.belief.options;
  const double whole_nats = InField(mission.planning, mission.gas).unseen_information_nats;
  watch.OnPlan(team.belief, plan);
  EXPECT_DOUBLE_EQ(watch.findings().unseen_paid_nats, whole_nats);
  EXPECT_EQ(watch.findings().unseen_paid_twice_nats, 0.0);
  team.Drives("b", 4.0);
  candidate.unseen_share = 0.25;
  watch.OnPlan(team.belief, plan);
  EXPECT_DOUBLE_EQ(watch.findings().unseen_paid_nats, 1.25 * whole_nats);
  EXPECT_DOUBLE_EQ(watch.findings().unseen_paid_twice_nats, 0.25 * whole_nats);
}

void AddGasField(Belief& belief) {
  GasMap gas{GasOptions()};
  gas.Add(0, CorridorTeam::At(9.5), {1.0, {}});
  ASSERT_TRUE(gas.Refresh(*belief.occupancy, 0).ok());
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm());
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2());
  belief.gas_what_if = gas.what_if();
}

// Both stand where the way of a begins, and b is to drive it.
void LetBPromiseTheWay(CorridorTeam& team) {
  ASSERT_NO_FATAL_FAILURE(AddGasField(team.belief));
  team.Stands("a", 2.0);
  team.Stands("b", 2.0);
  team.Drives("b", 6.0);
}

TEST(TeamWatch, PricesWhatOthersHavePromised) {
  CorridorTeam team;
  ASSERT_NO_FATAL_FAILURE(AddGasField(team.belief));
  team.Stands("a", 2.0);
  team.Stands("b", 2.0, 1.0);
  const Plan plan = PlanOfA(CorridorTeam::At(6.0));
  TeamWatch watch(kLidarRange_m);
  watch.OnPlan(team.belief, plan);
  EXPECT_GT(watch.findings().alone_nats, 0.0);
  EXPECT_EQ(watch.findings().besides_nats, watch.findings().alone_nats) << "nobody promises";
  const double alone_nats = watch.findings().alone_nats;
  team.Stands("b", 2.0);
  team.Drives("b", 6.0);
  watch.OnPlan(team.belief, plan);
  EXPECT_DOUBLE_EQ(watch.findings().alone_nats, 2.0 * alone_nats);
  EXPECT_LT(watch.findings().besides_nats, 1.95 * alone_nats) << "the same way";
  EXPECT_GT(watch.findings().besides_nats, alone_nats);
}

TEST(TeamWatch, TellsWhatWasPaidTwiceFromWhatIsPromised) {
  CorridorTeam team;
  ASSERT_NO_FATAL_FAILURE(LetBPromiseTheWay(team));
  Plan plan = PlanOfA(CorridorTeam::At(6.0));
  TeamWatch unpriced(kLidarRange_m);
  unpriced.OnPlan(team.belief, plan);
  const double alone_nats = unpriced.findings().alone_nats;
  const double besides_nats = unpriced.findings().besides_nats;
  ASSERT_LT(besides_nats, alone_nats);
  EXPECT_EQ(unpriced.findings().paid_nats, 0.0) << "it was not chosen by its information";
  plan.candidates[0].expected_information_nats = besides_nats;
  TeamWatch once(kLidarRange_m);
  once.OnPlan(team.belief, plan);
  EXPECT_EQ(once.findings().paid_nats, besides_nats);
  EXPECT_EQ(once.findings().paid_twice_nats, 0.0);
  plan.candidates[0].expected_information_nats = alone_nats;
  TeamWatch twice(kLidarRange_m);
  twice.OnPlan(team.belief, plan);
  EXPECT_EQ(twice.findings().paid_nats, alone_nats);
  EXPECT_DOUBLE_EQ(twice.findings().paid_twice_nats, alone_nats - besides_nats);
}

TEST(TeamWatch, WhatIsPromisedAfterAPlanWasNotBefore) {
  CorridorTeam team;
  ASSERT_NO_FATAL_FAILURE(LetBPromiseTheWay(team));
  Plan plan = PlanOfA(CorridorTeam::At(6.0));
  plan.id = 4;
  team.belief.robots["b"].last_plan = 5;
  TeamWatch later(kLidarRange_m);
  later.OnPlan(team.belief, plan);
  EXPECT_GT(later.findings().alone_nats, 0.0);
  EXPECT_EQ(later.findings().besides_nats, later.findings().alone_nats);
  team.belief.robots["b"].last_plan = 3;
  TeamWatch before(kLidarRange_m);
  before.OnPlan(team.belief, plan);
  EXPECT_EQ(before.findings().alone_nats, later.findings().alone_nats);
  EXPECT_LT(before.findings().besides_nats, before.findings().alone_nats);
}

}  // namespace team_watch_test
}  // namespace plumescout::lab
