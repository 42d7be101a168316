// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/types/gas_reading.h"
#include "core/types/observation.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout::client {

// Velocity command in the robot's frame, held until the next one.
struct Twist {
  double forward_mps = 0.0;
  double turn_rad_per_s = 0.0;
};

// One robot's sensors, wheels and clock; the simulated robot and real ones implement it.
// Single-threaded: the robot loop calls everything.
class RobotDriver {
 public:
  virtual ~RobotDriver() = default;

  virtual std::int64_t now_ns() const = 0;  // robot clock, nanoseconds since the Unix epoch
  virtual Pose2 pose() const = 0;           // localised, in the frame that it registers with
  // kUnavailable: nothing new to say, ask again when the next reading is due.
  virtual absl::StatusOr<Scan> TakeScan() = 0;
  virtual absl::StatusOr<GasReading> ReadGas() = 0;
  // When and where the latest TakeScan or ReadGas was measured: here and now, unless a driver
  // hands on what it was told a moment ago.
  virtual std::int64_t sample_time_ns() const { return now_ns(); }
  virtual Pose2 sample_pose() const { return pose(); }

  // Poses that it gave before and that were wrong, known since the last call: after a loop closure
  // or a relocalisation. pose() and what is sensed from now on are right. Anchors are best of times
  // at which something was sensed. None: they are as they were.
  virtual std::optional<PoseCorrection> TakeCorrection() { return std::nullopt; }
  // What there is to tell of the robot itself; none: nothing new.
  virtual std::optional<RobotStatus> TakeStatus() { return std::nullopt; }

  virtual absl::Status Drive(const Twist& twist) = 0;
  // Ideal following: stand exactly here now. Simulated robots only; real ones return
  // kUnimplemented. kUnavailable: another robot is in the way, this one stays where it is.
  virtual absl::Status PlaceAt(const Pose2& pose) = 0;

  // Lets `duration_s` go by: a simulation steps its world, a real robot waits.
  virtual absl::Status Advance(double duration_s) = 0;
};

}  // namespace plumescout::client
