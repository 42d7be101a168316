// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/robot_topics.h"

#include <utility>

#include "client/ros2/steady_clock.h"
#include "core/types/status_macros.h"
#include "formats/ros/cdr_reader.h"
#include "formats/ros/messages.h"

namespace plumescout::client {
namespace {

constexpr int kTransforms = 100;  // as many as publishers of transforms keep
constexpr int kSamples = 20;

template <typename Message, typename HearMessage>
absl::Status Listen(const TopicNames& names, const std::string& topic, const TopicQos& qos,
                    DdsNode& node, RobotIntake& intake, HearMessage hear) {
  if (topic.empty()) return absl::OkStatus();
  return node.Subscribe(FullTopic(names.ros_namespace, topic), Message::kType, qos,
                        [&intake, topic, hear](absl::string_view cdr) {
                          absl::StatusOr<Message> message = ros::DecodeCdr<Message>(cdr);
                          if (!message.ok()) return intake.Refuse(topic, message.status());
                          hear(*std::move(message));
                        });
}

}  // namespace

absl::Status ListenToRobot(const TopicNames& names, DdsNode& node, RobotIntake& intake) {
  const TopicQos sensor{.delivery = Delivery::kSensor, .depth = kSamples};
  PLUMESCOUT_RETURN_IF_ERROR(Listen<ros::TfMessage>(
      names, names.tf_static, {.delivery = Delivery::kLatched, .depth = kTransforms}, node, intake,
      [&intake](ros::TfMessage message) { intake.OnTransforms(message, /*is_static=*/true); }));
  PLUMESCOUT_RETURN_IF_ERROR(Listen<ros::TfMessage>(
      names, names.tf, {.delivery = Delivery::kReliable, .depth = kTransforms}, node, intake,
      [&intake](ros::TfMessage message) { intake.OnTransforms(message, /*is_static=*/false); }));
  PLUMESCOUT_RETURN_IF_ERROR(
      Listen<ros::Odometry>(names, names.odometry, sensor, node, intake,
                            [&intake](ros::Odometry message) { intake.OnOdometry(message); }));
  PLUMESCOUT_RETURN_IF_ERROR(Listen<ros::LaserScan>(
      names, names.scan, sensor, node, intake,
      [&intake](ros::LaserScan message) { intake.OnScan(std::move(message), Steady_ns()); }));
  PLUMESCOUT_RETURN_IF_ERROR(Listen<ros::GasSensor>(
      names, names.gas, sensor, node, intake,
      [&intake](ros::GasSensor message) { intake.OnGas(std::move(message), Steady_ns()); }));
  return Listen<ros::Anemometer>(names, names.wind, sensor, node, intake,
                                 [&intake](ros::Anemometer message) { intake.OnWind(message); });
}

}  // namespace plumescout::client
