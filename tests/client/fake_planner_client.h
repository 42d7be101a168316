// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "client/planner_client.h"

namespace plumescout::client {

Plan CompletePlan();

// A server of one mission and one robot that does what a test tells it to: lose the link, restart,
// refuse observations, answer plans from a script. Thread-safe.
class FakePlannerClient final : public PlannerClient {
 public:
  struct Report {
    PlanId plan = 0;
    ProgressOutcome outcome = ProgressOutcome::kReached;
    std::int64_t applied_sequence = 0;  // when the report came

    friend bool operator==(const Report&, const Report&) = default;
  };
  struct Registration {
    MissionId mission;
    RobotId robot;
    double radius_m = 0.0;
    bool take_over = false;
    std::int64_t log_epoch = 0;
    RobotOutfit outfit = {};

    friend bool operator==(const Registration&, const Registration&) = default;
  };
  using PlanScript = std::function<absl::StatusOr<Plan>(const PlanQuery&)>;

  // The default script says that the mission is complete.
  void set_script(PlanScript script);
  void set_credit_window(std::int64_t window);
  // Whether it keeps its data, and how many observations it is behind with that.
  void set_durable(bool durable, std::int64_t lag = 0);
  // What ReportProgress answers to reports that it would take.
  void set_report_answer(absl::Status answer);
  void RefuseObservation(std::int64_t sequence);

  // Whether it knows of watches; else they are kUnimplemented.
  void set_watched(bool watched);
  // What open watches are told.
  void Notify(RobotNotice notice);
  int watches_opened() const;

  // Every call fails and every stream is dead until the link is mended.
  void BreakLink();
  void MendLink();
  // Likewise, with this error.
  void BreakLink(absl::Status status);
  // Streams die and everything is forgotten, missions and robots too.
  void Restart();
  // Streams die; what was durable stays, leases too.
  void Crash();
  // As after a start from a copy of its data that ends with this observation; also the lease is
  // then an older one, if told so.
  void SetBack(std::int64_t applied, bool forget_lease = false);
  // Another client takes the lease, and holds it until it lets it go.
  void SupersedeLease();
  void LetGoOfLease();
  // Another client, which writes another log, takes the robot for a while: it adds observations.
  void Intrude(std::int64_t log_epoch, int observations);
  // A robot that was here before: its log up to `applied` is in the mission.
  void Preload(std::int64_t applied);

  std::vector<Observation> received() const;
  std::int64_t applied() const;
  // Whether it has applied the log up to there, or given so many plans, before the time is up.
  bool AwaitApplied(std::int64_t sequence, absl::Duration timeout) const;
  bool AwaitPlans(std::size_t count, absl::Duration timeout) const;
  std::vector<Report> reports() const;
  std::vector<Registration> registrations() const;
  int streams_opened() const;
  int largest_batch() const;
  std::int64_t robot_clock_ns() const;  // when the latest stream was opened; 0: it was not said

  absl::Status CreateMission(const MissionId&, const MissionOptions&) override;
  absl::StatusOr<std::vector<MissionId>> ListMissions() override;
  absl::Status DeleteMission(const MissionId&) override;
  using PlannerClient::RegisterRobot;
  absl::StatusOr<RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot,
                                             double radius_m, bool take_over,
                                             std::int64_t log_epoch,
                                             const RobotOutfit& outfit) override;
  absl::Status RemoveRobot(const MissionId&, const RobotId&, std::int64_t lease_token,
                           bool force) override;
  absl::StatusOr<std::unique_ptr<ObservationStream>> OpenObservationStream(
      const RobotSession& session) override;
  absl::StatusOr<Plan> NextBestTrajectory(const MissionId&, const PlanQuery& query) override;
  absl::Status ReportProgress(const RobotSession& session, PlanId plan,
                              ProgressOutcome outcome) override;
  absl::StatusOr<std::unique_ptr<RobotWatch>> WatchRobot(const RobotSession& session) override;
  absl::StatusOr<MapSnapshot> GetMap(const MissionId&) override;

 private:
  class Stream;
  class Watch;

  absl::Status LinkStatus() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status LeaseStatus(std::int64_t lease) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  IngestState State() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  std::int64_t DurableSequence() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  std::string BootId() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void FallBackTo(std::int64_t applied) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status Take(const Observation& observation, std::deque<IngestReply>& replies)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  mutable absl::Mutex mutex_;
  PlanScript script_ ABSL_GUARDED_BY(mutex_) = [](const PlanQuery&) { return CompletePlan(); };
  absl::Status report_answer_ ABSL_GUARDED_BY(mutex_);
  absl::Status link_ ABSL_GUARDED_BY(mutex_);  // OK: it is up
  bool mission_exists_ ABSL_GUARDED_BY(mutex_) = false;
  bool registered_ ABSL_GUARDED_BY(mutex_) = false;
  bool held_by_other_ ABSL_GUARDED_BY(mutex_) = false;
  bool durable_ ABSL_GUARDED_BY(mutex_) = false;
  std::int64_t durable_lag_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t durable_sequence_ ABSL_GUARDED_BY(mutex_) = 0;  // at least
  std::int64_t log_epoch_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t preloaded_ ABSL_GUARDED_BY(mutex_) = 0;
  int boot_ ABSL_GUARDED_BY(mutex_) = 1;
  int links_ ABSL_GUARDED_BY(mutex_) = 0;       // streams over an earlier one are dead
  int generation_ ABSL_GUARDED_BY(mutex_) = 0;  // of streams: older ones are dead
  int streams_opened_ ABSL_GUARDED_BY(mutex_) = 0;
  int largest_batch_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t robot_clock_ns_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t lease_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t applied_ ABSL_GUARDED_BY(mutex_) = 0;
  std::size_t plans_given_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t credit_window_ ABSL_GUARDED_BY(mutex_) = 100;
  std::set<std::int64_t> refused_ ABSL_GUARDED_BY(mutex_);
  std::vector<Observation> received_ ABSL_GUARDED_BY(mutex_);
  std::vector<Report> reports_ ABSL_GUARDED_BY(mutex_);
  std::vector<Registration> registrations_ ABSL_GUARDED_BY(mutex_);
  bool watched_ ABSL_GUARDED_BY(mutex_) = false;
  int watches_opened_ ABSL_GUARDED_BY(mutex_) = 0;
  std::vector<RobotNotice> notices_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::client
