// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "absl/time/clock.h"
#include "client/ros2/dds_node.h"
#include "formats/ros/cdr_reader.h"
#include "formats/ros/view_messages.h"
#include "tests/client/ros2/loopback_dds.h"
#include "tests/client/ros2/stamped.h"
#include "tests/support/box_room.h"

namespace plumescout::client {

struct BoxRobotOptions {
  std::string ros_namespace = "robot1";
  bool publishes_gas = true;
};

// A robot of ROS 2 in a room of 5 x 4 m, on a thread of its own: publishes ten times a second, and
// drives as it is told.
class BoxRobot {
 public:
  explicit BoxRobot(const BoxRobotOptions& options = {}) : options_(options) {
    KeepDdsToLoopback();
    auto node = DdsNode::Open(OwnDomain());
    EXPECT_TRUE(node.ok()) << node.status();
    node_ = *std::move(node);
    tf_static_ = Advertise("tf_static", ros::TfMessage::kType, Delivery::kLatched);
    tf_ = Advertise("tf", ros::TfMessage::kType, Delivery::kReliable);
    scan_ = Advertise("scan", ros::LaserScan::kType, Delivery::kSensor);
    gas_ = options.publishes_gas
               ? Advertise("PID/Sensor_reading", ros::GasSensor::kType, Delivery::kReliable)
               : -1;
    Subscribe<ros::Twist>("cmd_vel", Delivery::kReliable, [this](const ros::Twist& twist) {
      twist_ = twist;
      velocities += 1;
    });
    Subscribe<ros::Path>("plumescout/path", Delivery::kReliable, [this](const ros::Path& path) {
      if (!path.poses.empty()) paths += 1;
    });
    Subscribe<ros::OccupancyGrid>("map", Delivery::kLatched, [this](const ros::OccupancyGrid& map) {
      free_cells = std::count(map.data.begin(), map.data.end(), 0);
    });
    Subscribe<ros::GridMap>("gas_map", Delivery::kLatched,
                            [this](const ros::GridMap&) { gas_maps += 1; });
    thread_ = std::thread([this] { Run(); });
  }
  ~BoxRobot() {
    stop_ = true;
    thread_.join();
  }

  double driven_m() const { return driven_m_; }
  std::atomic<std::int64_t> velocities = 0;
  std::atomic<std::int64_t> paths = 0;
  std::atomic<std::int64_t> free_cells = 0;
  std::atomic<std::int64_t> gas_maps = 0;

 private:
  static constexpr double kStep_s = 0.1;

  std::string Name(const std::string& topic) const {
    return FullTopic(options_.ros_namespace, topic);
  }
  int Advertise(const std::string& topic, const char* type, Delivery delivery) {
    const auto writer = node_->Advertise(Name(topic), type, {.delivery = delivery, .depth = 10});
    EXPECT_TRUE(writer.ok()) << writer.status();
    return *writer;
  }
  template <typename Message, typename Hear>
  void Subscribe(const std::string& topic, Delivery delivery, Hear hear) {
    const auto status =
        node_->Subscribe(Name(topic), Message::kType, {.delivery = delivery, .depth = 1},
                         [hear](absl::string_view cdr) {
                           const auto message = ros::DecodeCdr<Message>(cdr);
                           ASSERT_TRUE(message.ok()) << message.status();
                           hear(*message);
                         });
    EXPECT_TRUE(status.ok()) << status;
  }
  void Run() {
    EXPECT_TRUE(
        node_->Publish(tf_static_, ros::TfMessage{{Stamped("base_link", "laser", 0, {})}}).ok());
    absl::Time next = absl::Now();
    while (!stop_) {
      Step();
      next += absl::Seconds(kStep_s);
      while (!stop_ && absl::Now() < next) node_->Poll(next - absl::Now());
    }
  }
  void Step() {
    const double forward_m = twist_.linear.x * kStep_s;
    driven_m_ = driven_m_ + std::abs(forward_m);
    pose_ = Compose(pose_, {forward_m, 0.0, twist_.angular.z * kStep_s});
    const std::int64_t now_ns = absl::GetCurrentTimeNanos();
    const ros::Header header{ros::ToTime(now_ns), "laser"};
    EXPECT_TRUE(node_
                    ->Publish(tf_, ros::TfMessage{{Stamped("map", "odom", now_ns, {}),
                                                   Stamped("odom", "base_link", now_ns, pose_)}})
                    .ok());
    const Scan seen = support::ScanInBox(pose_, 5.0, 4.0);
    ros::LaserScan scan;
    scan.header = header;
    scan.angle_min = static_cast<float>(seen.start_angle_rad);
    scan.angle_increment = static_cast<float>(seen.angle_step_rad);
    scan.range_max = static_cast<float>(seen.max_range_m);
    scan.ranges = seen.ranges_m;
    EXPECT_TRUE(node_->Publish(scan_, scan).ok());
    if (gas_ < 0) return;
    ros::GasSensor gas;
    gas.header = header;
    gas.raw = 2000.0 * pose_.x_m;
    gas.raw_units = ros::GasSensor::kPpb;
    EXPECT_TRUE(node_->Publish(gas_, gas).ok());
  }

  const BoxRobotOptions options_;
  std::unique_ptr<DdsNode> node_;
  int tf_static_ = 0;
  int tf_ = 0;
  int scan_ = 0;
  int gas_ = 0;
  ros::Twist twist_;  // on the thread, as all that follows
  Pose2 pose_ = {1.5, 1.0, 0.0};
  std::atomic<double> driven_m_ = 0.0;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace plumescout::client
