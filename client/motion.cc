// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/motion.h"

#include <algorithm>

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

}  // namespace

std::unique_ptr<Motion> StartMotion(Following following, const Trajectory& trajectory,
                                    const FollowerOptions& options, std::int64_t departure_ns) {
  if (following == Following::kIdeal) {
    return std::make_unique<IdealMotion>(trajectory, departure_ns);
  }
  return std::make_unique<SteeredMotion>(trajectory, options);
}

}  // namespace plumescout::client
