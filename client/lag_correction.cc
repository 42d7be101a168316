// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/lag_correction.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace plumescout::client {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;
// The mean age of what a reading says never exceeds one time constant.
constexpr double kRememberedTimeConstants = 2.0;

Pose2 Between(const Pose2& from, const Pose2& to, double share) {
  return {std::lerp(from.x_m, to.x_m, share), std::lerp(from.y_m, to.y_m, share),
          WrapAngle_rad(from.yaw_rad + share * WrapAngle_rad(to.yaw_rad - from.yaw_rad))};
}

}  // namespace

GasReading UndoLag(const GasReading& earlier, const GasReading& later, double elapsed_s,
                   double time_constant_s) {
  const double kept = std::exp(-elapsed_s / time_constant_s);
  const double gained = -std::expm1(-elapsed_s / time_constant_s);
  const double air_ppm = (later.concentration_ppm - kept * earlier.concentration_ppm) / gained;
  return {.concentration_ppm = std::max(0.0, air_ppm),
          .variance_ppm2 = later.variance_ppm2 * (1.0 + kept * kept) / (gained * gained)};
}

void LagCorrection::NotePose(std::int64_t time_ns, const Pose2& pose) {
  if (time_constant_s_ == 0.0) return;
  if (!way_.empty() && time_ns < way_.back().time_ns) way_.clear();  // the clock was set back
  way_.push_back({time_ns, pose});
  const auto oldest_ns =
      time_ns - std::llround(kRememberedTimeConstants * time_constant_s_ * kNanosecondsPerSecond);
  while (way_.size() > 2 && way_[1].time_ns <= oldest_ns) way_.pop_front();
}

GasSample LagCorrection::Correct(const GasSample& measured) {
  if (time_constant_s_ == 0.0) return measured;
  const auto previous = std::exchange(previous_, measured);
  if (!previous || measured.time_ns <= previous->time_ns) return measured;
  const double elapsed_s =
      static_cast<double>(measured.time_ns - previous->time_ns) / kNanosecondsPerSecond;
  const double kept = std::exp(-elapsed_s / time_constant_s_);
  const double gained = -std::expm1(-elapsed_s / time_constant_s_);
  const double age_s = time_constant_s_ - elapsed_s * kept / gained;
  GasSample air = measured;
  air.time_ns -= std::llround(age_s * kNanosecondsPerSecond);
  if (!way_.empty()) air.pose = PoseAt(air.time_ns);
  air.reading = UndoLag(previous->reading, measured.reading, elapsed_s, time_constant_s_);
  return air;
}

Pose2 LagCorrection::PoseAt(std::int64_t time_ns) const {
  const auto after = std::find_if(way_.begin(), way_.end(),
                                  [&](const PassedPose& w) { return w.time_ns >= time_ns; });
  if (after == way_.begin()) return way_.front().pose;
  if (after == way_.end()) return way_.back().pose;
  const auto before = std::prev(after);
  const double share = static_cast<double>(time_ns - before->time_ns) /
                       static_cast<double>(after->time_ns - before->time_ns);
  return Between(before->pose, after->pose, share);
}

}  // namespace plumescout::client
