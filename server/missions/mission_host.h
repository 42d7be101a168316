// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "core/belief/belief.h"
#include "core/plan/strategy.h"
#include "server/base/clock.h"
#include "server/missions/belief_waiters.h"
#include "server/missions/lease_table.h"
#include "server/missions/mission_writer.h"

namespace plumescout::server {

struct HostOptions {
  int max_queued_observations = 4096;
  int max_queued_commands = 4096;
  int max_waiters = 256;
  // Watchers see a new belief at most this often; but a reading ...
  absl::Duration publish_period = absl::Milliseconds(100);
  // ... that was acknowledged is in the posterior that they see after this at the latest.
  absl::Duration gas_wait = absl::Milliseconds(60);
  absl::Duration lease_hold = absl::Seconds(10);
  std::int64_t first_lease_token = 1;
  SteadyClock clock = SteadyNow;
};

// Runs one mission: a writer thread that takes commands from a bounded queue, and the belief it
// publishes. No call blocks but Stop. Callbacks run on the writer's thread and must not block.
// Thread-safe.
class MissionHost {
 public:
  using Command = std::function<void(MissionWriter&)>;
  // Told of new beliefs until it returns false; an error is the last call.
  using Subscriber = std::function<bool(absl::StatusOr<std::shared_ptr<const Belief>>)>;

  struct Parts {
    MissionId id;
    std::unique_ptr<Mission> mission;
    std::unique_ptr<const Strategy> strategy;
    EventSink sink;
    WorkerPool* epoch_pool = nullptr;  // of the writer, as is the next; see MissionWriter
    WorkerPool* audit_pool = nullptr;
  };

  MissionHost(Parts parts, const HostOptions& options);
  // REQUIRES: not called on the writer's thread, or after Stop.
  ~MissionHost();
  MissionHost(const MissionHost&) = delete;
  MissionHost& operator=(const MissionHost&) = delete;

  const MissionId& id() const { return id_; }
  const MissionOptions& options() const { return mission_options_; }
  const Strategy& strategy() const { return *strategy_; }
  LeaseTable& leases() { return leases_; }
  MissionSummary summary() const { return writer_.summary(); }
  GasTimings gas_timings() const { return writer_.gas_timings(); }

  // Claims room in the queue for observations that will be posted. OVERLOADED if there is none.
  absl::Status Reserve(int observations);
  void Release(int observations);

  // The writer runs the command, after all earlier ones. OVERLOADED if too many wait; the status
  // given to Stop once the host stops.
  absl::Status Post(Command command);
  absl::Status AwaitBelief(BeliefRequest request, BeliefCallback done);
  // The present belief at once, then new ones as HostOptions say.
  absl::Status Subscribe(Subscriber subscriber);
  // Looks again whether those who wait still do.
  void Wake();

  // Runs what is queued, fails who waits, ends all streams with `status`, and joins the writer.
  void Stop(const absl::Status& status);

 private:
  void Run();
  // Waits for commands until then. False if the host is to stop and none are left. REQUIRES:
  // `commands` is empty.
  bool TakeCommands(SteadyTime until, std::vector<Command>& commands);
  bool HasWork() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return !commands_.empty() || stopping_;
  }
  void AfterCommands();
  SteadyTime next_publication() const;  // max() if there is nothing new or nobody to tell
  void Publish(const absl::StatusOr<std::shared_ptr<const Belief>>& belief);
  SteadyTime NextWake() const;

  const MissionId id_;
  const HostOptions host_options_;
  const MissionOptions mission_options_;
  const std::unique_ptr<const Strategy> strategy_;
  LeaseTable leases_;

  absl::Mutex mutex_;
  std::vector<Command> commands_ ABSL_GUARDED_BY(mutex_);
  int reserved_observations_ ABSL_GUARDED_BY(mutex_) = 0;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  absl::Status stop_status_ ABSL_GUARDED_BY(mutex_);

  // Touched by the writer's thread only, but for the writer's summary.
  MissionWriter writer_;
  BeliefWaiters waiters_;
  std::vector<Subscriber> subscribers_;
  std::int64_t published_revision_ = 0;
  SteadyTime published_at_;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::server
