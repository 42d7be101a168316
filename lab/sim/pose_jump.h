// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "absl/status/status.h"
#include "core/types/observation.h"
#include "core/types/pose2.h"

namespace plumescout::lab {

// A localisation that loses its place: at one moment the robot holds itself to be elsewhere, turned
// about where it stands, and goes on from there, until it finds out, if it ever does.
struct PoseJumpOptions {
  double at_s = 0.0;                                       // of the robot's time, [0, 1e6]
  double east_m = 0.0;                                     // [-100, 100]
  double north_m = 0.0;                                    // [-100, 100]
  double turn_rad = 0.0;                                   // [-3.2, 3.2]
  std::optional<double> corrected_after_s = std::nullopt;  // [0, 1e6]; none: never

  friend bool operator==(const PoseJumpOptions&, const PoseJumpOptions&) = default;
};

// kInvalidArgument naming field, value and range.
absl::Status Validate(const PoseJumpOptions& options);

// What it makes of the poses that a robot would give without it.
class PoseJump {
 public:
  explicit PoseJump(const std::optional<PoseJumpOptions>& options) : options_(options) {}

  // It is `elapsed_s` after the start, `now_ns` by the robot's clock. Times do not fall.
  void Pass(double elapsed_s, std::int64_t now_ns, const Pose2& held);

  Pose2 Told(const Pose2& held) const { return jumped_ ? Compose(*jumped_, held) : held; }
  Pose2 Held(const Pose2& told) const { return jumped_ ? Compose(Inverse(*jumped_), told) : told; }
  // Once, when the robot finds out: where it was just before, just after, and is.
  std::optional<PoseCorrection> TakeCorrection();

 private:
  std::optional<PoseJumpOptions> options_;
  std::optional<Pose2> jumped_;  // told poses from those held without it
  bool over_ = false;
  std::optional<PoseAnchor> before_;
  std::optional<PoseAnchor> after_;
  std::optional<PoseCorrection> correction_;
};

}  // namespace plumescout::lab
