// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/robot_driver.h"
#include "lab/sim/clock_error.h"
#include "lab/sim/company.h"
#include "lab/sim/gas_sensor.h"
#include "lab/sim/lidar.h"
#include "lab/sim/loop_closure.h"
#include "lab/sim/pace.h"
#include "lab/sim/pose_error.h"
#include "lab/sim/pose_jump.h"
#include "lab/sim/scene_world.h"

namespace plumescout::lab {

struct SimulatedRobotOptions {
  std::optional<Pose2> start = std::nullopt;  // default: the scene's
  double max_forward_mps = 1.25;              // either way, [XIT] section VI-A, (0, 100]
  double max_turn_rad_per_s = 2.0;            // either way, (0, 100]
  // Of speeding up and braking, (0, 1000]; none: speed jumps. It holds for what is driven, not for
  // where the robot is placed.
  std::optional<double> max_acceleration_mps2 = std::nullopt;
  // Touching a wall stops the robot, [0, 5]. Far less than its real radius: plans keep the centres
  // of cells 0.2 m apart, in a map that still grows, and come as near as 0.06 m to true walls.
  double body_radius_m = 0.05;
  double seen_radius_m = 0.2;  // of the body that other robots and their beams meet, [0, 5]
  bool has_body = true;        // false: a ghost, whom others neither see nor run into
  LidarOptions lidar = {};
  GasSensorOptions gas_sensor = {};
  PoseErrorOptions pose_error = {};
  PaceOptions pace = {};         // of a robot that is placed
  ClockErrorOptions clock = {};  // of its own
  double scene_start_s = 0.0;    // of the scene's time, at which the robot's begins, [0, 1e6]
  // Of the world's clock, at its start; >= 0, and so is its own.
  std::int64_t start_time_ns = 1'700'000'000'000'000'000;
  bool realtime =
      false;  // Advance takes as long as it says, or longer by time that was lost before
  std::uint64_t seed = 1;
  // Others in the same world, who see this robot's body as it sees theirs, and block its way.
  Companion companion = {};
};

// A robot in a SceneWorld: exact kinematics, simulated sensors, localisation as exact as asked for.
// Sensors and collisions go by where it truly is. Everything but the pacing depends on the options
// and the calls alone, and on the others if there are any.
class SimulatedRobot : public client::RobotDriver {
 public:
  // The longest stretch over which pose and gas are taken as constant; 2.5 cm at 1.25 m/s.
  static constexpr double kStep_s = 0.02;

  // `world` must outlive the robot. kInvalidArgument naming the field; also if the start collides.
  static absl::StatusOr<SimulatedRobot> Create(const SceneWorld& world,
                                               const SimulatedRobotOptions& options);

  // Of its own clock.
  std::int64_t now_ns() const override {
    return ToldTime_ns(options_.clock, options_.start_time_ns, now_ns_);
  }
  std::int64_t world_time_ns() const { return now_ns_; }
  double elapsed_s() const;  // of the world's time, since its start
  // That when its own clock said so.
  double ElapsedAt_s(std::int64_t told_ns) const;
  Pose2 pose() const override { return pose_jump_.Told(pose_error_.Told(pose_)); }
  const Pose2& true_pose() const { return pose_; }
  absl::StatusOr<Scan> TakeScan() override;
  absl::StatusOr<GasReading> ReadGas() override;

  std::optional<PoseCorrection> TakeCorrection() override;

  // Commands beyond the limits are cut to them. kInvalidArgument if not finite.
  absl::Status Drive(const client::Twist& twist) override;
  // Where the robot holds itself to be: drift of its localisation sets it off. A pose that collides
  // is not taken: the robot stays, as if it had bumped into something. kInvalidArgument if not
  // finite. kUnavailable while another robot is in the way, see Company::MayMoveTo, and when its
  // pace does not take it there yet.
  absl::Status PlaceAt(const Pose2& pose) override;
  // In steps of at most kStep_s. In real time the world is then where the wall clock is, however
  // late the call came. kInvalidArgument unless 0 <= duration_s <= 3600.
  absl::Status Advance(double duration_s) override;
  // Called at the end of every Advance, when it is this robot's turn; none: nobody is.
  void set_listener(std::function<void()> listener) { listener_ = std::move(listener); }

  // Moves that a wall prevented. The robot then stands until the next command, as it does when
  // another robot is in the way.
  int collisions() const { return collisions_; }

 private:
  SimulatedRobot(const SceneWorld& world, const SimulatedRobotOptions& options);

  void Move(double duration_s);
  double NextSpeed_mps(double duration_s) const;
  bool MayMoveTo(Point2 place) const;
  void ShowBody();
  void AwaitRealTime(double duration_s);
  double scene_time_s() const;

  const SceneWorld* world_;
  SimulatedRobotOptions options_;
  Lidar lidar_;
  GasSensor gas_sensor_;
  std::int64_t now_ns_;  // of the world's clock
  PoseError pose_error_;
  LoopClosure loop_closure_;
  PoseJump pose_jump_;
  Pace pace_;
  std::function<void()> listener_;
  Pose2 pose_;           // true
  client::Twist twist_;  // as commanded
  double speed_mps_ = 0.0;
  int collisions_ = 0;
  std::chrono::steady_clock::time_point due_;  // real time: when the last Advance was to end
};

}  // namespace plumescout::lab
