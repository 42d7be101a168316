// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/blockage.h"
#include "client/ingest_session.h"
#include "client/join.h"
#include "client/motion.h"
#include "client/plan_call.h"
#include "client/planner_client.h"
#include "client/robot_driver.h"
#include "client/robot_observer.h"
#include "client/sensor_bridge.h"
#include "core/types/stop.h"

namespace plumescout::client {

enum class Pacing {
  // The world waits for acknowledgements and plans, so that a run is repeatable and may be faster
  // than real time; planning costs plan_latency_s of the robot's time.
  kLockstep,
  // The robot goes on while it asks.
  kFreeRunning,
};

struct RobotLoopOptions {
  Participation participation;
  Pacing pacing = Pacing::kFreeRunning;
  Following following = Following::kProportional;
  SensorRates rates;  // no more than one reading of a sensor is taken in a tick
  GasSampling gas_sampling;
  FollowerOptions follower;  // its tick_s is set from the one below
  BlockageOptions blockage;  // its radius is set from the participation
  IngestOptions ingest;
  // Of a log that begins here, drawn at random by who runs the loop: in [0, 2^53). 0: the server is
  // not told which log it is; with a log on disk it has to be.
  std::int64_t new_log_epoch = 0;
  double tick_s = 0.1;          // between commands, > 0
  double look_around_s = 0.5;   // standing before the first plan: a cell takes 3 beams to be free
  double plan_latency_s = 0.1;  // lockstep only: robot time that a plan costs, >= 0
  double stand_before_retry_s = 1.0;      // when there was nowhere to go, > 0
  double time_limit_s = 0.0;              // of the robot's clock; 0: none
  std::int64_t max_edge_evaluations = 0;  // of each plan; for repeatable runs, see PlanRequest
  absl::Duration plan_budget = absl::Seconds(1);
  absl::Duration plan_timeout = absl::Seconds(10);
  // For joining, and in lockstep for each plan: how long a broken link is put up with.
  absl::Duration link_patience = absl::Seconds(60);
  absl::Duration drain_timeout = absl::Seconds(10);  // for the last acknowledgements
};

// kInvalidArgument naming the field.
absl::Status Validate(const RobotLoopOptions& options);

enum class RobotEnd { kMissionComplete, kTimeLimit, kStopped };

struct RobotResult {
  RobotEnd end = RobotEnd::kStopped;
  double elapsed_s = 0.0;   // of the robot's clock
  double distance_m = 0.0;  // driven
  int plans = 0;            // received
  int reached = 0;
  int blocked = 0;
  int aborted = 0;  // not reached in a multiple of the planned time, or cut short by the end
  IngestStatistics ingest;
};

// A whole robot: joins a mission, sends what its sensors say, and drives where the planner sends
// it until the mission is complete, the time is up or `stop` says so. While the link is down it
// goes on following its last path and keeps its readings; with a folder for its log (ingest.store)
// also when it, or the server, or both, are killed.
class RobotLoop {
 public:
  // All references must outlive the loop.
  RobotLoop(PlannerClient& client, RobotDriver& driver, const RobotLoopOptions& options,
            RobotObserver& observer);

  // Call once. Errors: kInvalidArgument (options); what OpenLog or the driver returned;
  // LEASE_SUPERSEDED; a link that stayed broken beyond link_patience. The robot is told to stand
  // still in any case.
  absl::StatusOr<RobotResult> Run(const StopFn& stop);

 private:
  // The path being followed.
  struct Leg {
    PlanId plan = 0;
    std::unique_ptr<Motion> motion;
    std::int64_t deadline_ns = 0;  // given up after this
    // When the robot last had come on, and what was left of its path then.
    std::int64_t progressed_ns = 0;
    double left_m = 0.0;
    double yaw_rad = 0.0;
    std::int64_t patience_ns = 0;  // with no progress
    bool stuck = false;
  };

  absl::Status OpenLogOnDisk();
  absl::Status JoinMission();
  void StartSensing();
  absl::Status Explore();
  absl::Status Finish();
  void DropPending();

  absl::Status Tick(double duration_s);
  absl::Status Stand(double duration_s);
  bool AwaitApplied(absl::Duration timeout);
  void NoteProgress();
  void NoteProgressOfLeg(const Pose2& pose, std::int64_t now_ns);
  std::optional<ProgressOutcome> LegOutcome() const;
  absl::Status EndLeg(ProgressOutcome outcome);

  absl::Status AskInLockstep();
  absl::Status AskWhileRunning();
  PlanCall NextJob();
  absl::Status Digest(PlanReply answer);
  absl::Status Depart(const Plan& plan);

  bool Over();
  double elapsed_s() const;

  PlannerClient& client_;
  RobotDriver& driver_;
  RobotLoopOptions options_;
  RobotObserver& observer_;
  StopFn stop_;

  RobotResult result_;
  bool over_ = false;
  std::int64_t start_ns_ = 0;
  std::int64_t last_tick_ns_ = 0;
  Point2 last_position_;
  std::optional<Leg> leg_;
  bool was_stuck_ = false;            // on the leg before, and it has not come on since
  std::optional<PlanReport> report_;  // not yet told
  std::int64_t asked_ns_ = 0;
  Pose2 asked_pose_;

  OpenedLog opened_log_;
  std::optional<RobotSession> joined_;
  std::optional<IngestSession> ingest_;
  std::optional<SensorBridge> bridge_;
  std::future<PlanReply> pending_;  // uses ingest_; its destructor waits for the answer
};

}  // namespace plumescout::client
