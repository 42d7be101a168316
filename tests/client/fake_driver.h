// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "client/robot_driver.h"

namespace plumescout::client {

// A robot in an empty square room with walls at +-half_width_m, and whatever obstacle points a test
// puts there. Its clock moves only by Advance.
class FakeDriver final : public RobotDriver {
 public:
  static constexpr int kBeams = 90;

  explicit FakeDriver(double half_width_m = 5.0) : half_width_m_(half_width_m) {}

  std::int64_t now_ns() const override { return now_ns_; }
  Pose2 pose() const override { return pose_; }

  absl::StatusOr<Scan> TakeScan() override {
    if (!scan_status.ok()) return scan_status;
    constexpr double kStep_rad = 2.0 * M_PI / kBeams;
    Scan scan{
        .start_angle_rad = 0.0, .angle_step_rad = kStep_rad, .max_range_m = 20.0, .ranges_m = {}};
    for (int i = 0; i < kBeams; ++i) {
      scan.ranges_m.push_back(static_cast<float>(Range_m(pose_.yaw_rad + i * kStep_rad)));
    }
    return scan;
  }
  absl::StatusOr<GasReading> ReadGas() override {
    if (!gas_status.ok()) return gas_status;
    return GasReading{.concentration_ppm = 1.0};
  }

  std::optional<PoseCorrection> TakeCorrection() override {
    return std::exchange(correction, std::nullopt);
  }
  std::optional<RobotStatus> TakeStatus() override {
    return status ? status(now_ns_) : std::nullopt;
  }

  absl::Status Drive(const Twist& twist) override {
    twist_ = twist;
    return absl::OkStatus();
  }
  absl::Status PlaceAt(const Pose2& pose) override {
    if (place_status.ok()) pose_ = pose;
    return place_status;
  }
  absl::Status Advance(double duration_s) override {
    constexpr int kSubsteps = 20;
    const double dt_s = duration_s / kSubsteps;
    for (int i = 0; i < kSubsteps; ++i) {
      pose_.x_m += twist_.forward_mps * std::cos(pose_.yaw_rad) * dt_s;
      pose_.y_m += twist_.forward_mps * std::sin(pose_.yaw_rad) * dt_s;
      pose_.yaw_rad = WrapAngle_rad(pose_.yaw_rad + twist_.turn_rad_per_s * dt_s);
    }
    now_ns_ += std::llround(duration_s * 1e9);
    if (on_advance) on_advance();
    return advance_status;
  }

  const Twist& twist() const { return twist_; }
  void set_now_ns(std::int64_t now_ns) { now_ns_ = now_ns; }
  void set_pose(const Pose2& pose) { pose_ = pose; }

  // Round posts, radius 5 cm.
  std::vector<Point2> posts;
  absl::Status scan_status;
  absl::Status gas_status;
  std::optional<PoseCorrection> correction;  // taken once
  absl::Status advance_status;
  absl::Status place_status;
  std::function<void()> on_advance;
  std::function<std::optional<RobotStatus>(std::int64_t now_ns)> status;

 private:
  double Range_m(double angle_rad) const {
    constexpr double kPostRadius_m = 0.05;
    const double dx = std::cos(angle_rad);
    const double dy = std::sin(angle_rad);
    const double to_x = ((dx > 0 ? half_width_m_ : -half_width_m_) - pose_.x_m) / dx;
    const double to_y = ((dy > 0 ? half_width_m_ : -half_width_m_) - pose_.y_m) / dy;
    double range_m = std::min(dx != 0.0 ? to_x : to_y, dy != 0.0 ? to_y : to_x);
    for (const Point2 post : posts) {
      const double along_m = (post.x_m - pose_.x_m) * dx + (post.y_m - pose_.y_m) * dy;
      const double across_m = (post.x_m - pose_.x_m) * dy - (post.y_m - pose_.y_m) * dx;
      if (along_m > 0.0 && std::abs(across_m) < kPostRadius_m) {
        range_m = std::min(range_m, along_m - kPostRadius_m);
      }
    }
    return range_m;
  }

  const double half_width_m_;
  std::int64_t now_ns_ = 1'000'000'000'000;
  Pose2 pose_;
  Twist twist_;
};

}  // namespace plumescout::client
