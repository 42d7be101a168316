// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/way_readings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/gas/ageing.h"
#include "core/grid/ray.h"

namespace plumescout {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;
// By how much the air changes along 0.1 m, as share of the level.
constexpr double kStepShare = 0.3;
constexpr double kStep_m = 0.1;
// Past a sensor that stands air drifts about as fast.
constexpr double kDrift_mps = 0.5;
// Of what a sensor shows, beside its noise: gains are known to a few percent, gusts are short.
constexpr double kGainStddev = 0.05;

// Of a part of the way: less is rounding at the edge of a cell.
constexpr double kNoShare = 1e-9;

double Seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return (static_cast<double>(to_ns) - static_cast<double>(from_ns)) / kNanosecondsPerSecond;
}

double Square(double value) { return value * value; }

Pose2 Between(const Pose2& from, const Pose2& to, double share) {
  return {std::lerp(from.x_m, to.x_m, share), std::lerp(from.y_m, to.y_m, share),
          WrapAngle_rad(from.yaw_rad + share * WrapAngle_rad(to.yaw_rad - from.yaw_rad))};
}

}  // namespace

void WayReadings::NotePose(std::int64_t time_ns, const Pose2& pose) {
  if (points_.empty() || points_.size() >= kMostPoints || time_ns <= points_.back().time_ns) return;
  points_.push_back({time_ns, pose});
}

std::vector<AirReading> WayReadings::Add(const WayModel& model, std::int64_t time_ns,
                                         const Pose2& pose, const GasReading& reading) {
  const double variance = Ageing(model.gas).InitialVariance_ppm2(reading);
  const double deviation_ppm = reading.concentration_ppm - model.gas.background_mean_ppm;
  const double level_ppm =
      std::max(std::abs(deviation_ppm), std::abs(latest_deviation_ppm_)) + std::sqrt(variance);
  const double heard_variance = variance + Square(kGainStddev * deviation_ppm);
  Interval interval;
  interval.spans = SpansTo({time_ns, pose}, model);
  interval.variance = variance;
  std::vector<AirReading> told;
  if (interval.spans.empty() || interval.spans.size() > kMostSpans) {
    told = Finish(model);
    told.push_back({time_ns, pose, {reading.concentration_ppm, variance}});
    state_ = {{deviation_ppm, deviation_ppm}, heard_variance, 0.0, Square(level_ppm)};
  } else {
    for (Span& span : interval.spans) {
      const double way_m = span.way_m + kDrift_mps * span.stay_s;
      Predict(model.response_time_s, Square(kStepShare * level_ppm) * way_m / kStep_m, span);
    }
    Hear(deviation_ppm, heard_variance, interval);
    if (untold_) {
      std::vector<double> air;
      Smooth(Smooth({}, interval, nullptr), *untold_, &air);
      told = Told(*untold_, air, model.gas.background_mean_ppm);
    }
    untold_ = std::move(interval);
  }
  latest_deviation_ppm_ = deviation_ppm;
  points_.assign(1, {time_ns, pose});
  return told;
}

std::vector<AirReading> WayReadings::Untold(const WayModel& model) const {
  if (!untold_) return {};
  std::vector<double> air;
  Smooth({}, *untold_, &air);
  return Told(*untold_, air, model.gas.background_mean_ppm);
}

std::vector<AirReading> WayReadings::Finish(const WayModel& model) {
  std::vector<AirReading> untold = Untold(model);
  points_.clear();
  untold_.reset();
  return untold;
}

// The stays in cells since the latest reading, those that follow each other in one cell as one;
// none if that cannot be told.
std::vector<WayReadings::Span> WayReadings::SpansTo(const Point& end, const WayModel& model) const {
  if (points_.empty()) return {};
  const double elapsed_s = Seconds(points_.front().time_ns, end.time_ns);
  if (!(elapsed_s > 0.0) || elapsed_s > kMostGap * model.response_time_s) return {};
  const GridGeometry cells{0.0, 0.0, model.resolution_m, 0, 0};
  std::vector<Span> spans;
  std::optional<Cell> latest;
  for (std::size_t i = 0; i < points_.size() && points_[i].time_ns < end.time_ns; ++i) {
    const Point& from = points_[i];
    const bool is_last = i + 1 == points_.size() || points_[i + 1].time_ns >= end.time_ns;
    const Point& to = is_last ? end : points_[i + 1];
    const Point2 from_place = PlaceOnRobot(from.pose, model.robot_from_sensor);
    const Point2 to_place = PlaceOnRobot(to.pose, model.robot_from_sensor);
    const double length_m = Distance_m(from_place, to_place);
    const double whole_s = Seconds(from.time_ns, to.time_ns);
    if (length_m > kMostSpeed_mps * whole_s) return {};
    double begin = 0.0;  // share of this part of the way
    const bool all = WalkSegment(cells, from_place, to_place, [&](Cell cell, double length_cells) {
      const double share = length_m > 0.0 ? length_cells * model.resolution_m / length_m : 1.0;
      if (share <= kNoShare) return true;
      if (latest != cell) {
        if (spans.size() > kMostSpans) return false;
        const double middle = std::min(1.0, begin + share / 2.0);
        spans.emplace_back().middle = {
            from.time_ns + std::llround(middle * whole_s * kNanosecondsPerSecond),
            Between(from.pose, to.pose, middle)};
        latest = cell;
      }
      spans.back().stay_s += share * whole_s;
      spans.back().way_m += share * length_m;
      begin += share;
      return true;
    });
    if (!all) break;
  }
  return spans;
}

void WayReadings::Predict(double response_time_s, double step_variance, Span& span) {
  const double kept = std::exp(-span.stay_s / response_time_s);
  const double gained = 1.0 - kept;
  State& b = state_;
  const double air = b.air + step_variance;
  const double both = kept * b.both + gained * air;
  b.sensor = kept * kept * b.sensor + 2.0 * kept * gained * b.both + gained * gained * air;
  b.both = both;
  b.air = air;
  b.mean[0] = kept * b.mean[0] + gained * b.mean[1];
  span.kept = kept;
  span.predicted = b;
}

void WayReadings::Hear(double deviation, double variance, Interval& interval) {
  State& b = state_;
  const double total = b.sensor + variance;
  const double surprise = deviation - b.mean[0];
  interval.gain = {b.sensor / total, b.both / total};
  interval.surprise = surprise / total;
  b.mean[0] += interval.gain[0] * surprise;
  b.mean[1] += interval.gain[1] * surprise;
  b.air = std::max(0.0, b.air - interval.gain[1] * b.both);
  b.both *= variance / total;
  b.sensor *= variance / total;
}

// Backward by Bryson and Frazier: `adjoint` tells what later readings say of the state after the
// interval's reading; returns the same of the state before its first span. `air`, by span, may be
// null.
WayReadings::Pair WayReadings::Smooth(Pair adjoint, const Interval& interval,
                                      std::vector<double>* air) {
  adjoint[0] += interval.surprise - interval.gain[0] * adjoint[0] - interval.gain[1] * adjoint[1];
  if (air != nullptr) air->resize(interval.spans.size());
  for (std::size_t i = interval.spans.size(); i-- > 0;) {
    const Span& span = interval.spans[i];
    if (air != nullptr) (*air)[i] = span.predicted.mean[1] + span.predicted.Times(adjoint)[1];
    adjoint = {span.kept * adjoint[0], (1.0 - span.kept) * adjoint[0] + adjoint[1]};
  }
  return adjoint;
}

std::vector<AirReading> WayReadings::Told(const Interval& interval, const std::vector<double>& air,
                                          double background_mean_ppm) {
  double whole_s = 0.0;
  for (const Span& span : interval.spans) whole_s += span.stay_s;
  std::vector<AirReading> told;
  for (std::size_t i = 0; i < interval.spans.size(); ++i) {
    const Span& span = interval.spans[i];
    if (!(span.stay_s > 0.0)) continue;
    const double concentration_ppm = std::max(0.0, background_mean_ppm + air[i]);
    told.push_back({span.middle.time_ns,
                    span.middle.pose,
                    {concentration_ppm, interval.variance * whole_s / span.stay_s},
                    !told.empty()});
  }
  return told;
}

bool WayReadings::IsWhole() const {
  const auto is_finite = [](auto... numbers) { return (std::isfinite(numbers) && ...); };
  const auto is_variance = [&](double value) { return is_finite(value) && value >= 0.0; };
  const auto is_point = [&](const Point& point) {
    return is_finite(point.pose.x_m, point.pose.y_m, point.pose.yaw_rad);
  };
  const auto is_state = [&](const State& state) {
    return is_finite(state.mean[0], state.mean[1], state.both) && is_variance(state.sensor) &&
           is_variance(state.air);
  };
  const auto is_span = [&](const Span& span) {
    return is_point(span.middle) && is_finite(span.stay_s, span.way_m) && span.stay_s >= 0.0 &&
           span.way_m >= 0.0 && span.kept >= 0.0 && span.kept <= 1.0 && is_state(span.predicted);
  };
  const auto is_later = [](const Point& a, const Point& b) { return a.time_ns >= b.time_ns; };
  return points_.size() <= kMostPoints && std::all_of(points_.begin(), points_.end(), is_point) &&
         std::adjacent_find(points_.begin(), points_.end(), is_later) == points_.end() &&
         is_finite(latest_deviation_ppm_) && is_state(state_) &&
         (!untold_ || (untold_->spans.size() <= kMostSpans &&
                       std::all_of(untold_->spans.begin(), untold_->spans.end(), is_span) &&
                       is_finite(untold_->surprise, untold_->gain[0], untold_->gain[1]) &&
                       is_variance(untold_->variance)));
}

}  // namespace plumescout
