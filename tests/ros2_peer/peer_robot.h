// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/strings/string_view.h"
#include "absl/synchronization/mutex.h"
#include "client/motion.h"
#include "formats/ros/messages.h"
#include "formats/ros/view_messages.h"
#include "lab/sim/simulated_robot.h"
#include "tests/ros2_peer/fast_dds_node.h"

namespace plumescout::ros2_peer {

struct PeerOptions {
  int domain = 0;
  std::string ros_namespace = {};
  bool drives_by_path = false;  // else by velocity
  bool makes_mischief = false;  // publishes what makes no sense, besides
  double slam_jump_s = 0.0;     // after so long SLAM finds out that it was off; 0: never
  int beams = 360;
};

// What has become of a robot.
struct PeerReport {
  double driven_m = 0.0;
  std::int64_t paths = 0;
  std::int64_t velocities = 0;
  std::int64_t maps = 0;
  std::int64_t gas_maps = 0;
  std::int64_t gas_layers = 0;  // of mean or variance, for viewers
  std::int64_t frontiers = 0;   // markers
  std::int64_t unreadable = 0;
  // From the publication of the newest scan that was there when a path was asked for, which is what
  // it is stamped with, until it came.
  std::vector<double> latencies_s;
};

// A robot of ROS 2 by Fast DDS: simulated wheels, scanner, gas sensor and localisation, which
// publish transforms fifty times a second and samples ten times.
class PeerRobot {
 public:
  // `robot` must outlive it.
  PeerRobot(lab::SimulatedRobot& robot, const PeerOptions& options);

  // A fiftieth of a second.
  void Step();
  PeerReport report() const;

 private:
  FastDdsNode::Writer& Advertise(const std::string& topic, const char* type, Service service);
  template <typename Message, typename Hear>
  void Subscribe(const std::string& topic, Service service, Hear hear);
  void SubscribeAll();
  void Move();
  void PublishTransforms();
  void PublishScan();
  void PublishGas();
  void MakeMischief();
  void NoteLatency(std::int64_t asked_ns) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  ros::Header HeaderOf(const std::string& frame) const;

  lab::SimulatedRobot& robot_;
  const PeerOptions options_;
  FastDdsNode node_;
  FastDdsNode::Writer& tf_static_;
  FastDdsNode::Writer& tf_;
  FastDdsNode::Writer& odometry_;
  FastDdsNode::Writer& scan_;
  FastDdsNode::Writer& gas_;
  std::int64_t steps_ = 0;
  Pose2 last_pose_;

  mutable absl::Mutex mutex_;
  client::Twist twist_ ABSL_GUARDED_BY(mutex_);
  std::unique_ptr<client::Motion> motion_ ABSL_GUARDED_BY(mutex_);
  PeerReport report_ ABSL_GUARDED_BY(mutex_);
  // Of the last scans, the stamp and when they were published, by the machine's clock.
  std::deque<std::pair<std::int64_t, std::int64_t>> scans_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::ros2_peer
