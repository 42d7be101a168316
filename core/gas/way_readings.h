// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/gas_reading.h"
#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

// What a sensor's readings say of the air in one cell that it passed, or stood in.
struct AirReading {
  std::int64_t time_ns = 0;  // in the middle of its stay there
  Pose2 pose;                // of the robot then
  GasReading reading;        // with its variance
  bool is_part = false;      // of a reading of which another part was told before

  friend bool operator==(const AirReading&, const AirReading&) = default;
};

// A sensor with a first-order lag, and the mission that its readings are for.
struct WayModel {
  double response_time_s = 0.0;  // tau, > 0
  Point2 robot_from_sensor;
  double resolution_m = 0.1;  // cells have their edges on whole multiples of it
  GasOptions gas;
};

// Readings of a sensor with a first-order lag, dc/dt = (air - c) / tau, as readings of the single
// cells that it has passed. A robot that drives at 1.25 m/s with tau = 0.5 s otherwise smears every
// peak over 0.6 m of its way. The state is what the sensor shows, c, and the air around it, x,
// which along the way changes at random, by a share of the level that is read:
//
//   x' = x + w,  c' = a c + (1 - a) x',  a = exp(-stay / tau)   from one cell to the next,
//   z = c + noise                                               at a reading.
//
// A reading is the air of all cells before it, weighted by the response of the sensor; this is its
// exact inverse for that prior, a Kalman filter, smoothed over the two latest intervals between
// readings. So what a cell's air was is told one reading later. All readings of one interval
// together are as precise as the one reading that ends it; each has the share of its stay.
// Thread-compatible.
class WayReadings {
 public:
  // Where the robot is between readings: the way is interpolated through these points. One that is
  // not later than those before is passed over.
  void NotePose(std::int64_t time_ns, const Pose2& pose);

  // Takes a reading as the sensor shows it, and returns what it was that is known now. The first
  // one passes as it is; so does one after which there is no telling what was in between: not later
  // than the one before, later by more than kMostGap response times, beyond more than kMostSpans
  // cells, or after a jump. Cost: O(cells since the last reading but one).
  std::vector<AirReading> Add(const WayModel& model, std::int64_t time_ns, const Pose2& pose,
                              const GasReading& reading);

  // All that is not told yet.
  std::vector<AirReading> Untold(const WayModel& model) const;
  // The same. The next reading is then a first one.
  std::vector<AirReading> Finish(const WayModel& model);

  static constexpr double kMostGap = 8.0;  // exp(-8) of a reading is older: 0.03 %
  static constexpr std::size_t kMostSpans = 256;
  static constexpr double kMostSpeed_mps = 20.0;   // what is faster has not driven
  static constexpr std::size_t kMostPoints = 256;  // between two readings

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  bool IsWhole() const;  // of what was read

  struct Point {
    std::int64_t time_ns = 0;
    Pose2 pose;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  using Pair = std::array<double, 2>;  // of the sensor, of the air

  struct State {
    Pair mean{};
    double sensor = 0.0;  // variances, >= 0
    double both = 0.0;    // covariance
    double air = 0.0;

    Pair Times(const Pair& v) const {
      return {sensor * v[0] + both * v[1], both * v[0] + air * v[1]};
    }
    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  // A stay in one cell, and what was believed at its end before the next reading.
  struct Span {
    Point middle;
    double stay_s = 0.0;
    double way_m = 0.0;
    double kept = 0.0;  // a
    State predicted;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  // All since the reading before, and the reading that ends it.
  struct Interval {
    std::vector<Span> spans;
    double surprise = 0.0;  // (z - c) / variance of that
    Pair gain{};
    double variance = 0.0;  // of the reading

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };

  std::vector<Span> SpansTo(const Point& end, const WayModel& model) const;
  void Predict(double response_time_s, double step_variance, Span& span);
  void Hear(double deviation, double variance, Interval& interval);
  static Pair Smooth(Pair adjoint, const Interval& interval, std::vector<double>* air);
  static std::vector<AirReading> Told(const Interval& interval, const std::vector<double>& air,
                                      double background_mean_ppm);

  std::vector<Point> points_;  // since the latest reading, of which the first is; none: no reading
  double latest_deviation_ppm_ = 0.0;
  State state_;                     // after it
  std::optional<Interval> untold_;  // that it ended
};

}  // namespace plumescout
