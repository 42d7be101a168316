// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/trajectory_timing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/plan/speed_profile.h"

namespace plumescout {
namespace {

// Less than this is no bend: rounding of vertices on one line, 1 mm in 1 km.
constexpr double kStraight_rad = 1e-6;

double Heading_rad(Point2 from, Point2 to) {
  return WrapAngle_rad(std::atan2(to.y_m - from.y_m, to.x_m - from.x_m));
}

double Turn_rad(double from_rad, double to_rad) {
  return std::abs(WrapAngle_rad(to_rad - from_rad));
}

std::vector<Point2> WithoutRepeats(std::vector<Point2> path) {
  path.erase(std::unique(path.begin(), path.end()), path.end());
  return path;
}

// Writes waypoints one after the other.
class Timer {
 public:
  Timer(const Pose2& start, const PlanningOptions& options) : options_(options) {
    trajectory_.waypoints.push_back({start});
  }

  void TurnTo(double heading_rad) {
    Waypoint& last = trajectory_.waypoints.back();
    const double turn_rad = Turn_rad(last.pose.yaw_rad, heading_rad);
    if (options_.max_turn_rate_rad_per_s == 0.0 || turn_rad <= kStraight_rad) {
      last.pose.yaw_rad = heading_rad;
      return;
    }
    Waypoint turned = {{last.pose.x_m, last.pose.y_m, heading_rad}};
    turned.arrival_time_s = Departure_s() + turn_rad / options_.max_turn_rate_rad_per_s;
    trajectory_.waypoints.push_back(turned);
  }

  void Dwell() { trajectory_.waypoints.back().dwell_s = options_.dwell_s; }

  // From rest at points[0] to rest at the last, the ones between in passing.
  void Drive(std::span<const Point2> points) {
    double length_m = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i)
      length_m += Distance_m(points[i - 1], points[i]);
    const SpeedProfile profile(length_m, options_.speed_mps, options_.max_acceleration_mps2);
    const double departure_s = Departure_s();
    double before_m = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      DriveLeg({points[i - 1], points[i], before_m, length_m}, profile, departure_s);
      before_m += Distance_m(points[i - 1], points[i]);
    }
    trajectory_.waypoints.back().speed_mps = 0.0;  // whatever rounding left
    trajectory_.length_m += length_m;
  }

  Trajectory Finish() && {
    trajectory_.duration_s = Departure_s();
    return std::move(trajectory_);
  }

 private:
  struct Leg {
    Point2 from;
    Point2 to;
    double before_m;      // of the run, already driven
    double run_length_m;  // of the whole run
  };

  double Departure_s() const {
    const Waypoint& last = trajectory_.waypoints.back();
    return last.arrival_time_s + last.dwell_s;
  }

  void DriveLeg(const Leg& leg, const SpeedProfile& profile, double departure_s) {
    const double leg_m = Distance_m(leg.from, leg.to);
    const double heading_rad = Heading_rad(leg.from, leg.to);
    trajectory_.waypoints.back().pose.yaw_rad = heading_rad;
    const auto pass = [&](Point2 at, double distance_m) {
      trajectory_.waypoints.push_back({{at.x_m, at.y_m, heading_rad},
                                       departure_s + profile.TimeAt_s(distance_m),
                                       0.0,
                                       profile.SpeedAt_mps(distance_m)});
    };
    double last_m = leg.before_m;
    for (const double corner_m : {profile.ramp_m(), leg.run_length_m - profile.ramp_m()}) {
      if (!(corner_m > last_m && corner_m < leg.before_m + leg_m)) continue;
      const double share = (corner_m - leg.before_m) / leg_m;
      pass({std::lerp(leg.from.x_m, leg.to.x_m, share), std::lerp(leg.from.y_m, leg.to.y_m, share)},
           corner_m);
      last_m = corner_m;
    }
    pass(leg.to, leg.before_m + leg_m);
  }

  const PlanningOptions& options_;
  Trajectory trajectory_;
};

// Vertices of a path, each once where it repeats, and which of them the robot dwells at.
struct Itinerary {
  std::vector<Point2> points;
  std::vector<bool> dwells;
};

// At every vertex but the first.
Itinerary DwellingEverywhere(const std::vector<Point2>& path) {
  Itinerary itinerary{WithoutRepeats(path), {}};
  itinerary.dwells.assign(itinerary.points.size(), true);
  itinerary.dwells.front() = false;
  return itinerary;
}

Itinerary DwellingAt(const std::vector<Point2>& stops, const std::vector<Point2>& path) {
  Itinerary itinerary{WithoutRepeats(path), {}};
  auto next = stops.begin();
  for (const Point2 point : itinerary.points) {
    const bool dwells = next != stops.end() && *next == point;
    itinerary.dwells.push_back(dwells);
    if (dwells) ++next;
  }
  return itinerary;
}

// The last point of the run that starts at points[first]: the next at which the robot has to stop.
// Where speed may jump it does so at every vertex, and arrival times add up leg by leg.
std::size_t EndOfRun(const Itinerary& itinerary, std::size_t first,
                     const PlanningOptions& options) {
  const std::vector<Point2>& points = itinerary.points;
  const auto dwells = [&](std::size_t i) { return options.dwell_s > 0.0 && itinerary.dwells[i]; };
  std::size_t last = first + 1;
  if (options.max_acceleration_mps2 == 0.0) return last;
  const double heading_rad = Heading_rad(points[first], points[last]);
  while (!dwells(last) && last + 1 < points.size() &&
         Turn_rad(heading_rad, Heading_rad(points[last], points[last + 1])) <= kStraight_rad) {
    ++last;
  }
  return last;
}

Trajectory TimeItinerary(const Itinerary& itinerary, double start_yaw_rad,
                         const PlanningOptions& options) {
  const std::vector<Point2>& points = itinerary.points;
  Timer timer({points.front().x_m, points.front().y_m, start_yaw_rad}, options);
  if (itinerary.dwells.front()) timer.Dwell();
  for (std::size_t first = 0; first + 1 < points.size();) {
    const std::size_t last = EndOfRun(itinerary, first, options);
    timer.TurnTo(Heading_rad(points[first], points[first + 1]));
    timer.Drive({points.data() + first, last - first + 1});
    if (itinerary.dwells[last]) timer.Dwell();
    first = last;
  }
  return std::move(timer).Finish();
}

}  // namespace

Trajectory TimeTrajectory(const std::vector<Point2>& path, double start_yaw_rad,
                          const PlanningOptions& options) {
  if (path.empty()) return {};
  return TimeItinerary(DwellingEverywhere(path), start_yaw_rad, options);
}

Trajectory TimeTrajectory(const std::vector<Point2>& path, const std::vector<Point2>& stops,
                          double start_yaw_rad, const PlanningOptions& options) {
  if (path.empty()) return {};
  return TimeItinerary(DwellingAt(stops, path), start_yaw_rad, options);
}

}  // namespace plumescout
