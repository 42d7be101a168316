// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/robot_driver.h"
#include "client/ros2/dds_node.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/robot_frame.h"

namespace plumescout::client {

// Who moves the robot.
enum class Drives {
  kVelocity,  // the path follower of this program, by velocities
  kPath,      // somebody who follows the path that is published; an empty one says stop
  kGoal,      // somebody who finds a path to the goal that is published
};

// Below the robot's namespace, unless they begin with a slash; an empty one is not published.
struct PlanTopics {
  std::string ros_namespace = {};
  std::string velocity = "cmd_vel";
  std::string path = "plumescout/path";
  std::string goal = "goal_pose";
};

struct PlanPublisherOptions {
  PlanTopics topics = {};
  Drives drives = Drives::kVelocity;
  bool stamped_velocity = false;  // TwistStamped instead of Twist
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  RobotFrame frame = {};  // of the robot in the mission
};

// Publishes where a robot is to go. The path is published whoever drives; velocity and goal only
// for who drives by them.
class PlanPublisher {
 public:
  // `node` must outlive it.
  static absl::StatusOr<std::unique_ptr<PlanPublisher>> Advertise(
      DdsNode& node, const PlanPublisherOptions& options);

  // Stamped with a time of the robot's clock. The robot is at `pose`, of its own frame: where the
  // plan is to stay, that takes the place of the goal of the one before.
  absl::Status PublishPlan(const Plan& plan, const Pose2& pose, std::int64_t time_ns);
  // The plan is not to be driven on by who follows it.
  absl::Status PublishStop(const Pose2& pose, std::int64_t time_ns);
  absl::Status PublishVelocity(const Twist& twist, std::int64_t time_ns);

 private:
  PlanPublisher(DdsNode& node, const PlanPublisherOptions& options)
      : node_(node), options_(options) {}
  absl::Status PublishGoal(const Pose2& in_robot, std::int64_t time_ns);

  DdsNode& node_;
  const PlanPublisherOptions options_;
  std::optional<int> velocity_;
  std::optional<int> path_;
  std::optional<int> goal_;
  bool has_goal_ = false;  // who drives by it has one
};

}  // namespace plumescout::client
