// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/departure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/support/plan_map.h"

namespace plumescout {
namespace departure_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The robot may drive in the two cells in the east.
Belief Corridor() {
  return testing::BeliefFromArt({"#######",  //
                                 "#iii..#",  //
                                 "#######"});
}

TEST(Depart, FromATraversableCellIsFromWhereTheRobotStands) {
  const std::optional<Departure> departure = Depart(Corridor(), {0.43, 0.16});
  ASSERT_TRUE(departure.has_value());
  EXPECT_THAT(departure->way_out, IsEmpty());
  EXPECT_EQ(departure->start, (Point2{0.43, 0.16}));
}

TEST(Depart, LeadsOutOfTheInflatedZoneByWayOfTheCellsCentre) {
  const Belief belief = Corridor();
  const std::optional<Departure> departure = Depart(belief, {0.22, 0.11});
  ASSERT_TRUE(departure.has_value());
  EXPECT_EQ(departure->start, belief.geometry().Center({4, 1}));
  EXPECT_THAT(departure->way_out, ElementsAre(Point2{0.22, 0.11}, belief.geometry().Center({2, 1})))
      << "straight runs have no vertices between";
}

TEST(Depart, IsImpossibleIfThereIsNoWayOut) {
  const Belief walled_in = testing::BeliefFromArt({"#######",  //
                                                   "#i#...#",  //
                                                   "#######"});
  EXPECT_FALSE(Depart(walled_in, {0.15, 0.15}).has_value());
}

RobotRecord RobotAt(const Pose2& pose) {
  RobotRecord robot;
  robot.state.has_pose = true;
  robot.state.pose = pose;
  return robot;
}

// East along the corridor at 0.1 m/s.
std::shared_ptr<const Trajectory> Eastward() {
  Trajectory trajectory;
  trajectory.waypoints = {{{0.15, 0.15, 0.0}, 0.0, 0.0}, {{0.55, 0.15, 0.0}, 4.0, 0.0}};
  return std::make_shared<const Trajectory>(trajectory);
}

PlanningOptions Latency(double latency_s) {
  PlanningOptions options;
  options.planning_latency_s = latency_s;
  return options;
}

TEST(StartPose, IsWhereTheLivePlanHasTheRobotWhenTheNextArrives) {
  RobotRecord robot = RobotAt({0.25, 0.12, 1.0});
  robot.live_trajectory = Eastward();
  const Belief belief = Corridor();
  const Pose2 start = *StartPose(belief, {}, robot, Latency(2.0));
  EXPECT_NEAR(start.x_m, 0.45, 1e-12);
  EXPECT_NEAR(start.y_m, 0.15, 1e-12);
  EXPECT_EQ(start.yaw_rad, 0.0);
  EXPECT_NEAR(StartPose(belief, {}, robot, Latency(60.0))->x_m, 0.55, 1e-12) << "not beyond it";
  EXPECT_EQ(*StartPose(belief, {}, robot, Latency(0.0)), robot.state.pose);
  PlanRequest request;
  request.start = Pose2{0.55, 0.15, 2.0};
  EXPECT_EQ(*StartPose(belief, request, robot, Latency(2.0)), *request.start);
}

TEST(StartPose, IsTheRobotsPlaceIfItStrayedOrHasNoLivePlan) {
  RobotRecord robot = RobotAt({0.25, 0.12, 1.0});
  EXPECT_EQ(*StartPose(Corridor(), {}, robot, Latency(2.0)), robot.state.pose);
  Trajectory elsewhere = *Eastward();
  for (Waypoint& waypoint : elsewhere.waypoints) waypoint.pose.y_m += 0.6;
  robot.live_trajectory = std::make_shared<const Trajectory>(elsewhere);
  EXPECT_EQ(*StartPose(Corridor(), {}, robot, Latency(2.0)), robot.state.pose);
  robot.live_trajectory = std::make_shared<const Trajectory>();
  EXPECT_EQ(*StartPose(Corridor(), {}, robot, Latency(2.0)), robot.state.pose);
}

TEST(StartPose, IsTheRobotsUnlessTheRequestNamesOne) {
  const Belief belief = Corridor();
  const RobotRecord robot = RobotAt({0.45, 0.15, 1.0});
  PlanRequest request;
  EXPECT_EQ(*StartPose(belief, request, robot, {}), robot.state.pose);
  request.start = Pose2{0.55, 0.15, 2.0};
  EXPECT_EQ(*StartPose(belief, request, robot, {}), *request.start);
}

TEST(StartPose, MustBeKnownFiniteAndInsideTheMap) {
  const Belief belief = Corridor();
  PlanRequest request;
  EXPECT_EQ(StartPose(belief, request, {}, {}).status().code(),
            absl::StatusCode::kFailedPrecondition);
  for (const Pose2 start : {Pose2{NAN, 0.1, 0.0}, Pose2{0.1, INFINITY, 0.0}, Pose2{0.1, 0.1, NAN},
                            Pose2{-0.1, 0.1, 0.0}, Pose2{0.1, 1e300, 0.0}}) {
    request.start = start;
    EXPECT_EQ(StartPose(belief, request, {}, {}).status().code(),
              absl::StatusCode::kInvalidArgument);
  }
}

}  // namespace departure_test
}  // namespace plumescout
