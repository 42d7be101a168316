// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/right_of_way.h"

#include <cmath>
#include <memory>

#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/counting_stop.h"

namespace plumescout {
namespace right_of_way_test {

constexpr std::int64_t kNow_ns = 50'000'000'000;

RobotRecord At(const RobotId& robot, Point2 place) {
  RobotRecord record;
  record.state.id = robot;
  record.state.radius_m = 0.2;
  record.state.has_pose = true;
  record.state.pose = {place.x_m, place.y_m, 0.0};
  return record;
}

// Robot "a" stands at the origin; "b" drives north across x = 3 m.
Belief CrossedBelief() {
  Belief belief;
  belief.sample_time_ns = kNow_ns;
  belief.robots = {{"a", At("a", {0.0, 0.0})}, {"b", At("b", {3.0, -2.0})}};
  const Trajectory north = TimeTrajectory({{3.0, -2.0}, {3.0, 10.0}}, M_PI_2, {});
  belief.robots["b"].live_trajectory = std::make_shared<const Trajectory>(north);
  belief.robots["b"].live_arrival_ns = kNow_ns + std::llround(north.duration_s * 1e9);
  return belief;
}

Candidate Way(Point2 to) {
  Candidate candidate;
  candidate.path = {{0.0, 0.0}, to};
  candidate.goal.position = to;
  candidate.duration_s = TimeTrajectory(candidate.path, 0.0, {}).duration_s;
  return candidate;
}

Plan PlanOf(std::vector<Candidate> candidates) {
  Plan plan;
  plan.robot = "a";
  plan.end = PlanEnd::kAllGoalsReached;
  plan.candidates = std::move(candidates);
  return plan;
}

TEST(YieldToRobots, WaitsForWhoCrossesAndNotOtherwise) {
  const PlanningOptions options;
  Plan plan = PlanOf({Way({5.0, 0.0}), Way({-5.0, 0.0})});
  YieldToRobots(CrossedBelief(), 0.0, options, plan);
  ASSERT_EQ(plan.candidates.size(), 2u);
  const Trajectory crossing = TrajectoryOf(plan.candidates[0], 0.0, options);
  EXPECT_GE(WaitOf_s(crossing), 0.5);
  EXPECT_DOUBLE_EQ(crossing.duration_s, plan.candidates[0].duration_s);
  EXPECT_NEAR(crossing.duration_s, 4.0 + WaitOf_s(crossing), 1e-9);
  const Trajectory away = TrajectoryOf(plan.candidates[1], 0.0, options);
  EXPECT_EQ(away, TimeTrajectory(plan.candidates[1].path, 0.0, options));
  EXPECT_EQ(plan.end, PlanEnd::kAllGoalsReached);
}

TEST(YieldToRobots, RejectsAWayThatARobotStandsOn) {
  Belief belief = CrossedBelief();
  belief.robots["b"] = At("b", {3.0, 0.1});
  Plan plan = PlanOf({Way({5.0, 0.0})});
  YieldToRobots(belief, 0.0, {}, plan);
  EXPECT_TRUE(plan.candidates.empty());
  EXPECT_EQ(plan.end, PlanEnd::kAllGoalsRejected);
  ASSERT_EQ(plan.rejected.size(), 1u);
  EXPECT_EQ(plan.rejected[0].reason, RejectionReason::kTraffic);
  EXPECT_THAT(plan.rejected[0].detail, ::testing::HasSubstr("robot \"b\" at (2."));
}

TEST(YieldToRobots, NamesWhomItWaitsForWhenNothingIsLeft) {
  Belief belief = CrossedBelief();
  belief.robots["b"] = At("b", {3.0, 0.1});
  belief.robots["c"] = At("c", {-3.0, 0.1});
  Plan plan = PlanOf({Way({5.0, 0.0}), Way({-4.0, 0.0})});
  YieldToRobots(belief, 0.0, {}, plan);
  EXPECT_EQ(plan.waits_for, "c") << "in the way of what is the sooner reached";
  Plan other = PlanOf({Way({5.0, 0.0}), Way({0.0, 4.0})});
  YieldToRobots(belief, 0.0, {}, other);
  EXPECT_EQ(other.waits_for, "");
}

TEST(NoteWhomItWaitsFor, IsWhoWouldBeMetByLeavingAtOnce) {
  const Belief belief = CrossedBelief();
  Plan plan = PlanOf({Way({5.0, 0.0}), Way({-5.0, 0.0})});
  YieldToRobots(belief, 0.0, {}, plan);
  ASSERT_EQ(plan.candidates.size(), 2u);
  plan.chosen = 1;
  NoteWhomItWaitsFor(belief, 0.0, {}, plan);
  EXPECT_EQ(plan.waits_for, "");
  plan.chosen = 0;
  NoteWhomItWaitsFor(belief, 0.0, {}, plan);
  EXPECT_EQ(plan.waits_for, "b");
}

TEST(FindWaits, AreThoseOfTheCandidatesOneByOne) {
  const PlanningOptions options;
  Plan plan = PlanOf({Way({5.0, 0.0}), Way({-5.0, 0.0}), Way({3.0, 0.0})});
  Belief belief = CrossedBelief();
  belief.robots["c"] = At("c", {3.0, 0.4});
  const std::optional<Waits> waits = FindWaits(belief, 0.0, options, plan);
  ASSERT_TRUE(waits.has_value());
  ASSERT_EQ(waits->waits_s.size(), 3u);
  EXPECT_FALSE(waits->waits_s[0].has_value()) << "\"c\" stands there";
  EXPECT_EQ(waits->waits_s[1], 0.0);
  EXPECT_FALSE(waits->waits_s[2].has_value());
  YieldToRobots(*waits, 0.0, options, plan);
  ASSERT_EQ(plan.candidates.size(), 1u);
  EXPECT_EQ(plan.rejected.size(), 2u);
}

TEST(FindWaitsUntil, LooksOnlyForTheBestThatIsClearOnceToldToStop) {
  const PlanningOptions options;
  Belief belief = CrossedBelief();
  belief.robots["c"] = At("c", {3.0, 0.4});
  Plan all = PlanOf({Way({5.0, 0.0}), Way({-4.0, 0.0}), Way({-5.0, 0.0}), Way({3.0, 0.0})});
  for (std::size_t i = 0; i < all.candidates.size(); ++i) {
    all.candidates[i].cost = 4.0 - static_cast<double>(i);
  }
  Plan plan = all;
  testing::CountingStop stop(1);
  const auto waits = FindWaitsUntil(stop.Fn(), belief, 0.0, options, plan);
  ASSERT_TRUE(waits.has_value());
  // The first before it was told, then the cheapest, which is blocked, and the next, which is
  // clear.
  EXPECT_THAT(waits->waits_s, ::testing::ElementsAre(std::nullopt, std::nullopt, 0.0));
  ASSERT_EQ(plan.candidates.size(), 3u);
  EXPECT_EQ(plan.candidates[0], all.candidates[0]);
  EXPECT_EQ(plan.candidates[1], all.candidates[3]);
  EXPECT_EQ(plan.candidates[2], all.candidates[2]);
  ASSERT_EQ(plan.rejected.size(), 1u);
  EXPECT_EQ(plan.rejected[0].reason, RejectionReason::kSearchStopped);
  EXPECT_EQ(plan.end, PlanEnd::kStopped);
  Plan whole = all;
  EXPECT_EQ(FindWaitsUntil(NeverStop(), belief, 0.0, options, whole)->waits_s,
            FindWaits(belief, 0.0, options, all)->waits_s);
  EXPECT_EQ(whole, all);
}

TEST(FindWaits, OfARobotThatIsAloneAreNone) {
  Belief belief = CrossedBelief();
  belief.robots.erase("b");
  EXPECT_FALSE(FindWaits(belief, 0.0, {}, PlanOf({Way({5.0, 0.0})})).has_value());
  EXPECT_FALSE(FindWaits(CrossedBelief(), 0.0, {}, PlanOf({})).has_value());
}

TEST(YieldToRobots, IsAnOption) {
  PlanningOptions options;
  options.yield_to_robots = false;
  Plan plan = PlanOf({Way({5.0, 0.0})});
  const Plan before = plan;
  YieldToRobots(CrossedBelief(), 0.0, options, plan);
  EXPECT_EQ(plan, before);
}

TEST(YieldToRobots, OfStrategiesThatSampleTheStopsAreTimed) {
  PlanningOptions options;
  options.dwell_s = 2.0;
  Candidate sampling = Way({5.0, 0.0});
  sampling.stops = {{5.0, 0.0}};
  sampling.duration_s = TimeTrajectory(sampling.path, sampling.stops, 0.0, options).duration_s;
  Plan plan = PlanOf({sampling});
  YieldToRobots(CrossedBelief(), 0.0, options, plan);
  ASSERT_EQ(plan.candidates.size(), 1u);
  const Trajectory trajectory = TrajectoryOf(plan.candidates[0], 0.0, options);
  EXPECT_EQ(trajectory.waypoints.back().dwell_s, 2.0);
  EXPECT_NEAR(trajectory.duration_s, 6.0 + WaitOf_s(trajectory), 1e-9);
}

}  // namespace right_of_way_test
}  // namespace plumescout
