// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/plan_start.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "core/plan/plan_seed.h"
#include "core/types/error_reason.h"
#include "tests/support/strategy_case.h"

namespace plumescout {
namespace plan_start_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const testing::GridArt kRoom = {".....",  //
                                "..S..",  //
                                "iiiii"};

PlanStart Begin(const Belief& belief, const PlanRequest& request) {
  auto start = BeginPlan(belief, request, testing::XitGff());
  EXPECT_TRUE(start.ok()) << start.status();
  return *std::move(start);
}

TEST(BeginPlan, FillsInWhatEveryPlanSays) {
  const Belief belief = testing::SmallBelief(kRoom);
  const PlanStart start = Begin(belief, testing::For("r", 5));
  EXPECT_EQ(start.plan.robot, "r");
  EXPECT_EQ(start.plan.strategy, "xit_gff");
  EXPECT_EQ(start.plan.belief_revision, belief.revision);
  EXPECT_EQ(start.plan.seed, 5u);
  EXPECT_EQ(start.plan.chosen, -1);
  EXPECT_EQ(start.pose.position(), belief.geometry().Center({2, 1}));
  EXPECT_EQ(&start.robot, &belief.robots.at("r"));
  ASSERT_TRUE(start.departure.has_value());
  EXPECT_THAT(start.departure->way_out, IsEmpty());
  EXPECT_EQ(start.departure->yaw_rad, 0.5) << "of the robot";
  EXPECT_FALSE(start.plan.start_escaped);
}

TEST(BeginPlan, DerivesASeedFromMissionRobotAndPlansSoFar) {
  Belief belief = testing::SmallBelief(kRoom);
  belief.robots["r"].plans_issued = 3;
  EXPECT_EQ(Begin(belief, testing::For("r")).plan.seed,
            DerivedPlanSeed(belief.options->seed, "r", 3));
}

TEST(BeginPlan, LeadsOutOfTheInflatedZone) {
  const Belief belief = testing::SmallBelief(kRoom);
  PlanRequest request = testing::For("r");
  const Point2 inflated = belief.geometry().Center({2, 0});
  request.start = Pose2{inflated.x_m, inflated.y_m, 1.0};
  const PlanStart start = Begin(belief, request);
  EXPECT_TRUE(start.plan.start_escaped);
  ASSERT_TRUE(start.departure.has_value());
  EXPECT_EQ(start.departure->way_out.front(), inflated);
  EXPECT_EQ(start.departure->yaw_rad, 1.0);
}

TEST(BeginPlan, WithoutAWayOutThePlanIsToStay) {
  Belief belief = testing::SmallBelief(kRoom);
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(belief.geometry(), 0);
  const PlanStart start = Begin(belief, testing::For("r"));
  EXPECT_FALSE(start.departure.has_value());
  EXPECT_EQ(start.plan.end, PlanEnd::kStartOccupied);
}

TEST(BeginPlan, RefusesUnknownRobotsAndThoseWithoutAPlace) {
  Belief belief = testing::SmallBelief(kRoom);
  const auto status = [&](const RobotId& robot) {
    return BeginPlan(belief, testing::For(robot), {}).status();
  };
  EXPECT_TRUE(absl::IsNotFound(status("nobody")));
  belief.robots["blind"].state.id = "blind";
  EXPECT_TRUE(absl::IsFailedPrecondition(status("blind")));
}

// Robot "r" in a long room, and "s" so far to the east of it, whose pose came later.
Belief TwoRobots(double apart_m) {
  Belief belief = testing::SmallBelief({"S............................."});
  RobotRecord& r = belief.robots["r"];
  r.state.radius_m = 0.2;
  r.pose_ns = 1;
  RobotRecord s = r;
  s.state.id = "s";
  s.state.pose.x_m += apart_m;
  s.pose_ns = 2;
  belief.robots["s"] = s;
  return belief;
}

absl::Status BeginStatus(const Belief& belief, const PlanRequest& request,
                         const PlanningOptions& options = {}) {
  return BeginPlan(belief, request, options).status();
}

TEST(BeginPlan, RefusesTheLaterOfTwoRobotsAtOnePlace) {
  const Belief belief = TwoRobots(0.15);
  const absl::Status later = BeginStatus(belief, testing::For("s"));
  EXPECT_TRUE(absl::IsFailedPrecondition(later));
  EXPECT_EQ(ErrorReason(later), reason::kStartInRobot);
  EXPECT_THAT(std::string(later.message()), AllOf(HasSubstr("robot \"r\""), HasSubstr("0.15 m")));
  EXPECT_TRUE(BeginStatus(belief, testing::For("r")).ok()) << "one drives on";
  PlanRequest ahead = testing::For("s");
  ahead.start = belief.robots.at("s").state.pose;
  EXPECT_TRUE(absl::IsFailedPrecondition(BeginStatus(belief, ahead)));
  ahead.start->x_m += 0.3;
  EXPECT_TRUE(BeginStatus(belief, ahead).ok());
  EXPECT_TRUE(BeginStatus(TwoRobots(0.25), testing::For("s")).ok()) << "poses err by so much";
  PlanningOptions alone;
  alone.yield_to_robots = false;
  EXPECT_TRUE(BeginStatus(belief, testing::For("s"), alone).ok());
}

TEST(BeginPlan, OfTwoPosesOfOneTimeThatOfTheLaterNameIsRefused) {
  Belief belief = TwoRobots(0.0);
  belief.robots["r"].pose_ns = 2;
  EXPECT_TRUE(absl::IsFailedPrecondition(BeginStatus(belief, testing::For("s"))));
  EXPECT_TRUE(BeginStatus(belief, testing::For("r")).ok());
}

TEST(BeginPlan, RefusesAGivenStartInAnotherRobotFarOff) {
  const Belief belief = TwoRobots(2.5);
  PlanRequest request = testing::For("r");
  request.start = belief.robots.at("s").state.pose;
  const absl::Status status = BeginStatus(belief, request);
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_EQ(ErrorReason(status), reason::kStartInRobot);
  EXPECT_THAT(std::string(status.message()), AllOf(HasSubstr("start = ("), HasSubstr("\"s\"")));
  request.start->x_m -= 0.3;
  EXPECT_TRUE(BeginStatus(belief, request).ok());
}

TEST(BeginPlan, PassesOverRobotsOfWhichNobodyKnowsWhereTheyAre) {
  const auto begins = [](const std::function<void(Belief&)>& change) {
    Belief belief = TwoRobots(0.0);
    change(belief);
    return BeginStatus(belief, testing::For("s")).ok();
  };
  EXPECT_FALSE(begins([](Belief&) {}));
  EXPECT_TRUE(begins([](Belief& b) { b.robots["r"].state.silent = true; }));
  EXPECT_TRUE(begins([](Belief& b) { b.robots["r"].state.has_pose = false; }));
  EXPECT_TRUE(begins([](Belief& b) { b.robots["r"].state.frame_suspect = true; }));
  EXPECT_TRUE(begins([](Belief& b) { b.robots["s"].state.frame_suspect = true; }));
  EXPECT_TRUE(begins([](Belief& b) { b.robots["r"].state.frame.position_stddev_m = 0.1; }));
  const auto unheard = [](Belief& b) { b.sample_time_ns = 5'000'000'000; };
  EXPECT_FALSE(begins(unheard)) << "it stands there";
  EXPECT_TRUE(begins([&](Belief& b) {
    unheard(b);
    b.robots["r"].live_trajectory = std::make_shared<const Trajectory>();
  })) << "it has driven on";
}

TEST(PutBefore, CountsTheWayOutAsLength) {
  Candidate candidate;
  candidate.path = {{3, 4}, {3, 5}};
  candidate.length_m = 1.0;
  PutBefore({{0, 0}, {0, 4}}, candidate);
  EXPECT_THAT(candidate.path, ElementsAre(Point2{0, 0}, Point2{0, 4}, Point2{3, 4}, Point2{3, 5}));
  EXPECT_NEAR(candidate.length_m, 1.0 + 4.0 + 3.0, 1e-12);
  const Candidate before = candidate;
  PutBefore({}, candidate);
  EXPECT_EQ(candidate, before);
}

TEST(StoppedBeforeAnyPath, IsAMissedDeadline) {
  EXPECT_TRUE(absl::IsDeadlineExceeded(StoppedBeforeAnyPath()));
}

}  // namespace plan_start_test
}  // namespace plumescout
