// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/simulated_robot.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;
constexpr double kMaxAdvance_s = 3600.0;
constexpr double kMaxSpeed = 100.0;
constexpr double kMaxBodyRadius_m = 5.0;
constexpr double kMaxAcceleration_mps2 = 1000.0;
constexpr double kMaxSceneStart_s = 1e6;
// Turn rates below this leave the path straight to within a nanometre per step.
constexpr double kStraight_rad_per_s = 1e-6;
// Independent streams from one seed.
constexpr std::uint64_t kLidarStream = 0x6C69646172;
constexpr std::uint64_t kGasStream = 0x676173;
constexpr std::uint64_t kPoseStream = 0x706F7365;
constexpr std::uint64_t kPaceStream = 0x70616365;

bool IsFinite(const Pose2& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.yaw_rad);
}

absl::Status Validate(const SimulatedRobotOptions& options) {
  const double acceleration_mps2 = options.max_acceleration_mps2.value_or(kMaxAcceleration_mps2);
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRangeAbove("robot.max_forward_mps", options.max_forward_mps, 0.0, kMaxSpeed)
          .InRangeAbove("robot.max_turn_rad_per_s", options.max_turn_rad_per_s, 0.0, kMaxSpeed)
          .InRange("robot.body_radius_m", options.body_radius_m, 0.0, kMaxBodyRadius_m)
          .InRange("robot.seen_radius_m", options.seen_radius_m, 0.0, kMaxBodyRadius_m)
          .InRangeAbove("robot.max_acceleration_mps2", acceleration_mps2, 0.0,
                        kMaxAcceleration_mps2)
          .InRange("robot.scene_start_s", options.scene_start_s, 0.0, kMaxSceneStart_s)
          .status());
  PLUMESCOUT_RETURN_IF_ERROR(lab::Validate(options.pace));
  PLUMESCOUT_RETURN_IF_ERROR(lab::Validate(options.clock));
  const bool after_epoch =
      options.start_time_ns >= 0 &&
      ToldTime_ns(options.clock, options.start_time_ns, options.start_time_ns) >= 0;
  if (!after_epoch) {
    return absl::InvalidArgumentError("robot.start_time_ns must be >= 0, with its clock's offset");
  }
  PLUMESCOUT_RETURN_IF_ERROR(lab::Validate(options.lidar));
  PLUMESCOUT_RETURN_IF_ERROR(lab::Validate(options.pose_error));
  return lab::Validate(options.gas_sensor);
}

// Where a unicycle is after `duration_s` on an arc.
Pose2 AlongArc(const Pose2& from, const client::Twist& twist, double duration_s) {
  const double yaw_rad = from.yaw_rad + twist.turn_rad_per_s * duration_s;
  if (std::abs(twist.turn_rad_per_s) < kStraight_rad_per_s) {
    const double length_m = twist.forward_mps * duration_s;
    return {from.x_m + length_m * std::cos(from.yaw_rad),
            from.y_m + length_m * std::sin(from.yaw_rad), WrapAngle_rad(yaw_rad)};
  }
  const double radius_m = twist.forward_mps / twist.turn_rad_per_s;
  return {from.x_m + radius_m * (std::sin(yaw_rad) - std::sin(from.yaw_rad)),
          from.y_m - radius_m * (std::cos(yaw_rad) - std::cos(from.yaw_rad)),
          WrapAngle_rad(yaw_rad)};
}

}  // namespace

absl::StatusOr<SimulatedRobot> SimulatedRobot::Create(const SceneWorld& world,
                                                      const SimulatedRobotOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  SimulatedRobot robot(world, options);
  const Pose2 start = robot.true_pose();
  if (!IsFinite(start)) return absl::InvalidArgumentError("robot.start must be finite");
  if (world.Collides(start.position(), options.body_radius_m)) {
    return absl::InvalidArgumentError(
        absl::StrCat("robot.start (", start.x_m, ", ", start.y_m, ") touches an obstacle"));
  }
  robot.ShowBody();
  return robot;
}

SimulatedRobot::SimulatedRobot(const SceneWorld& world, const SimulatedRobotOptions& options)
    : world_(&world),
      options_(options),
      lidar_(options.lidar, options.seed ^ kLidarStream),
      gas_sensor_(options.gas_sensor, options.seed ^ kGasStream, world.ambient_ppm()),
      now_ns_(options.start_time_ns),
      pose_error_(options.pose_error, options.seed ^ kPoseStream),
      loop_closure_(options.pose_error.closed_every_s),
      pose_jump_(options.pose_error.jump),
      pace_(options.pace, options.seed ^ kPaceStream),
      pose_(options.start.value_or(world.scene().start_pose)),
      due_(std::chrono::steady_clock::now()) {}

absl::StatusOr<Scan> SimulatedRobot::TakeScan() {
  const Companion& companion = options_.companion;
  if (companion.company == nullptr) return lidar_.Take(world_->occupancy(), pose_);
  return lidar_.Take(world_->occupancy(), pose_, companion.company->Others(companion.robot));
}

absl::StatusOr<GasReading> SimulatedRobot::ReadGas() {
  return GasReading{.concentration_ppm = gas_sensor_.Read_ppm()};
}

absl::Status SimulatedRobot::Drive(const client::Twist& twist) {
  if (!std::isfinite(twist.forward_mps) || !std::isfinite(twist.turn_rad_per_s)) {
    return absl::InvalidArgumentError("twist must be finite");
  }
  if (twist.forward_mps == 0.0 && twist.turn_rad_per_s == 0.0) pace_.BeginLeg();
  const double forward = options_.max_forward_mps;
  const double turn = options_.max_turn_rad_per_s;
  twist_ = {std::clamp(twist.forward_mps, -forward, forward),
            std::clamp(twist.turn_rad_per_s, -turn, turn)};
  return absl::OkStatus();
}

absl::Status SimulatedRobot::PlaceAt(const Pose2& pose) {
  if (!IsFinite(pose)) return absl::InvalidArgumentError("pose must be finite");
  const Pose2 truth = pose_error_.TrueFor(pose_jump_.Held(pose));
  if (world_->Collides(truth.position(), options_.body_radius_m)) {
    ++collisions_;
    return absl::OkStatus();
  }
  if (!pace_.MayMove(Distance_m(pose_.position(), truth.position()), elapsed_s())) {
    return absl::UnavailableError("the robot is slower than its path");
  }
  if (!MayMoveTo(truth.position())) return absl::UnavailableError("another robot is in the way");
  pose_ = truth;
  pose_.yaw_rad = WrapAngle_rad(truth.yaw_rad);
  ShowBody();
  return absl::OkStatus();
}

absl::Status SimulatedRobot::Advance(double duration_s) {
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker().InRange("robot.Advance duration_s", duration_s, 0.0, kMaxAdvance_s).status());
  const std::int64_t begin_ns = now_ns_;
  constexpr double kRounding = 1e-9;
  const auto steps = static_cast<int>(std::ceil(duration_s / kStep_s - kRounding));
  for (int step = 1; step <= steps; ++step) {
    const double step_s = duration_s / steps;
    Move(step_s);
    now_ns_ = begin_ns + std::llround(step * step_s * kNanosecondsPerSecond);
    gas_sensor_.Step(world_->Concentration_ppm(pose_.position(), scene_time_s()), step_s);
  }
  pose_error_.Advance(duration_s);
  if (loop_closure_.Pass(elapsed_s(), now_ns(), pose_)) pose_error_.Close();
  pose_jump_.Pass(elapsed_s(), now_ns(), pose_error_.Told(pose_));
  ShowBody();
  if (options_.realtime) AwaitRealTime(duration_s);
  const Companion& companion = options_.companion;
  if (companion.company != nullptr) companion.company->AwaitTurn(companion.robot, now_ns_);
  if (listener_) listener_();
  return absl::OkStatus();
}

std::optional<PoseCorrection> SimulatedRobot::TakeCorrection() {
  if (auto correction = loop_closure_.TakeCorrection()) return correction;
  return pose_jump_.TakeCorrection();
}

void SimulatedRobot::Move(double duration_s) {
  if (!options_.max_acceleration_mps2) speed_mps_ = twist_.forward_mps;
  const double next_speed_mps = NextSpeed_mps(duration_s);
  const double mean_speed_mps = 0.5 * (speed_mps_ + next_speed_mps);
  speed_mps_ = next_speed_mps;
  if (mean_speed_mps == 0.0 && twist_.turn_rad_per_s == 0.0) return;
  const Pose2 next = AlongArc(pose_, {mean_speed_mps, twist_.turn_rad_per_s}, duration_s);
  const bool turns_on_the_spot = next.position() == pose_.position();
  const bool hits_wall =
      !turns_on_the_spot && world_->Collides(next.position(), options_.body_radius_m);
  if (hits_wall) ++collisions_;
  if (hits_wall || (!turns_on_the_spot && !MayMoveTo(next.position()))) {
    twist_ = {};
    speed_mps_ = 0.0;
    return;
  }
  pose_ = next;
}

bool SimulatedRobot::MayMoveTo(Point2 place) const {
  const Companion& companion = options_.companion;
  return companion.company == nullptr ||
         companion.company->MayMoveTo(companion.robot, place, now_ns_);
}

// As near to the command as the acceleration lets it come; without a limit there at once.
double SimulatedRobot::NextSpeed_mps(double duration_s) const {
  if (!options_.max_acceleration_mps2) return twist_.forward_mps;
  const double change_mps = *options_.max_acceleration_mps2 * duration_s;
  return std::clamp(twist_.forward_mps, speed_mps_ - change_mps, speed_mps_ + change_mps);
}

void SimulatedRobot::ShowBody() {
  const Companion& companion = options_.companion;
  if (companion.company == nullptr || !options_.has_body) return;
  companion.company->Stand(companion.robot, {pose_.position(), options_.seen_radius_m});
}

// Sleeps until the stretch is over. Time lost elsewhere (joining a mission, a slow scan) has gone
// by for the world and its clocks too; the robot stood.
void SimulatedRobot::AwaitRealTime(double duration_s) {
  using Seconds = std::chrono::duration<double>;
  due_ += std::chrono::duration_cast<std::chrono::steady_clock::duration>(Seconds(duration_s));
  const auto now = std::chrono::steady_clock::now();
  if (due_ >= now) {
    std::this_thread::sleep_until(due_);
    return;
  }
  const double lost_s = Seconds(now - due_).count();
  due_ = now;
  now_ns_ += std::llround(lost_s * kNanosecondsPerSecond);
  gas_sensor_.Step(world_->Concentration_ppm(pose_.position(), scene_time_s()), lost_s);
}

double SimulatedRobot::elapsed_s() const {
  return static_cast<double>(now_ns_ - options_.start_time_ns) / kNanosecondsPerSecond;
}

double SimulatedRobot::ElapsedAt_s(std::int64_t told_ns) const {
  const std::int64_t start_ns = options_.start_time_ns;
  return static_cast<double>(WorldTime_ns(options_.clock, start_ns, told_ns) - start_ns) /
         kNanosecondsPerSecond;
}

double SimulatedRobot::scene_time_s() const { return options_.scene_start_s + elapsed_s(); }

}  // namespace plumescout::lab
