// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "client/planner_client.h"
#include "core/belief/belief.h"
#include "core/mission/conduct/conduct_observer.h"
#include "core/mission/conduct/lease_book.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/conduct/robot_news_book.h"
#include "core/mission/conduct/team_commit.h"
#include "core/mission/mission.h"
#include "core/plan/paths/path_planners.h"
#include "core/plan/plan_watch.h"
#include "core/plan/strategy.h"
#include "core/plan/team/team_plan.h"
#include "core/types/event.h"
#include "core/types/robot_notice.h"

namespace plumescout::lab {

struct LocalOptions {
  std::int64_t credit_window = 256;                  // observations ahead of what is applied, >= 1
  absl::Duration lease_hold = absl::Seconds(10);     // after the last use
  absl::Duration default_budget = absl::Seconds(1);  // of plans that ask for none
  std::function<absl::Time()> clock = absl::Now;     // for leases and deadlines
  // The time of missions, from any thread: robots that say by their own clocks when they send are
  // then known to be off. Null: their sample times are taken as they are.
  std::function<std::int64_t()> mission_clock_ns = nullptr;
  PathPlannerFactory path_planners = nullptr;  // of planners that core does not have
  // Puts another strategy in the place of a mission's, or round it; null: none is.
  std::function<std::unique_ptr<const Strategy>(const PlanningOptions&,
                                                std::unique_ptr<const Strategy>)>
      replace_strategy = nullptr;
  // Told of every event of every mission, once it is applied; may be empty.
  std::function<void(const Event&)> on_event = nullptr;
};

// What there is to tell a robot unasked.
struct RobotNews {
  std::int64_t revision = 0;  // of the mission
  std::optional<RobotStanding> standing;
  std::optional<PlanInvalidated> invalidated;  // of its latest plan
  std::optional<PlanAssigned> assigned;        // the same
};

// The conduct of one mission and its leases, behind one mutex; searches for plans run outside it,
// on the caller's thread. Thread-safe.
class LocalMission final : private ConductObserver {
 public:
  // kInvalidArgument if the options are invalid.
  static absl::StatusOr<std::shared_ptr<LocalMission>> Create(const MissionOptions& mission,
                                                              const LocalOptions& options);
  // REQUIRES: both were made from the same options.
  LocalMission(std::unique_ptr<Mission> mission, std::unique_ptr<const Strategy> strategy,
               const LocalOptions& options);

  // The session's mission and boot id are left to the caller.
  absl::StatusOr<client::RobotSession> Register(const Registration& wish);

  // Its streams have ended with ROBOT_NOT_FOUND.
  absl::Status Remove(const Removal& wish);

  // A stream ends the robot's earlier one. Returns its number.
  absl::StatusOr<StreamId> OpenStream(const RobotId& robot, std::int64_t lease_token);
  // The state of an open stream, or why it has ended.
  absl::StatusOr<client::IngestState> StreamState(const RobotId& robot, std::int64_t lease_token,
                                                  StreamId stream) const;
  void CloseStream(const RobotId& robot, StreamId stream);
  // Waits until the stream has ended; kDeadlineExceeded if it has not in time.
  absl::Status AwaitStreamEnd(const RobotId& robot, std::int64_t lease_token, StreamId stream,
                              absl::Duration timeout);

  // A batch of the robot is sent when its clock says `sent_ns`. Nothing comes between in this
  // process, so the difference to the mission's clock is how far the robot's is off.
  absl::Status NoteClock(const RobotId& robot, std::int64_t lease_token, std::int64_t sent_ns);

  // Applies a batch in order; observations that the mission refuses are added to `rejected`.
  absl::Status Ingest(const RobotId& robot, std::int64_t lease_token, StreamId stream,
                      const std::vector<Observation>& batch,
                      std::vector<client::ObservationRejected>& rejected);

  absl::StatusOr<Plan> NextPlan(const client::PlanQuery& query);
  // For robots that are free, or named; they fetch it as their next plan. `budget` 0: the default.
  absl::StatusOr<CommittedTeam> PlanForTeam(const TeamRequest& request, absl::Duration budget);
  absl::Status Report(const ProgressReported& report, std::int64_t lease_token);
  // Looks at the live plans first, if that is due by the mission's sample time. The lease has to be
  // in force.
  absl::StatusOr<RobotNews> NewsOf(const RobotId& robot, std::int64_t lease_token);
  // Waits until the mission has another revision, has ended or is woken with `cancelled` set; false
  // after the deadline.
  bool AwaitChange(std::int64_t revision, absl::Time deadline, const std::atomic<bool>& cancelled);
  void Wake() { absl::MutexLock lock(&mutex_); }
  // With the posterior brought up to date.
  absl::StatusOr<std::shared_ptr<const Belief>> FreshBelief();
  std::shared_ptr<const Belief> Snapshot() const;

  // From now on every call of a robot fails with `status`, and every stream has ended so.
  void Close(const absl::Status& status);

 private:
  void LookAtPlans() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void OnEvent(const Event& event, const Applied& applied) override;

  std::int64_t Now_ns() const { return absl::ToUnixNanos(options_.clock()); }
  absl::Status UseLease(const RobotId& robot, std::int64_t lease_token)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status CheckStream(const RobotId& robot, std::int64_t lease_token, StreamId stream) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  client::IngestState State(const LogPosition& position) const;
  absl::StatusOr<std::shared_ptr<const Belief>> BeliefFor(const client::PlanQuery& query,
                                                          absl::Time deadline);

  const LocalOptions options_;
  const std::unique_ptr<const Strategy> strategy_;

  mutable absl::Mutex mutex_;
  MissionConduct conduct_ ABSL_GUARDED_BY(mutex_);
  LeaseBook leases_ ABSL_GUARDED_BY(mutex_);
  absl::Status closed_ ABSL_GUARDED_BY(mutex_);  // OK: it is open
  PlanWatch plan_watch_ ABSL_GUARDED_BY(mutex_);
  RobotNewsBook news_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::lab
