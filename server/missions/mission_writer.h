// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "server/base/clock.h"
#include "server/base/worker_pool.h"
#include "server/missions/epoch_runner.h"
#include "server/missions/gas_timings.h"

namespace plumescout::server {

// Hears of every event in the order in which the mission applied it.
using EventSink = std::function<void(const Event&)>;

// Where a robot's log stands.
struct LogPosition {
  std::int64_t applied_sequence = 0;
  std::int64_t revision = 0;  // of the mission, which includes it
};

// An entry of a robot's log as it came over the wire. If it was `unreadable`, only the sequence of
// the observation is known.
struct IncomingObservation {
  Observation observation;
  absl::Status unreadable;
};

struct RefusedObservation {
  std::int64_t sequence = 0;
  absl::Status status;
};

// What became of a batch. `status` is not OK if the batch could not be applied to its end: a hole
// or a lost lease; `position` holds nevertheless.
struct IngestResult {
  absl::Status status;
  LogPosition position;
  std::vector<RefusedObservation> refused;
};

// What lists say of a mission.
struct MissionSummary {
  std::int64_t revision = 0;
  MissionPhase phase = MissionPhase::kExploring;
  std::optional<std::int64_t> next_map_update_ns;
};

// Turns commands into numbered events of one mission. Writes are fenced by the lease token at the
// moment they are applied. Single-threaded, but for summary() and gas_timings().
class MissionWriter {
 public:
  // `epoch_pool` recomputes the gas posterior at times; null: the writer does. It is not owned and
  // outlives the last call. The events are the same with any pool and clock.
  MissionWriter(std::unique_ptr<Mission> mission, EventSink sink, WorkerPool* epoch_pool = nullptr,
                SteadyClock clock = SteadyNow);

  const Mission& mission() const { return *mission_; }
  // From any thread. Never behind an event whose caller has been answered.
  MissionSummary summary() const;
  GasTimings gas_timings() const { return gas_timer_.timings(); }

  absl::StatusOr<LogPosition> Register(const RobotRegistered& registration);
  // Returns the revision that includes it. No token: whoever holds the lease.
  absl::StatusOr<std::int64_t> Remove(const RobotId& robot,
                                      std::optional<std::int64_t> lease_token);
  absl::StatusOr<LogPosition> Position(const RobotId& robot) const;

  // Applies a batch in order. Entries up to the applied sequence are passed over; refused ones
  // count as applied. An unreadable entry stands in the log as an empty scan, which every mission
  // refuses.
  IngestResult Ingest(const RobotId& robot, std::int64_t lease_token,
                      std::vector<IncomingObservation> batch);

  // Commits a plan; returns its number. kAborted if another robot claims the goal.
  absl::StatusOr<PlanId> Commit(const Plan& plan, std::int64_t lease_token);
  // Returns the revision that includes the report; a repeated report changes nothing.
  absl::StatusOr<std::int64_t> Report(const ProgressReported& report, std::int64_t lease_token);

  // Brings the posterior up to date and snapshots the mission.
  absl::StatusOr<std::shared_ptr<const Belief>> FreshBelief();
  std::shared_ptr<const Belief> Snapshot() const { return mission_->Snapshot(); }

  // For those who watch: a snapshot whose posterior holds every reading that was applied
  // `gas_wait` ago or earlier. If no observation has led to the refresh for that, this does.
  std::shared_ptr<const Belief> Publish(absl::Duration gas_wait);
  // When the first reading was applied that Publish has not given out; max() if there is none.
  SteadyTime unpublished_since() const { return gas_timer_.unpublished_since(); }
  // Nobody has watched until now.
  void BeginPublishing() { gas_timer_.Restart(clock_()); }

 private:
  absl::StatusOr<Applied> Apply(EventBody body);
  absl::Status CheckLease(const RobotId& robot, std::int64_t lease_token) const;
  absl::Status IngestOne(const RobotId& robot, IncomingObservation incoming, IngestResult& result);
  // What is due to the gas posterior. After every observation rather than every batch: so the
  // events do not depend on how a log was cut into batches.
  void KeepGasUp();
  absl::Status Refresh();
  absl::Status AdoptEpoch();
  absl::Status BeginEpoch();

  std::unique_ptr<Mission> mission_;
  EventSink sink_;
  const SteadyClock clock_;
  EpochRunner epoch_runner_;
  GasTimer gas_timer_;

  mutable absl::Mutex summary_mutex_;
  MissionSummary summary_ ABSL_GUARDED_BY(summary_mutex_);
};

}  // namespace plumescout::server
