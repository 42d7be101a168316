// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/wait_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/plan/explanation.h"
#include "core/plan/right_of_way.h"
#include "core/plan/trajectory_timing.h"
#include "tests/support/corridor_team.h"

namespace plumescout {
namespace wait_place_test {

using testing::CorridorTeam;
using ::testing::HasSubstr;

// "a" is to drive from the corridor into the east of the bay, which "d" leaves in 3 s.
CorridorTeam Leaving() {
  CorridorTeam team;
  team.Stands("a", 4.0);
  team.Stands("d", 6.6, 1.8);
  Trajectory away = TimeTrajectory(
      {{6.6, 1.8}, {6.6, CorridorTeam::kMiddle_m}, {9.5, CorridorTeam::kMiddle_m}}, 0.0, {});
  WaitAtStart(3.0, away);
  RobotRecord& record = team.belief.robots.at("d");
  record.live_arrival_ns = CorridorTeam::kNow_ns + std::llround(away.duration_s * 1e9);
  record.live_trajectory = std::make_shared<const Trajectory>(away);
  return team;
}

// By the west of the bay.
Plan PlanOf(const CorridorTeam& team, const PlanningOptions& options = {}) {
  Plan plan;
  plan.robot = "a";
  Candidate candidate;
  candidate.path = {CorridorTeam::At(4.0), CorridorTeam::At(5.5), {5.5, 1.8}, {6.6, 1.8}};
  candidate.goal.position = {6.6, 1.8};
  candidate.duration_s = TimeTrajectory(candidate.path, 0.0, options).duration_s;
  plan.candidates = {candidate};
  YieldToRobots(team.belief, 0.0, options, plan);
  if (plan.candidates.empty()) return plan;
  plan.chosen = 0;
  plan.trajectory = TrajectoryOf(plan.candidates[0], 0.0, options);
  return plan;
}

TEST(WaitOutOfTheWay, WhoIsInNobodysWayWaitsAtItsStart) {
  const CorridorTeam team = Leaving();
  Plan plan = PlanOf(team);
  ASSERT_GT(WaitOf_s(plan.trajectory), 0.0);
  const Plan before = plan;
  EXPECT_FALSE(WaitOutOfTheWay(team.belief, PlanningOptions(), plan));
  EXPECT_EQ(plan, before);
}

TEST(WaitOutOfTheWay, WhoIsInTheOnlyWayOfAnotherGoesOnFirst) {
  CorridorTeam team = Leaving();
  team.Stands("x", 1.0);
  team.Wants("x", 9.0, 5.0);
  Plan plan = PlanOf(team);
  const double wait_s = WaitOf_s(plan.trajectory);
  ASSERT_GT(wait_s, 0.0);
  const double duration_s = plan.trajectory.duration_s;
  ASSERT_TRUE(WaitOutOfTheWay(team.belief, PlanningOptions(), plan));
  const std::vector<Waypoint>& stops = plan.trajectory.waypoints;
  ASSERT_EQ(stops.size(), 4u);
  EXPECT_EQ(stops[0].dwell_s, 0.0);
  EXPECT_EQ(stops[1].dwell_s, 0.0) << "the corridor is the way of \"x\"";
  EXPECT_EQ(stops[2].dwell_s, wait_s);
  EXPECT_NEAR(stops[2].arrival_time_s, (1.5 + 1.35) / PlanningOptions().speed_mps, 1e-9);
  EXPECT_EQ(plan.trajectory.duration_s, duration_s);
  EXPECT_NEAR(stops[3].arrival_time_s, duration_s, 1e-9);
  EXPECT_THAT(Explain(plan, PlanningOptions()), HasSubstr("s at (5.5, 1.8) until other robots"));
}

TEST(WaitOutOfTheWay, NobodyElseWhoWaitsIsBlockedInstead) {
  CorridorTeam team = Leaving();
  team.Stands("x", 1.0);
  team.Wants("x", 8.0, 5.0);
  team.Stands("y", 9.2);
  const Point2 behind_the_stop = {5.5, 2.0};
  Plan plan = PlanOf(team);
  ASSERT_GT(WaitOf_s(plan.trajectory), 0.0);
  Plan moved = plan;
  EXPECT_TRUE(WaitOutOfTheWay(team.belief, PlanningOptions(), moved)) << "\"y\" wants nothing";
  team.Wants("y", 5.5, 5.0);
  team.belief.robots["y"].wanted_goal->position = behind_the_stop;
  const Plan before = plan;
  EXPECT_FALSE(WaitOutOfTheWay(team.belief, PlanningOptions(), plan));
  EXPECT_EQ(plan, before);
}

TEST(WaitOutOfTheWay, StopsThatAreForSamplesAreLeftAlone) {
  CorridorTeam team = Leaving();
  team.Stands("x", 1.0);
  team.Wants("x", 9.0, 5.0);
  Plan plan = PlanOf(team);
  const Plan before = plan;
  PlanningOptions options;
  options.dwell_s = 1.0;
  EXPECT_FALSE(WaitOutOfTheWay(team.belief, options, plan));
  options = {};
  options.yield_to_robots = false;
  EXPECT_FALSE(WaitOutOfTheWay(team.belief, options, plan));
  EXPECT_EQ(plan, before);
}

}  // namespace wait_place_test
}  // namespace plumescout
