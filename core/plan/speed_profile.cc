// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/speed_profile.h"

#include <algorithm>
#include <cmath>

namespace plumescout {

SpeedProfile::SpeedProfile(double length_m, double max_speed_mps, double acceleration_mps2)
    : length_m_(length_m), peak_mps_(max_speed_mps), acceleration_mps2_(acceleration_mps2) {
  if (acceleration_mps2 == 0.0) return;
  ramp_m_ = std::min(max_speed_mps * max_speed_mps / (2.0 * acceleration_mps2), length_m / 2.0);
  peak_mps_ = std::sqrt(2.0 * acceleration_mps2 * ramp_m_);
}

double SpeedProfile::TimeAt_s(double distance_m) const {
  if (acceleration_mps2_ == 0.0) return distance_m / peak_mps_;
  const double ramp_s = peak_mps_ / acceleration_mps2_;
  if (distance_m <= ramp_m_) return std::sqrt(2.0 * distance_m / acceleration_mps2_);
  const double cruise_m = length_m_ - 2.0 * ramp_m_;
  if (distance_m <= length_m_ - ramp_m_) return ramp_s + (distance_m - ramp_m_) / peak_mps_;
  const double left_m = std::max(length_m_ - distance_m, 0.0);
  return 2.0 * ramp_s + cruise_m / peak_mps_ - std::sqrt(2.0 * left_m / acceleration_mps2_);
}

double SpeedProfile::SpeedAt_mps(double distance_m) const {
  const double from_rest_m = std::max(std::min(distance_m, length_m_ - distance_m), 0.0);
  return std::min(peak_mps_, std::sqrt(2.0 * acceleration_mps2_ * from_rest_m));
}

}  // namespace plumescout
