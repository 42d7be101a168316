// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// The messages of ROS 2 in which robots say what they sense, with the names and the order of their
// fields on the wire. kType is the name that ROS gives them.
namespace plumescout::ros {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  static void Visit(auto& archive, auto& m) { archive(m.sec, m.nanosec); }
};

inline std::int64_t ToNanoseconds(const Time& time) {
  return std::int64_t{time.sec} * 1'000'000'000 + time.nanosec;
}
// REQUIRES: time_ns >= 0.
inline Time ToTime(std::int64_t time_ns) {
  return {static_cast<std::int32_t>(time_ns / 1'000'000'000),
          static_cast<std::uint32_t>(time_ns % 1'000'000'000)};
}

struct Header {
  Time stamp = {};
  std::string frame_id = {};
  static void Visit(auto& archive, auto& m) { archive(m.stamp, m.frame_id); }
};

struct Vector3 {  // and Point
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  static void Visit(auto& archive, auto& m) { archive(m.x, m.y, m.z); }
};

struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;
  static void Visit(auto& archive, auto& m) { archive(m.x, m.y, m.z, m.w); }
};

struct Pose {  // and Transform
  Vector3 position = {};
  Quaternion orientation = {};
  static void Visit(auto& archive, auto& m) { archive(m.position, m.orientation); }
};

struct Twist {
  static constexpr char kType[] = "geometry_msgs/msg/Twist";
  Vector3 linear = {};
  Vector3 angular = {};
  static void Visit(auto& archive, auto& m) { archive(m.linear, m.angular); }
};

struct TransformStamped {
  Header header = {};
  std::string child_frame_id = {};
  Pose transform = {};
  static void Visit(auto& archive, auto& m) { archive(m.header, m.child_frame_id, m.transform); }
};

struct TfMessage {
  static constexpr char kType[] = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms = {};
  static void Visit(auto& archive, auto& m) { archive(m.transforms); }
};

struct LaserScan {
  static constexpr char kType[] = "sensor_msgs/msg/LaserScan";
  Header header = {};
  float angle_min = 0.0F;
  float angle_max = 0.0F;
  float angle_increment = 0.0F;
  float time_increment = 0.0F;
  float scan_time = 0.0F;
  float range_min = 0.0F;
  float range_max = 0.0F;
  std::vector<float> ranges = {};
  std::vector<float> intensities = {};
  static void Visit(auto& archive, auto& m) {
    archive(m.header, m.angle_min, m.angle_max, m.angle_increment, m.time_increment, m.scan_time,
            m.range_min, m.range_max, m.ranges, m.intensities);
  }
};

struct Odometry {
  static constexpr char kType[] = "nav_msgs/msg/Odometry";
  Header header = {};
  std::string child_frame_id = {};
  Pose pose = {};
  std::array<double, 36> pose_covariance{};
  Twist twist = {};
  std::array<double, 36> twist_covariance{};
  static void Visit(auto& archive, auto& m) {
    archive(m.header, m.child_frame_id, m.pose, m.pose_covariance, m.twist, m.twist_covariance);
  }
};

struct GasSensor {
  static constexpr char kType[] = "olfaction_msgs/msg/GasSensor";
  static constexpr std::uint8_t kVolt = 1;
  static constexpr std::uint8_t kPpm = 3;
  static constexpr std::uint8_t kPpb = 4;
  static constexpr std::uint8_t kOhm = 5;
  Header header = {};
  std::uint8_t technology = 0;
  std::uint8_t manufacturer = 0;
  std::uint8_t mpn = 0;
  double raw = 0.0;
  std::uint8_t raw_units = 0;
  double raw_air = 0.0;
  double calib_a = 0.0;
  double calib_b = 0.0;
  static void Visit(auto& archive, auto& m) {
    archive(m.header, m.technology, m.manufacturer, m.mpn, m.raw, m.raw_units, m.raw_air, m.calib_a,
            m.calib_b);
  }
};

struct Anemometer {
  static constexpr char kType[] = "olfaction_msgs/msg/Anemometer";
  Header header = {};
  std::string sensor_label = {};
  float wind_speed = 0.0F;
  float wind_direction = 0.0F;
  static void Visit(auto& archive, auto& m) {
    archive(m.header, m.sensor_label, m.wind_speed, m.wind_direction);
  }
};

}  // namespace plumescout::ros
