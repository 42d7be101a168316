// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "absl/status/status.h"
#include "client/path_follower.h"
#include "client/robot_driver.h"
#include "core/types/pose2.h"
#include "core/types/trajectory.h"

namespace plumescout::client {

enum class Following {
  kProportional,  // [XIT] section VII: wheels are steered
  kIdeal,         // the robot stands exactly on the trajectory; simulated robots only
  kByOthers,      // somebody else drives it there, by a way of their own
};

// One trajectory being followed by a robot, tick by tick.
class Motion {
 public:
  virtual ~Motion() = default;

  // Moves or steers the robot for the present instant of its clock.
  virtual absl::Status Step(RobotDriver& driver) = 0;
  // Whether the end is reached, dwell included; true at the earliest after a Step.
  virtual bool done() const = 0;
  // Whether the robot stands at a waypoint since the last Step, or at the end.
  virtual bool standing() const = 0;
  // What is left of the path, beginning at the robot.
  virtual std::vector<Point2> PathAhead(const Pose2& pose) const = 0;
};

// Of the legs of a path.
double LengthOf_m(const std::vector<Point2>& path);

// Departs now. REQUIRES: waypoints not empty.
std::unique_ptr<Motion> StartMotion(Following following, const Trajectory& trajectory,
                                    const FollowerOptions& options, std::int64_t departure_ns);

}  // namespace plumescout::client
