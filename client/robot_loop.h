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
#include "client/ingest_session.h"
#include "client/motion.h"
#include "client/notice_reader.h"
#include "client/plan_call.h"
#include "client/planner_client.h"
#include "client/robot_driver.h"
#include "client/robot_loop_options.h"
#include "client/robot_observer.h"
#include "client/running_clock.h"
#include "client/sensor_bridge.h"
#include "client/status_reports.h"
#include "core/types/stop.h"

namespace plumescout::client {

enum class RobotEnd { kMissionComplete, kTimeLimit, kStopped, kMissionFinished };

struct RobotResult {
  RobotEnd end = RobotEnd::kStopped;
  double elapsed_s = 0.0;   // of the robot's clock
  double distance_m = 0.0;  // driven
  int plans = 0;            // received
  int reached = 0;
  int blocked = 0;
  int replaced = 0;     // by a plan that was asked for on the way
  int aborted = 0;      // not reached in a multiple of the planned time, or cut short
  int invalidated = 0;  // of those: because the service said so
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
    Trajectory trajectory;  // in the robot's frame
    std::unique_ptr<Motion> motion;
    std::int64_t begun_ns = 0;
    std::int64_t deadline_ns = 0;  // given up after this
    // When the robot last had come on, and what was left of its path then.
    std::int64_t progressed_ns = 0;
    double left_m = 0.0;
    double yaw_rad = 0.0;
    std::int64_t patience_ns = 0;  // with no progress
    bool stuck = false;
    bool homeward = false;        // the robot knew when it asked that it is ordered home
    double replan_after_s = 0.0;  // 0: not on the way
  };

  absl::Status OpenLogOnDisk();
  absl::Status JoinMission();
  void StartSensing();
  void Log(std::int64_t time_ns, const Pose2& pose, ObservationPayload payload);
  absl::Status Explore();
  absl::Status Finish();
  void DropPending();

  absl::Status Tick(double duration_s);
  absl::Status Stand(double duration_s);
  // Whether all that was sensed so far is applied; what is missing shows in the statistics.
  bool AwaitApplied(absl::Duration timeout) {
    return ingest_->WaitApplied(ingest_->statistics().last_sequence, timeout).ok();
  }
  void HeedNotices();
  void EndRun(RobotEnd end) {
    result_.end = end;
    over_ = true;
  }
  bool GoesOnWithoutLink() const {
    return options_.pacing == Pacing::kLockstep && options_.link_is_down && options_.link_is_down();
  }
  bool IsToldToStop() const { return notices_.TellsToStop(leg_->plan, leg_->homeward); }
  void NoteProgress();
  void NoteProgressOfLeg(const Pose2& pose, std::int64_t now_ns);
  std::optional<ProgressOutcome> LegOutcome() const;
  absl::Status EndLeg(ProgressOutcome outcome);

  bool WantsBetterPlan() const;
  Pose2 PoseWhenAnswered() const;
  absl::Status AskInLockstep();
  absl::Status AskWhileRunning();
  PlanCall NextJob();
  absl::Status Digest(PlanReply answer);
  absl::Status Depart(const Plan& plan);
  Trajectory InOwnFrame(Trajectory trajectory) const;  // from the mission's

  bool Over();
  double SecondsSince(std::int64_t time_ns) const;  // by the robot's clock
  double elapsed_s() const { return SecondsSince(start_ns_); }

  PlannerClient& client_;
  RobotDriver& driver_;
  RobotLoopOptions options_;
  RobotObserver& observer_;
  StopFn stop_;

  NoticeReader notices_;
  RobotResult result_;
  bool over_ = false;
  RunningClock clock_;
  StatusReports status_reports_;
  std::int64_t start_ns_ = 0;
  std::int64_t last_tick_ns_ = 0;
  Point2 last_position_;
  std::optional<Leg> leg_;
  bool was_stuck_ = false;            // on the leg before, and it has not come on since
  std::optional<PlanReport> report_;  // not yet told
  std::int64_t asked_ns_ = 0;
  Pose2 asked_pose_;
  bool asked_homeward_ = false;
  bool asked_on_the_way_ = false;
  double answer_takes_s_ = 0.1;  // the last one did

  OpenedLog opened_log_;
  std::optional<RobotSession> joined_;
  std::optional<IngestSession> ingest_;
  std::optional<SensorBridge> bridge_;
  std::future<PlanReply> pending_;  // uses ingest_; its destructor waits for the answer
};

}  // namespace plumescout::client
