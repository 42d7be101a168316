// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/motion.h"

#include <algorithm>
#include <optional>

namespace plumescout::client {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

class IdealMotion final : public Motion {
 public:
  IdealMotion(const Trajectory& trajectory, std::int64_t departure_ns)
      : trajectory_(trajectory), departure_ns_(departure_ns), stepped_ns_(departure_ns) {}

  // While another robot is in the way no time of the trajectory goes by.
  absl::Status Step(RobotDriver& driver) override {
    const std::int64_t now_ns = driver.now_ns();
    const double elapsed_s = static_cast<double>(now_ns - departure_ns_) * kSecondsPerNanosecond;
    const absl::Status placed = driver.PlaceAt(PoseAt(trajectory_, elapsed_s));
    if (absl::IsUnavailable(placed)) {
      departure_ns_ += now_ns - stepped_ns_;
    } else {
      elapsed_s_ = elapsed_s;
    }
    stepped_ns_ = now_ns;
    stepped_ = true;
    return absl::IsUnavailable(placed) ? absl::OkStatus() : placed;
  }

  bool done() const override {
    const Waypoint& last = trajectory_.waypoints.back();
    return stepped_ && elapsed_s_ >= last.arrival_time_s + last.dwell_s;
  }

  bool standing() const override {
    const auto stands_at = [this](const Waypoint& waypoint) {
      return elapsed_s_ >= waypoint.arrival_time_s &&
             elapsed_s_ < waypoint.arrival_time_s + waypoint.dwell_s;
    };
    return done() ||
           std::any_of(trajectory_.waypoints.begin(), trajectory_.waypoints.end(), stands_at);
  }

  std::vector<Point2> PathAhead(const Pose2& pose) const override {
    std::vector<Point2> path = {pose.position()};
    for (const Waypoint& waypoint : trajectory_.waypoints) {
      if (waypoint.arrival_time_s > elapsed_s_) path.push_back(waypoint.pose.position());
    }
    return path;
  }

 private:
  const Trajectory trajectory_;
  std::int64_t departure_ns_;
  std::int64_t stepped_ns_;  // of the latest Step
  double elapsed_s_ = 0.0;
  bool stepped_ = false;
};

class SteeredMotion final : public Motion {
 public:
  SteeredMotion(const Trajectory& trajectory, const FollowerOptions& options)
      : follower_(trajectory, options) {}

  absl::Status Step(RobotDriver& driver) override {
    return driver.Drive(follower_.Step(driver.pose(), driver.now_ns()));
  }
  bool done() const override { return follower_.done(); }
  bool standing() const override { return follower_.standing(); }
  std::vector<Point2> PathAhead(const Pose2& pose) const override {
    return follower_.PathAhead(pose.position());
  }

 private:
  PathFollower follower_;
};

// The path that was planned only says where it ends, how long one stands there, and what the rest
// of the way would be.
class OthersMotion final : public Motion {
 public:
  OthersMotion(const Trajectory& trajectory, const FollowerOptions& options)
      : trajectory_(trajectory), arrival_tolerance_m_(options.arrival_tolerance_m) {}

  absl::Status Step(RobotDriver& driver) override {
    const Waypoint& last = trajectory_.waypoints.back();
    const double left_m = Distance_m(driver.pose().position(), last.pose.position());
    if (!arrived_ns_ && left_m <= arrival_tolerance_m_) arrived_ns_ = driver.now_ns();
    if (arrived_ns_) {
      const auto stood_ns = static_cast<double>(driver.now_ns() - *arrived_ns_);
      done_ = stood_ns * kSecondsPerNanosecond >= last.dwell_s;
    }
    return absl::OkStatus();
  }
  bool done() const override { return done_; }
  bool standing() const override { return arrived_ns_.has_value(); }

  std::vector<Point2> PathAhead(const Pose2& pose) const override {
    const auto& waypoints = trajectory_.waypoints;
    const auto nearest = std::min_element(waypoints.begin(), waypoints.end(),
                                          [&pose](const Waypoint& a, const Waypoint& b) {
                                            return Distance_m(a.pose.position(), pose.position()) <
                                                   Distance_m(b.pose.position(), pose.position());
                                          });
    std::vector<Point2> path = {pose.position()};
    for (auto ahead = nearest; ahead != waypoints.end(); ++ahead) {
      path.push_back(ahead->pose.position());
    }
    return path;
  }

 private:
  const Trajectory trajectory_;
  const double arrival_tolerance_m_;
  std::optional<std::int64_t> arrived_ns_;
  bool done_ = false;
};

}  // namespace

double LengthOf_m(const std::vector<Point2>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += Distance_m(path[i - 1], path[i]);
  return length_m;
}

std::unique_ptr<Motion> StartMotion(Following following, const Trajectory& trajectory,
                                    const FollowerOptions& options, std::int64_t departure_ns) {
  if (following == Following::kIdeal) {
    return std::make_unique<IdealMotion>(trajectory, departure_ns);
  }
  if (following == Following::kByOthers) {
    return std::make_unique<OthersMotion>(trajectory, options);
  }
  return std::make_unique<SteeredMotion>(trajectory, options);
}

}  // namespace plumescout::client
