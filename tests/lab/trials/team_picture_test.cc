// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_picture.h"

#include <gtest/gtest.h>

#include "core/plan/strategy.h"
#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace team_picture_test {

IssuedPlan Issued(PlanId id, double time_s) {
  IssuedPlan issued{time_s, absl::ZeroDuration(), {}};
  issued.plan.id = id;
  issued.plan.trajectory.waypoints = {{{0.5, 0.5, 0.0}, 0.0}, {{1.5, 0.5, 0.0}, 1.0}};
  issued.plan.trajectory.duration_s = 1.0;
  return issued;
}

TEST(TeamPicture, PlansAreLiveUntilTheirLegsEndOrTheNextComes) {
  TeamResult team;
  EpisodeResult& robot = team.robots.emplace_back();
  robot.robot = "scout";
  robot.simulated_s = 60.0;
  robot.plans = {Issued(1, 10.0), Issued(2, 20.0), Issued(3, 30.0), Issued(4, 40.0)};
  robot.plans[2].plan.trajectory = {};  // it is to stay
  robot.legs_ended = {{15.0, "scout", 1, ProgressOutcome::kReached, 1.0}};
  robot.path = {{0.0, {0.5, 0.5, 0.0}}, {1.0, {0.6, 0.5, 0.0}}};
  const TeamPicture picture =
      MakeTeamPicture(team, SmallWorld(), {.radius_m = 0.3, .clearance_m = 0.1});
  EXPECT_DOUBLE_EQ(picture.reach_m, 0.35) << "the tubes of two that keep the clearance touch";
  ASSERT_EQ(picture.members.size(), 1u);
  const TeamMember& member = picture.members[0];
  EXPECT_EQ(member.name, "scout");
  ASSERT_EQ(member.ways.size(), 3u);
  EXPECT_EQ(member.ways[0].begin_s, 10.0);
  EXPECT_EQ(member.ways[0].end_s, 15.0) << "its leg ended";
  EXPECT_EQ(member.ways[1].end_s, 30.0) << "it was told to stay";
  EXPECT_EQ(member.ways[2].end_s, 60.0) << "the end of all";
  EXPECT_EQ(member.driven.size(), 2u);
  EXPECT_EQ(member.area_share, 1.0);
}

TEST(TeamPicture, IsAddedToAPage) {
  MissionOptions mission;
  ASSERT_TRUE(ApplyStrategyRow(mission.planning).ok());
  Trial trial;
  trial.mission = &mission;
  trial.world = &SmallWorld();
  trial.robots = 2;
  trial.duration_s = 8.0;
  ReportFigures figures;
  ASSERT_TRUE(AddTeamPicture(trial, figures).ok());
  ASSERT_EQ(figures.panels.size(), 2u);
  EXPECT_EQ(figures.panels[0].legend.size(), 2u);
  ASSERT_EQ(figures.bar_charts.size(), 1u);
  double area_percent = 0.0;
  for (const Bar& bar : figures.bar_charts[0].series[0].bars) area_percent += bar.value;
  EXPECT_NEAR(area_percent, 100.0, 1e-9);
}

}  // namespace team_picture_test
}  // namespace plumescout::lab
