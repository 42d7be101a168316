// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/plan_publisher.h"

#include <utility>

#include "client/ros2/plan_conversion.h"
#include "core/types/status_macros.h"
#include "formats/ros/view_messages.h"

namespace plumescout::client {
namespace {

absl::StatusOr<std::optional<int>> AdvertiseReliably(DdsNode& node, const PlanTopics& topics,
                                                     const std::string& topic,
                                                     const std::string& ros_type) {
  if (topic.empty()) return std::nullopt;
  PLUMESCOUT_ASSIGN_OR_RETURN(const int writer,
                              node.Advertise(FullTopic(topics.ros_namespace, topic), ros_type, {}));
  return writer;
}

}  // namespace

absl::StatusOr<std::unique_ptr<PlanPublisher>> PlanPublisher::Advertise(
    DdsNode& node, const PlanPublisherOptions& options) {
  std::unique_ptr<PlanPublisher> publisher(new PlanPublisher(node, options));
  const PlanTopics& topics = options.topics;
  PLUMESCOUT_ASSIGN_OR_RETURN(publisher->path_,
                              AdvertiseReliably(node, topics, topics.path, ros::Path::kType));
  if (options.drives == Drives::kGoal) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        publisher->goal_, AdvertiseReliably(node, topics, topics.goal, ros::PoseStamped::kType));
  }
  if (options.drives == Drives::kVelocity) {
    const char* const type =
        options.stamped_velocity ? ros::TwistStamped::kType : ros::Twist::kType;
    PLUMESCOUT_ASSIGN_OR_RETURN(publisher->velocity_,
                                AdvertiseReliably(node, topics, topics.velocity, type));
  }
  return publisher;
}

absl::Status PlanPublisher::PublishPlan(const Plan& plan, const Pose2& pose, std::int64_t time_ns) {
  const ViewPoint view{{ros::ToTime(time_ns), options_.map_frame}, options_.frame};
  if (path_) {
    PLUMESCOUT_RETURN_IF_ERROR(node_.Publish(*path_, ToPath(plan.trajectory, view)));
  }
  if (plan.trajectory.waypoints.empty() || !(plan.trajectory.duration_s > 0.0)) {
    return std::exchange(has_goal_, false) ? PublishGoal(pose, time_ns) : absl::OkStatus();
  }
  has_goal_ = true;
  return PublishGoal(InRobot(options_.frame, plan.trajectory.waypoints.back().pose), time_ns);
}

absl::Status PlanPublisher::PublishStop(const Pose2& pose, std::int64_t time_ns) {
  has_goal_ = false;
  if (path_) {
    const ros::Path none{.header = {ros::ToTime(time_ns), options_.map_frame}};
    PLUMESCOUT_RETURN_IF_ERROR(node_.Publish(*path_, none));
  }
  return PublishGoal(pose, time_ns);
}

absl::Status PlanPublisher::PublishGoal(const Pose2& in_robot, std::int64_t time_ns) {
  if (!goal_) return absl::OkStatus();
  return node_.Publish(*goal_, ToPoseStamped({ros::ToTime(time_ns), options_.map_frame}, in_robot));
}

absl::Status PlanPublisher::PublishVelocity(const Twist& twist, std::int64_t time_ns) {
  if (!velocity_) return absl::OkStatus();
  ros::Twist velocity;
  velocity.linear.x = twist.forward_mps;
  velocity.angular.z = twist.turn_rad_per_s;
  if (!options_.stamped_velocity) return node_.Publish(*velocity_, velocity);
  return node_.Publish(*velocity_,
                       ros::TwistStamped{{ros::ToTime(time_ns), options_.base_frame}, velocity});
}

}  // namespace plumescout::client
