// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/types/gas_reading.h"
#include "core/types/pose2.h"

namespace plumescout::client {

// A gas reading with the time and the pose (frame map) it stands for.
struct GasSample {
  std::int64_t time_ns = 0;
  Pose2 pose;
  GasReading reading;
};

// The air between two readings of a sensor with a first-order lag, the later `elapsed_s` > 0 after
// the earlier: see LagCorrection. REQUIRES: time_constant_s > 0.
GasReading UndoLag(const GasReading& earlier, const GasReading& later, double elapsed_s,
                   double time_constant_s);

// Undoes the first-order lag of a gas sensor, dc/dt = (air - c) / tau. A robot that drives through
// a plume at 1.25 m/s with tau = 0.5 s otherwise smears every peak over 0.6 m of its way. Between
// two readings the solution is c2 = a c1 + (1 - a) air with a = exp(-dt / tau), where `air` is the
// concentration averaged over dt with the weight exp(-age / tau); so air = (c2 - a c1) / (1 - a),
// and it stands for the mean age tau - dt a / (1 - a), where the robot was a moment ago. The noise
// of independent readings grows by sqrt(1 + a^2) / (1 - a): 1.7 at dt = tau.
class LagCorrection {
 public:
  // 0: samples pass as they are.
  explicit LagCorrection(double time_constant_s) : time_constant_s_(time_constant_s) {}

  // Where the robot is between readings: the way is interpolated through these points.
  void NotePose(std::int64_t time_ns, const Pose2& pose);

  // The first reading passes as it is, and so does one that is not later than the one before.
  GasSample Correct(const GasSample& measured);

 private:
  struct PassedPose {
    std::int64_t time_ns;
    Pose2 pose;
  };
  Pose2 PoseAt(std::int64_t time_ns) const;

  double time_constant_s_;
  std::deque<PassedPose> way_;  // in order of time, no older than matters
  std::optional<GasSample> previous_;
};

}  // namespace plumescout::client
