// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "proto/convert/status.h"

namespace plumescout {
namespace plan_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Plan TestPlan() {
  const Goal goal{GoalKind::kGasFrontier, {3, 4}, {0.35, 0.45}, {0.3, 0.5}, 12};
  Plan plan;
  plan.id = 5;
  plan.robot = "r1";
  plan.strategy = "xit_gff";
  plan.belief_revision = 99;
  plan.seed = 0xffff'ffff'0000'0001ULL;
  plan.phase = MissionPhase::kGasProbing;
  plan.end = PlanEnd::kStopped;
  plan.chosen = 0;
  plan.candidates = {{goal,
                      {{0.0, 0.0}, {0.35, 0.45}},
                      PathSource::kGridGuard,
                      1.5,
                      0.5,
                      2.0,
                      0.25,
                      7.0,
                      3.0,
                      12.5}};
  plan.candidates[0].reward = -0.25;
  plan.candidates[0].unseen_share = 0.75;
  plan.candidates[0].stops = {{0.1, 0.2}, {0.35, 0.45}};
  plan.rejected = {{goal, RejectionReason::kClaimed, "robot r2"}};
  plan.trajectory = {{{{0.0, 0.0, 0.5}, 0.0, 0.0}, {{0.35, 0.45, 0.5}, 1.0, 0.5, 0.25}}, 2.0, 1.5};
  plan.effort = {300, 250, 1000, 1, 4};
  plan.goal_kept = true;
  plan.replan_after_s = 1.5;
  plan.waits_for = "r2";
  plan.field_flat = true;
  plan.start_escaped = true;
  plan.explanation = "to the nearest plume";
  return plan;
}

TEST(PlanTest, PlanSurvivesTheRoundTrip) {
  const v1::Plan proto = ToProto(TestPlan(), "hall");
  EXPECT_EQ(proto.name(), "missions/hall/plans/5");
  EXPECT_EQ(proto.robot(), "missions/hall/robots/r1");
  EXPECT_EQ(proto.waits_for(), "missions/hall/robots/r2");
  const auto back = FromProto(proto, "plan");
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(*back, TestPlan());
}

TEST(PlanTest, PlanThatIsNotCommittedHasNoName) {
  Plan plan = TestPlan();
  plan.id = 0;
  EXPECT_EQ(ToProto(plan, "hall").name(), "");
  EXPECT_EQ(FromProto(ToProto(plan, "hall"), "plan").value(), plan);
}

TEST(PlanTest, PlanToStayHasNoChoice) {
  Plan plan = TestPlan();
  plan.chosen = -1;
  plan.trajectory = {};
  EXPECT_EQ(FromProto(ToProto(plan, "hall"), "plan").value(), plan);
}

struct BadField {
  const char* field;
  std::function<void(v1::Plan&)> spoil;
};

TEST(PlanTest, WhatARobotWouldFollowIsChecked) {
  const BadField kBad[] = {
      {"plan.name", [](auto& p) { p.set_name("missions/hall/plans/x"); }},
      {"plan.robot", [](auto& p) { p.clear_robot(); }},
      {"plan.phase", [](auto& p) { p.clear_phase(); }},
      {"plan.end", [](auto& p) { p.set_end(static_cast<v1::Plan::End>(50)); }},
      {"plan.chosen_index", [](auto& p) { p.set_chosen_index(1); }},
      {"plan.chosen_index", [](auto& p) { p.set_chosen_index(-2); }},
      {"plan.candidates[0].cost", [](auto& p) { p.mutable_candidates(0)->set_cost(kNan); }},
      {"plan.candidates[0].length_m", [](auto& p) { p.mutable_candidates(0)->set_length_m(-1.0); }},
      {"plan.candidates[0].unseen_share",
       [](auto& p) { p.mutable_candidates(0)->set_unseen_share(1.5); }},
      {"plan.candidates[0].reward", [](auto& p) { p.mutable_candidates(0)->set_reward(kNan); }},
      {"plan.candidates[0].stops[1].y_m",
       [](auto& p) { p.mutable_candidates(0)->mutable_stops(1)->set_y_m(kNan); }},
      {"plan.candidates[0].path[1].x_m",
       [](auto& p) { p.mutable_candidates(0)->mutable_path(1)->set_x_m(kNan); }},
      {"plan.candidates[0].goal.kind",
       [](auto& p) { p.mutable_candidates(0)->mutable_goal()->clear_kind(); }},
      {"plan.candidates[0].path_source",
       [](auto& p) { p.mutable_candidates(0)->clear_path_source(); }},
      {"plan.rejected_goals[0].reason",
       [](auto& p) { p.mutable_rejected_goals(0)->clear_reason(); }},
      {"plan.trajectory.waypoints[1].pose.y_m",
       [](auto& p) {
         p.mutable_trajectory()->mutable_waypoints(1)->mutable_pose()->set_y_m(kNan);
       }},
      {"plan.trajectory.waypoints[0].arrival_time_s",
       [](auto& p) { p.mutable_trajectory()->mutable_waypoints(0)->set_arrival_time_s(-1.0); }},
      {"plan.trajectory.waypoints[1].arrival_time_s",
       [](auto& p) { p.mutable_trajectory()->mutable_waypoints(0)->set_arrival_time_s(2.0); }},
      {"plan.trajectory.waypoints[1].speed_mps",
       [](auto& p) { p.mutable_trajectory()->mutable_waypoints(1)->set_speed_mps(-1.0); }},
      {"plan.trajectory.duration_s", [](auto& p) { p.mutable_trajectory()->set_duration_s(kNan); }},
      {"plan.replan_after_s", [](auto& p) { p.set_replan_after_s(-1.0); }},
      {"plan.waits_for", [](auto& p) { p.set_waits_for("r2"); }},
  };
  for (const BadField& bad : kBad) {
    v1::Plan proto = ToProto(TestPlan(), "hall");
    bad.spoil(proto);
    const auto violations = FieldViolations(FromProto(proto, "plan").status());
    ASSERT_EQ(violations.size(), 1u) << bad.field;
    EXPECT_EQ(violations[0].field, bad.field);
  }
}

TEST(PlanTest, APlanThatSamplesSitesSaysWhenItsLastSampleIsIn) {
  Plan plan = TestPlan();
  EXPECT_FALSE(ToProto(plan, "hall").has_map_update_s());
  plan.candidates[0].goal.kind = GoalKind::kSite;
  plan.phase = MissionPhase::kSurvey;
  const v1::Plan proto = ToProto(plan, "hall");
  EXPECT_EQ(proto.map_update_s(), plan.trajectory.duration_s);
  EXPECT_EQ(proto.phase(), v1::MISSION_PHASE_SURVEY);
  EXPECT_EQ(FromProto(proto, "plan").value(), plan);
  plan.chosen = -1;
  EXPECT_FALSE(ToProto(plan, "hall").has_map_update_s());
}

TEST(PlanTest, WhatACandidateHasNotIsAbsent) {
  Plan plan = TestPlan();
  plan.candidates[0].reward.reset();
  plan.candidates[0].stops.clear();
  EXPECT_FALSE(ToProto(plan, "hall").candidates(0).has_reward());
  plan.candidates[0].unseen_share = 1.0;
  EXPECT_FALSE(ToProto(plan, "hall").candidates(0).has_unseen_share());
  plan.replan_after_s = 0.0;
  plan.waits_for.clear();
  EXPECT_FALSE(ToProto(plan, "hall").has_replan_after_s());
  EXPECT_EQ(ToProto(plan, "hall").waits_for(), "");
  EXPECT_EQ(FromProto(ToProto(plan, "hall"), "plan").value(), plan);
}

}  // namespace plan_test
}  // namespace plumescout
