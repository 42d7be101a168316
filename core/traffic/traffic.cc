// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/traffic/traffic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumescout {
namespace {

constexpr double kStep_s = 0.25;
constexpr double kEarly_s = 0.5;
constexpr double kEarlyShare = 0.05;
constexpr double kLate_s = 1.0;
constexpr double kLateShare = 0.1;
// Who is nearer than it should be may not come nearer by more than this.
constexpr double kTolerance_m = 0.05;
// Bodies nearer than this touch by what poses err.
constexpr double kTouch_m = 0.02;

std::size_t StepsIn(double time_s) { return static_cast<std::size_t>(std::ceil(time_s / kStep_s)); }

// A way that should have ended so long ago, beside its own duration, is driven no more.
constexpr double kPatience_s = 30.0;
// So long may it be until a pose comes from where its plan begins.
constexpr double kSetsOut_s = 2.0;
constexpr double kSecondsPerNanosecond = 1e-9;

// The most steps that another robot is early by.
std::size_t MostEarly() { return StepsIn(kEarly_s + kEarlyShare * Traffic::kHorizon_s); }

double Elapsed_s(const RobotRecord& record, std::int64_t now_ns) {
  return record.live_trajectory->duration_s -
         static_cast<double>(record.live_arrival_ns - now_ns) * kSecondsPerNanosecond;
}

// How long it was not heard of, beyond the time in which poses come as a rule, seconds.
double Unheard_s(const RobotRecord& record, std::int64_t now_ns) {
  constexpr double kPosesCome_s = 1.0;
  if (record.heard_ns == 0) return 0.0;
  const double unheard_s = static_cast<double>(now_ns - record.heard_ns) * kSecondsPerNanosecond;
  return std::clamp(unheard_s - kPosesCome_s, 0.0, Traffic::kHorizon_s);
}

// By then who looks its way has mapped its body, which nobody masks since it is silent.
bool IsGone(const RobotRecord& record, std::int64_t now_ns) {
  const double unheard_s = static_cast<double>(now_ns - record.heard_ns) * kSecondsPerNanosecond;
  return record.state.silent && unheard_s > Traffic::kSilentBody_s;
}

double SquaredDistance_m2(Point2 a, Point2 b) {
  const double dx_m = b.x_m - a.x_m;
  const double dy_m = b.y_m - a.y_m;
  return dx_m * dx_m + dy_m * dy_m;
}

double Fastest_m(const std::vector<Point2>& places) {
  double fastest_m = 0.0;
  for (std::size_t k = 1; k < places.size(); ++k) {
    fastest_m = std::max(fastest_m, Distance_m(places[k - 1], places[k]));
  }
  return fastest_m;
}

// REQUIRES: one place at least.
Rectangle Around(const std::vector<Point2>& places) {
  Rectangle around = {places.front(), places.front()};
  for (const Point2 place : places) around = around.With({place, place});
  return around;
}

// How far two robots may be nearer than it seems, for their frames lie where they do more or less.
// A heading is the more doubt the farther the robot is from the origin of its frame.
double Doubt_m(const RobotState& a, const RobotState& b) {
  constexpr double kSigmas = 2.5;
  const auto stddev_m = [](const RobotState& robot) {
    const Point2 origin = robot.frame.mission_from_robot.position();
    return std::hypot(robot.frame.position_stddev_m,
                      robot.frame.heading_stddev_rad * Distance_m(robot.pose.position(), origin));
  };
  return kSigmas * std::hypot(stddev_m(a), stddev_m(b));
}

}  // namespace

double Reach_m(const RobotState& a, const RobotState& b, double clearance_m) {
  return a.radius_m + b.radius_m + std::max(0.0, Doubt_m(a, b) - clearance_m);
}

bool IsOnItsWay(const RobotRecord& record, std::int64_t now_ns) {
  const Trajectory* const way = record.live_trajectory.get();
  if (way == nullptr || way->waypoints.empty()) return false;
  const double elapsed_s = Elapsed_s(record, now_ns);
  const NearestTime nearest = *FindOnWay(*way, record.state.pose.position(), record.live_gone_s);
  const bool at_start = nearest.time_s <= way->waypoints.front().dwell_s;
  const bool may_set_out = at_start && elapsed_s < kSetsOut_s;
  return elapsed_s <= 2.0 * way->duration_s + kPatience_s &&
         nearest.distance_m <= (may_set_out ? kStartsAhead_m : kOffTrajectory_m);
}

double Lateness_s(const RobotRecord& record, std::int64_t now_ns) {
  return std::max(0.0, Elapsed_s(record, now_ns) - Progress_s(record, now_ns));
}

double Progress_s(const RobotRecord& record, std::int64_t now_ns) {
  constexpr double kNear_s = 1.0;  // of two passes of one place, the one it is at
  const Trajectory& way = *record.live_trajectory;
  const Point2 place = record.state.pose.position();
  const double elapsed_s = Elapsed_s(record, now_ns);
  const double there_s = FindOnWay(way, place, record.live_gone_s)->time_s;
  for (const Waypoint& waypoint : way.waypoints) {
    const double leaves_s = waypoint.arrival_time_s + waypoint.dwell_s;
    const bool stands = waypoint.dwell_s > 0.0 && elapsed_s < leaves_s &&
                        there_s > waypoint.arrival_time_s - kNear_s &&
                        there_s < leaves_s + kNear_s &&
                        Distance_m(place, waypoint.pose.position()) < kOffTrajectory_m;
    if (stands) return std::max(elapsed_s, waypoint.arrival_time_s);
  }
  return there_s;
}

void WaitAtStart(double wait_s, Trajectory& trajectory) {
  trajectory.waypoints.front().dwell_s += wait_s;
  for (std::size_t i = 1; i < trajectory.waypoints.size(); ++i) {
    trajectory.waypoints[i].arrival_time_s += wait_s;
  }
  trajectory.duration_s += wait_s;
}

Point2 Traffic::Steps::At(std::size_t step, std::size_t waited) const {
  return places[std::min(step - std::min(step, waited), places.size() - 1)];
}

Traffic::Traffic(const std::map<RobotId, RobotRecord>& robots, const RobotId& robot,
                 double clearance_m, std::int64_t now_ns, Others others)
    : self_(robots.at(robot).state),
      clearance_m_(clearance_m),
      on_time_(others == Others::kOnTime) {
  for (const auto& [id, record] : robots) {
    if (id == robot || !record.state.has_pose || IsGone(record, now_ns)) continue;
    Other other{id, Reach_m(self_, record.state, clearance_m), {record.state.pose.position()}};
    if (IsOnItsWay(record, now_ns)) {
      other.unheard_s = Unheard_s(record, now_ns);
      GoOn(*record.live_trajectory, Progress_s(record, now_ns), other);
    }
    other.around = Around(other.places);
    others_.push_back(std::move(other));
  }
}

void Traffic::GoOn(const Trajectory& way, double from_s, Other& other) {
  const std::size_t last = StepsIn(kHorizon_s + other.unheard_s) + MostEarly();
  for (std::size_t k = 1; k <= last; ++k) {
    other.places.push_back(PoseAt(way, from_s + kStep_s * static_cast<double>(k)).position());
  }
  other.fastest_m = Fastest_m(other.places);
}

void Traffic::KeepWay(const RobotState& other, const Trajectory& way) {
  const double reach_m = Reach_m(self_, other, clearance_m_);
  Other going{other.id, reach_m, {way.waypoints.front().pose.position()}};
  GoOn(way, 0.0, going);
  going.around = Around(going.places);
  others_.push_back(std::move(going));
  kept_ways_.push_back({other.id, reach_m, way});
}

Traffic::Steps Traffic::StepsOf(const Trajectory& trajectory, double from_s) {
  Steps steps;
  const double left_s = std::max(0.0, trajectory.duration_s - from_s);
  const std::size_t last = StepsIn(std::min(left_s, kHorizon_s));
  for (std::size_t k = 0; k <= last; ++k) {
    const double time_s = from_s + kStep_s * static_cast<double>(k);
    steps.places.push_back(PoseAt(trajectory, time_s).position());
  }
  steps.fastest_m = Fastest_m(steps.places);
  steps.around = Around(steps.places);
  steps.ends = left_s <= kHorizon_s;
  return steps;
}

std::vector<Traffic::Hold> Traffic::Holds() const {
  std::vector<Hold> holds;
  for (const Other& other : others_) {
    const double apart_m = other.reach_m + clearance_m_;
    for (std::size_t k = 0; k + 1 < other.places.size(); ++k) {
      if (other.places[k] == other.places[k + 1]) continue;  // the later one holds it for longer
      const double time_s = kStep_s * static_cast<double>(k + 1);
      holds.push_back({other.places[k], apart_m, time_s + kLate_s + kLateShare * time_s});
    }
    holds.push_back({other.places.back(), apart_m, std::numeric_limits<double>::infinity()});
  }
  return holds;
}

std::optional<Meeting> Traffic::FirstMeeting(const Trajectory& trajectory) const {
  return FirstMeeting(trajectory, 0.0);
}

std::optional<Meeting> Traffic::FirstMeeting(const Trajectory& trajectory, double from_s) const {
  if (trajectory.waypoints.empty()) return std::nullopt;
  return FindMeeting(StepsOf(trajectory, from_s), 0);
}

std::optional<double> Traffic::LeastWait_s(const Trajectory& trajectory, double most_s) const {
  if (trajectory.waypoints.empty()) return 0.0;
  const Steps steps = StepsOf(trajectory);
  constexpr std::size_t kStride = 2;  // half a second
  for (std::size_t waited = 0; waited <= StepsIn(most_s); waited += kStride) {
    if (!FindMeeting(steps, waited)) return static_cast<double>(waited) * kStep_s;
  }
  return std::nullopt;
}

std::optional<Meeting> Traffic::FindMeeting(const Steps& steps, std::size_t waited) const {
  std::optional<Meeting> first;
  for (const Other& other : others_) {
    const std::optional<std::size_t> step = MeetingStep(other, steps, waited);
    if (!step) continue;
    const double time_s = kStep_s * static_cast<double>(*step);
    if (first && first->time_s <= time_s) continue;
    first = Meeting{other.robot, time_s, steps.At(*step, waited)};
  }
  return first ? first : FindEnd(steps, waited);
}

// Where it ends on a way that is kept free.
std::optional<Meeting> Traffic::FindEnd(const Steps& steps, std::size_t waited) const {
  if (!steps.ends) return std::nullopt;
  const Point2 end = steps.places.back();
  for (const KeptWay& kept : kept_ways_) {
    if (FindNearest(kept.way, end)->distance_m >= kept.reach_m + clearance_m_) continue;
    const std::size_t step = steps.places.size() - 1 + waited;
    return Meeting{kept.robot, kStep_s * static_cast<double>(step), end};
  }
  return std::nullopt;
}

std::optional<std::size_t> Traffic::MeetingStep(const Other& other, const Steps& steps,
                                                std::size_t waited) const {
  constexpr double kRounding_m = 1e-6;
  const double apart_m = other.reach_m + clearance_m_ + kRounding_m;
  if (!steps.around.Grown(apart_m).Overlaps(other.around)) return std::nullopt;
  const auto place = [&](std::size_t k) {
    return other.places[std::min(k, other.places.size() - 1)];
  };
  const double now_m = Distance_m(steps.places.front(), place(0));
  const double nearer_m = std::max(std::min(now_m, other.reach_m + kTouch_m), now_m - kTolerance_m);
  const double limit_m = std::min(other.reach_m + clearance_m_, nearer_m);
  // Who has come to its end stands there until it has another plan.
  const std::size_t last = StepsIn(kHorizon_s);
  for (std::size_t k = 0; k <= last;) {
    const Point2 mine = steps.At(k, waited);
    const double time_s = kStep_s * static_cast<double>(k);
    // Who is late now is where it was to be a while ago.
    const std::size_t late = on_time_ ? 0 : StepsIn(kLate_s + kLateShare * time_s);
    const double early_s = other.unheard_s + (on_time_ ? 0.0 : kEarly_s + kEarlyShare * time_s);
    const std::size_t early = StepsIn(early_s);
    double nearest_m2 = SquaredDistance_m2(mine, place(k));
    for (std::size_t j = k - std::min(k, late); j <= k + early; ++j) {
      nearest_m2 = std::min(nearest_m2, SquaredDistance_m2(mine, place(j)));
    }
    const double nearest_m = std::sqrt(nearest_m2);
    if (nearest_m < limit_m) return k;
    // In a step both come nearer by their own way, and the window grows by a share of a step, which
    // may round up to a whole one.
    constexpr double kGrowth = 1.0 + kLateShare + kEarlyShare;
    const double closing_m = steps.fastest_m + kGrowth * other.fastest_m;
    if (!(closing_m > 0.0)) return std::nullopt;
    const double slack_m = std::max(0.0, nearest_m - limit_m - other.fastest_m);
    k += std::max<std::size_t>(1, static_cast<std::size_t>(slack_m / closing_m));
  }
  return std::nullopt;
}

}  // namespace plumescout
