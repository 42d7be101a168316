// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/ros2_peer/peer_robot.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "absl/time/clock.h"
#include "client/ros2/dds_node.h"
#include "client/ros2/transform.h"

namespace plumescout::ros2_peer {
namespace {

constexpr double kStep_s = 0.02;
constexpr int kStepsPerSample = 5;
constexpr int kStepsPerMischief = 130;
constexpr double kFollowSpeed_mps = 0.5;
constexpr std::size_t kMostScans = 300;  // that a plan may have been asked for after
// Where odom lies in the map, and by how much SLAM takes it for elsewhere before it finds out.
constexpr Pose2 kMapFromOdom = {0.4, -0.3, 0.2};
constexpr Pose2 kSlamError = {0.0, 0.5, 0.0};
// The scanner is mounted with its zero to the left.
constexpr double kLaserYaw_rad = M_PI_2;

ros::TransformStamped Between(const ros::Header& parent, const std::string& child,
                              const Pose2& pose) {
  return {.header = parent, .child_frame_id = child, .transform = client::FromPlanar(pose)};
}

Trajectory ToTrajectory(const ros::Path& path) {
  Trajectory trajectory;
  double time_s = 0.0;
  for (const ros::PoseStamped& stamped : path.poses) {
    const Pose2 pose = client::ToPlanar(stamped.pose);
    if (!trajectory.waypoints.empty()) {
      time_s += Distance_m(trajectory.waypoints.back().pose.position(), pose.position()) /
                kFollowSpeed_mps;
    }
    trajectory.waypoints.push_back({.pose = pose, .arrival_time_s = time_s});
  }
  trajectory.duration_s = time_s;
  return trajectory;
}

}  // namespace

PeerRobot::PeerRobot(lab::SimulatedRobot& robot, const PeerOptions& options)
    : robot_(robot),
      options_(options),
      node_(options.domain),
      tf_static_(Advertise("tf_static", ros::TfMessage::kType, Service::kLatched)),
      tf_(Advertise("tf", ros::TfMessage::kType, Service::kReliable)),
      odometry_(Advertise("odom", ros::Odometry::kType, Service::kReliable)),
      scan_(Advertise("scan", ros::LaserScan::kType, Service::kBestEffort)),
      gas_(Advertise("PID/Sensor_reading", ros::GasSensor::kType, Service::kReliable)),
      last_pose_(robot.true_pose()) {
  SubscribeAll();
  ros::TfMessage mounts;
  mounts.transforms = {Between(HeaderOf("base_link"), "laser", {0.0, 0.0, kLaserYaw_rad}),
                       Between(HeaderOf("base_link"), "gas_sensor", {})};
  node_.Publish(tf_static_, mounts);
  // Whoever comes later would not hear of these mounts.
  if (options.makes_mischief) Advertise("tf_static", ros::TfMessage::kType, Service::kReliable);
}

FastDdsNode::Writer& PeerRobot::Advertise(const std::string& topic, const char* type,
                                          Service service) {
  return node_.Advertise(client::DdsTopic(client::FullTopic(options_.ros_namespace, topic)),
                         client::DdsType(type), service);
}

template <typename Message, typename Hear>
void PeerRobot::Subscribe(const std::string& topic, Service service, Hear hear) {
  node_.Subscribe(client::DdsTopic(client::FullTopic(options_.ros_namespace, topic)),
                  client::DdsType(Message::kType), service, [this, hear](std::string cdr) {
                    const absl::MutexLock lock(&mutex_);
                    try {
                      hear(Decode<Message>(std::move(cdr)));
                    } catch (const eprosima::fastcdr::exception::Exception&) {
                      ++report_.unreadable;
                    }
                  });
}

void PeerRobot::SubscribeAll() ABSL_NO_THREAD_SAFETY_ANALYSIS {
  Subscribe<ros::Twist>("cmd_vel", Service::kReliable, [this](const ros::Twist& twist) {
    ++report_.velocities;
    if (!options_.drives_by_path) twist_ = {twist.linear.x, twist.angular.z};
  });
  Subscribe<ros::Path>("plumescout/path", Service::kReliable, [this](const ros::Path& path) {
    motion_.reset();
    if (path.poses.empty()) return;
    ++report_.paths;
    NoteLatency(ros::ToNanoseconds(path.header.stamp));
    if (options_.drives_by_path) {
      motion_ = client::StartMotion(client::Following::kProportional, ToTrajectory(path), {},
                                    ros::ToNanoseconds(path.header.stamp));
    }
  });
  const auto count_grids = [this](const std::string& topic, std::int64_t& count) {
    Subscribe<ros::OccupancyGrid>(topic, Service::kLatched, [&count](const auto& grid) {
      if (grid.data.size() == std::size_t{grid.info.width} * grid.info.height) ++count;
    });
  };
  count_grids("map", report_.maps);
  count_grids("gas_mean", report_.gas_layers);
  count_grids("gas_variance", report_.gas_layers);
  Subscribe<ros::GridMap>("gas_map", Service::kLatched, [this](const ros::GridMap& map) {
    if (map.layers.size() == map.data.size()) ++report_.gas_maps;
  });
  Subscribe<ros::MarkerArray>("frontiers", Service::kLatched, [this](const auto& seen) {
    report_.frontiers += std::ssize(seen.markers) - 1;  // but for the one that clears
  });
}

ros::Header PeerRobot::HeaderOf(const std::string& frame) const {
  return {ros::ToTime(robot_.now_ns()), frame};
}

void PeerRobot::Step() {
  Move();
  PublishTransforms();
  if (steps_ % kStepsPerSample == 0) {
    PublishScan();
    PublishGas();
  }
  if (options_.makes_mischief && steps_ % kStepsPerMischief == 0) MakeMischief();
  ++steps_;
}

void PeerRobot::Move() {
  {
    const absl::MutexLock lock(&mutex_);
    if (motion_) {
      if (!motion_->Step(robot_).ok() || motion_->done()) motion_.reset();
    } else {
      robot_.Drive(twist_).IgnoreError();  // one that is not finite: it stays as it was
    }
  }
  robot_.Advance(kStep_s).IgnoreError();  // kStep_s is a time
  const absl::MutexLock lock(&mutex_);
  report_.driven_m += Distance_m(last_pose_.position(), robot_.true_pose().position());
  last_pose_ = robot_.true_pose();
}

void PeerRobot::PublishTransforms() {
  const bool is_off = options_.slam_jump_s > 0.0 && robot_.elapsed_s() < options_.slam_jump_s;
  const Pose2 map_from_odom = is_off ? Compose(kSlamError, kMapFromOdom) : kMapFromOdom;
  const Pose2 odom_from_base = Compose(Inverse(kMapFromOdom), robot_.pose());
  ros::TfMessage now;
  now.transforms = {Between(HeaderOf("map"), "odom", map_from_odom),
                    Between(HeaderOf("odom"), "base_link", odom_from_base)};
  node_.Publish(tf_, now);
  ros::Odometry odometry;
  odometry.header = HeaderOf("odom");
  odometry.child_frame_id = "base_link";
  odometry.pose = client::FromPlanar(odom_from_base);
  node_.Publish(odometry_, odometry);
}

void PeerRobot::PublishScan() {
  const auto seen = robot_.TakeScan();
  if (!seen.ok()) return;
  ros::LaserScan scan;
  scan.header = HeaderOf("laser");
  scan.angle_min = static_cast<float>(seen->start_angle_rad - kLaserYaw_rad);
  scan.angle_increment = static_cast<float>(seen->angle_step_rad);
  scan.angle_max =
      scan.angle_min + scan.angle_increment * static_cast<float>(seen->ranges_m.size() - 1);
  scan.range_min = 0.05F;
  scan.range_max = static_cast<float>(seen->max_range_m);
  scan.ranges = seen->ranges_m;
  scan.ranges[0] = std::numeric_limits<float>::quiet_NaN();
  {
    const absl::MutexLock lock(&mutex_);
    scans_.emplace_back(ros::ToNanoseconds(scan.header.stamp), absl::GetCurrentTimeNanos());
    if (scans_.size() > kMostScans) scans_.pop_front();
  }
  node_.Publish(scan_, scan);
}

void PeerRobot::NoteLatency(std::int64_t asked_ns) {
  const auto newest = std::find_if(scans_.rbegin(), scans_.rend(),
                                   [asked_ns](const auto& scan) { return scan.first <= asked_ns; });
  if (newest == scans_.rend()) return;
  report_.latencies_s.push_back(static_cast<double>(absl::GetCurrentTimeNanos() - newest->second) *
                                1e-9);
}

void PeerRobot::PublishGas() {
  const auto reading = robot_.ReadGas();
  if (!reading.ok()) return;
  ros::GasSensor gas;
  gas.header = HeaderOf("gas_sensor");
  gas.raw = reading->concentration_ppm;
  gas.raw_units = ros::GasSensor::kPpm;
  node_.Publish(gas_, gas);
}

// One kind after the other, those of a topic far enough apart for each to be told of.
void PeerRobot::MakeMischief() {
  constexpr int kKinds = 6;
  constexpr std::uint8_t kAmpere = 2;
  static const std::string kNoScan = std::string("\0\1\0\0", 4) + "this is no scan!";
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  ros::GasSensor gas;
  gas.header = HeaderOf("gas_sensor");
  gas.header.stamp.nanosec += 1;
  gas.raw_units = ros::GasSensor::kPpm;
  ros::LaserScan scan;
  scan.header = HeaderOf("laser");
  scan.header.stamp.nanosec += 1;
  scan.angle_increment = 0.1F;
  scan.range_max = 8.0F;
  scan.ranges = {1.0F};
  ros::TfMessage odd;
  switch (steps_ / kStepsPerMischief % kKinds) {
    case 0:
      scan.angle_min = std::numeric_limits<float>::quiet_NaN();
      return node_.Publish(scan_, scan);
    case 1:
      gas.raw_units = kAmpere;
      return node_.Publish(gas_, gas);
    case 2:
      scan.header.stamp.sec -= 2;
      return node_.Publish(scan_, scan);
    case 3:
      odd.transforms = {Between(HeaderOf("dog"), "cat", {}), Between(HeaderOf("cat"), "dog", {})};
      node_.Publish(tf_, odd);
      gas.header.frame_id = "dog";
      return node_.Publish(gas_, gas);
    case 4:
      return node_.PublishBytes(scan_, kNoScan);
    default:
      odd.transforms = {Between(HeaderOf("map"), "ghost", {kNan, 0.0, 0.0})};
      return node_.Publish(tf_, odd);
  }
}

PeerReport PeerRobot::report() const {
  const absl::MutexLock lock(&mutex_);
  return report_;
}

}  // namespace plumescout::ros2_peer
