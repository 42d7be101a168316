// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/plan_publisher.h"

#include <gtest/gtest.h>

#include "formats/ros/view_messages.h"
#include "tests/client/ros2/listening_node.h"

namespace plumescout::client {
namespace plan_publisher_test {

constexpr std::int64_t kTime_ns = 3'000'000'000;

constexpr Pose2 kHere{0.25, 0.0, 0.0};

Plan SomePlan() {
  Plan plan;
  plan.trajectory.waypoints = {{{1.0, 1.0, 0.0}}, {{4.0, 1.0, 0.0}}};
  plan.trajectory.duration_s = 3.0;
  return plan;
}

TEST(PlanPublisher, GoalIsForWhoDrivesByIt) {
  const auto robot = OpenNode();
  std::optional<ros::Path> path;
  std::optional<ros::PoseStamped> goal;
  std::optional<ros::TwistStamped> velocity;
  Keep(*robot, "/r/plumescout/path", Delivery::kReliable, path);
  Keep(*robot, "/r/goal_pose", Delivery::kReliable, goal);
  Keep(*robot, "/r/cmd_vel", Delivery::kReliable, velocity);
  const auto node = OpenNode();
  PlanPublisherOptions options{.topics = {.ros_namespace = "r"},
                               .drives = Drives::kGoal,
                               .frame = {.mission_from_robot = {1.0, 1.0, 0.0}}};
  auto publisher = PlanPublisher::Advertise(*node, options);
  ASSERT_TRUE(publisher.ok()) << publisher.status();
  ASSERT_TRUE(Await(
      *robot, [&] { EXPECT_TRUE((*publisher)->PublishPlan(SomePlan(), kHere, kTime_ns).ok()); },
      [&] { return path && goal; }));
  ASSERT_EQ(path->poses.size(), 2u);
  EXPECT_EQ(path->header.stamp.sec, 3);
  EXPECT_EQ(goal->header.frame_id, "map");
  EXPECT_EQ(goal->pose.position.x, 3.0);
  EXPECT_TRUE((*publisher)->PublishVelocity({0.5, 0.0}, kTime_ns).ok());

  ASSERT_TRUE(Await(
      *robot,
      [&] {
        EXPECT_TRUE((*publisher)->PublishStop({0.5, 0.0, 0.0}, kTime_ns).ok());
      },
      [&] { return path->poses.empty() && goal->pose.position.x < 1.0; }));
  EXPECT_FALSE(velocity.has_value());
}

TEST(PlanPublisher, APlanToStayHasTheGoalOfTheOneBeforeReplaced) {
  const auto robot = OpenNode();
  std::optional<ros::PoseStamped> goal;
  Keep(*robot, "/r/goal_pose", Delivery::kReliable, goal);
  const auto node = OpenNode();
  auto publisher =
      PlanPublisher::Advertise(*node, {.topics = {.ros_namespace = "r"}, .drives = Drives::kGoal});
  ASSERT_TRUE(publisher.ok()) << publisher.status();
  const auto publish = [&](const Plan& plan) {
    EXPECT_TRUE((*publisher)->PublishPlan(plan, kHere, kTime_ns).ok());
  };
  ASSERT_TRUE(Await(
      *robot, [&] { publish(SomePlan()); }, [&] { return goal.has_value(); }));
  EXPECT_NE(goal->pose.position.x, kHere.x_m);
  ASSERT_TRUE(Await(
      *robot,
      [&] {
        publish(SomePlan());
        publish(Plan{});
      },
      [&] { return goal->pose.position.x == kHere.x_m; }));
}

TEST(PlanPublisher, VelocityIsForWhoDrivesByThat) {
  const auto robot = OpenNode();
  std::optional<ros::PoseStamped> goal;
  std::optional<ros::TwistStamped> velocity;
  Keep(*robot, "/goal_pose", Delivery::kReliable, goal);
  Keep(*robot, "/cmd_vel", Delivery::kReliable, velocity);
  const auto node = OpenNode();
  const auto publisher = PlanPublisher::Advertise(*node, {.stamped_velocity = true});
  ASSERT_TRUE(publisher.ok()) << publisher.status();
  ASSERT_TRUE(Await(
      *robot,
      [&] {
        EXPECT_TRUE((*publisher)->PublishPlan(SomePlan(), kHere, kTime_ns).ok());
        EXPECT_TRUE((*publisher)->PublishVelocity({0.5, -0.2}, kTime_ns).ok());
      },
      [&] { return velocity.has_value(); }));
  EXPECT_EQ(velocity->twist.linear.x, 0.5);
  EXPECT_EQ(velocity->twist.angular.z, -0.2);
  EXPECT_EQ(velocity->header.frame_id, "base_link");
  EXPECT_FALSE(goal.has_value());
}

}  // namespace plan_publisher_test
}  // namespace plumescout::client
