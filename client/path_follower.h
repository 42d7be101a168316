// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "client/robot_driver.h"
#include "core/types/pose2.h"
#include "core/types/trajectory.h"

namespace plumescout::client {

struct FollowerOptions {
  double turn_gain_per_s = 3.0;         // turn rate over heading error, > 0
  double max_turn_rad_per_s = 2.0;      // > 0
  double max_forward_mps = 2.0;         // > 0; the plan's own speed is used up to this
  double stop_heading_error_rad = 0.5;  // turn on the spot from here on, > 0
  double arrival_tolerance_m = 0.1;     // a waypoint counts as reached within this, > 0
  double tick_s = 0.1;                  // a command is held for this long, > 0
};

// The path follower of [XIT] section VII: constant forward velocity, turn rate proportional to the
// heading error to the next waypoint. Ours: the forward velocity fades to zero as the heading error
// grows, so that sharp corners are turned on the spot and no waypoint is circled for ever; and it
// never overshoots a waypoint within one tick.
class PathFollower {
 public:
  PathFollower(const Trajectory& trajectory, const FollowerOptions& options);

  // The command for the next tick. Zero while a waypoint dwells and once done.
  Twist Step(const Pose2& pose, std::int64_t now_ns);

  bool done() const { return next_ >= trajectory_.waypoints.size(); }
  // Whether the last Step found the robot at a waypoint that dwells, or done.
  bool standing() const { return done() || dwell_until_ns_ > 0; }
  // What is left of the path: `from`, then the waypoints not yet reached.
  std::vector<Point2> PathAhead(Point2 from) const;

 private:
  void PassReachedWaypoints(const Pose2& pose, std::int64_t now_ns);
  bool Dwelling(std::int64_t now_ns) const { return now_ns < dwell_until_ns_; }
  double PlannedSpeed_mps() const;
  Twist Towards(Point2 target, const Pose2& pose) const;

  Trajectory trajectory_;
  FollowerOptions options_;
  std::size_t next_ = 0;  // index of the waypoint driven to
  std::int64_t dwell_until_ns_ = 0;
};

}  // namespace plumescout::client
