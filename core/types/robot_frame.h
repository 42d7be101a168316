// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "absl/status/status.h"
#include "core/types/checker.h"
#include "core/types/pose2.h"

namespace plumescout {

// Where the frame that a robot reports its poses in lies in the mission's frame `map`, and how well
// that is known.
struct RobotFrame {
  Pose2 mission_from_robot;  // of its origin, in frame map
  double position_stddev_m = 0.0;
  double heading_stddev_rad = 0.0;

  friend bool operator==(const RobotFrame&, const RobotFrame&) = default;
};

// Poses from one of the two frames to the other; the same to the bit if the frames are the same.
inline Pose2 InMission(const RobotFrame& frame, const Pose2& in_robot) {
  if (frame.mission_from_robot == Pose2{}) return in_robot;
  return Compose(frame.mission_from_robot, in_robot);
}
inline Pose2 InRobot(const RobotFrame& frame, const Pose2& in_mission) {
  if (frame.mission_from_robot == Pose2{}) return in_mission;
  return Compose(Inverse(frame.mission_from_robot), in_mission);
}

// kInvalidArgument naming field and value: places up to `limit_m` from the origin, headings up to
// 1000 rad, standard deviations up to 10 m and half a turn.
inline absl::Status Validate(const RobotFrame& frame, double limit_m) {
  constexpr double kMostYaw_rad = 1000.0;
  constexpr double kMostStddev_m = 10.0;
  return Checker()
      .InRange("frame.mission_from_robot.x_m", frame.mission_from_robot.x_m, -limit_m, limit_m)
      .InRange("frame.mission_from_robot.y_m", frame.mission_from_robot.y_m, -limit_m, limit_m)
      .InRange("frame.mission_from_robot.yaw_rad", frame.mission_from_robot.yaw_rad, -kMostYaw_rad,
               kMostYaw_rad)
      .InRange("frame.position_stddev_m", frame.position_stddev_m, 0.0, kMostStddev_m)
      .InRange("frame.heading_stddev_rad", frame.heading_stddev_rad, 0.0, M_PI)
      .status();
}

}  // namespace plumescout
