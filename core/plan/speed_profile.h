// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumescout {

// The quickest way to drive a length from rest to rest under bounds on speed and acceleration:
// speed up evenly, cruise, brake evenly (a trapezoid of speed over time), without the cruise if the
// length is too short for it (a triangle). Without a bound on acceleration it is all cruise.
class SpeedProfile {
 public:
  // REQUIRES: length_m >= 0, max_speed_mps > 0, acceleration_mps2 >= 0; acceleration 0: no bound.
  SpeedProfile(double length_m, double max_speed_mps, double acceleration_mps2);

  // Length of speeding up, and of braking; 0 without a bound.
  double ramp_m() const { return ramp_m_; }
  double duration_s() const { return TimeAt_s(length_m_); }
  // When `distance_m` are behind, and how fast then: 0 throughout without a bound on acceleration,
  // as waypoints have it (core/types/trajectory.h). REQUIRES: distance_m in [0, length].
  double TimeAt_s(double distance_m) const;
  double SpeedAt_mps(double distance_m) const;

 private:
  double length_m_;
  double peak_mps_;
  double acceleration_mps2_;
  double ramp_m_ = 0.0;
};

}  // namespace plumescout
