// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "absl/status/status.h"
#include "core/types/pose2.h"
#include "core/types/rng.h"
#include "lab/sim/pose_jump.h"

namespace plumescout::lab {

// How far localisation is off: fresh noise at every instant, and drift, a random walk whose
// standard deviation grows with the square root of time until a loop is closed. 0: exact.
struct PoseErrorOptions {
  double position_sigma_m = 0.0;      // of each coordinate, [0, 10]
  double yaw_sigma_rad = 0.0;         // [0, 3.2]
  double drift_m_per_sqrt_s = 0.0;    // of each coordinate, [0, 10]
  double drift_rad_per_sqrt_s = 0.0;  // [0, 3.2]
  // The drift is taken back every so many seconds, [1, 3600], with a correction of the way since
  // the last time; none: never. See LoopClosure.
  std::optional<double> closed_every_s = std::nullopt;
  // On top of these, see PoseJump; not with closures.
  std::optional<PoseJumpOptions> jump = std::nullopt;

  friend bool operator==(const PoseErrorOptions&, const PoseErrorOptions&) = default;
};

// kInvalidArgument naming field, value and range.
absl::Status Validate(const PoseErrorOptions& options);

// Told pose = true pose + drift + noise, coordinate by coordinate.
class PoseError {
 public:
  // REQUIRES: valid options.
  PoseError(const PoseErrorOptions& options, std::uint64_t seed);

  // `duration_s` goes by: drift grows, noise is drawn anew. Without drift or noise nothing is.
  void Advance(double duration_s);

  // A loop is closed: there is no drift so far.
  void Close() { drift_ = {}; }

  // What the robot holds its true pose for.
  Pose2 Told(const Pose2& truth) const;
  // Where a robot is that has steered itself to where it holds itself to be at `told`: drift
  // misleads it; noise, new at every instant, does not.
  Pose2 TrueFor(const Pose2& told) const;

 private:
  void DrawNoise();

  PoseErrorOptions options_;
  Rng rng_;
  Pose2 drift_;
  Pose2 noise_;
};

}  // namespace plumescout::lab
