// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/synchronization/mutex.h"
#include "core/types/options.h"
#include "server/missions/mission_host.h"
#include "server/missions/mission_reaper.h"
#include "server/missions/mission_strategy.h"

namespace plumescout::server {

struct RegistryOptions {
  int max_missions = 64;
  // Of all missions together, each counted with all that it may come to hold.
  std::int64_t memory_budget_bytes = std::numeric_limits<std::int64_t>::max();
  // What missions may choose for themselves at most.
  std::int64_t mission_memory_budget_bytes = std::numeric_limits<std::int64_t>::max();
  std::int64_t max_map_cell_count = std::numeric_limits<std::int64_t>::max();
  int max_beam_count = std::numeric_limits<int>::max();
  double max_range_m = std::numeric_limits<double>::infinity();
  HostOptions host;
};

// What a registry makes missions of; tests put their own here.
struct RegistryHooks {
  std::function<absl::StatusOr<std::unique_ptr<const Strategy>>(const PlanningOptions&)>
      make_strategy =
          [](const PlanningOptions& options) { return MakeMissionStrategy(options, Rivals::kOff); };
  // The sink of a new mission's events; may be empty.
  std::function<EventSink(const MissionId&, const MissionOptions&)> make_event_sink;
  // Recomputes gas posteriors; outlives the missions. Null: their writers do.
  WorkerPool* epoch_pool = nullptr;
  // Audits them; as above. Null: nobody does.
  WorkerPool* audit_pool = nullptr;
  // Hear of what missions do; outlive them.
  MissionMetrics* metrics = &MissionMetrics::Unread();
};

// A mission's name among those of all tenants. Each tenant has names of its own, so that nobody
// learns of another's missions by the names that are taken.
std::string MissionKey(absl::string_view tenant, const MissionId& id);

// All missions of a server, by key. Thread-safe; only AwaitStopped blocks. Missions are made
// outside the lock: a name and its room are reserved first, and nobody finds the mission before it
// is made.
class MissionRegistry {
 public:
  MissionRegistry(const RegistryOptions& options, RegistryHooks hooks);

  // ALREADY_EXISTS; kInvalidArgument naming the option if one is beyond what missions may choose;
  // before anything is allocated LIMIT_REACHED if the mission could outgrow the server, and
  // BUDGET_REACHED if its known map outgrows its own budget. May take long for a mission that
  // begins with a map.
  absl::StatusOr<std::shared_ptr<MissionHost>> Create(const MissionId& id,
                                                      const MissionOptions& options,
                                                      const MissionOwner& owner = {});
  absl::StatusOr<std::shared_ptr<MissionHost>> Find(const MissionId& id,
                                                    absl::string_view tenant = {}) const;
  // The one of this name, whosever it is; kFailedPrecondition if several tenants have one.
  absl::StatusOr<std::shared_ptr<MissionHost>> FindOfAnyTenant(const MissionId& id) const;
  // At most `limit` missions whose keys come after `after`, of those that are `wanted`, in order
  // of key.
  std::vector<std::shared_ptr<MissionHost>> List(
      const std::string& after, int limit,
      const std::function<bool(const MissionHost&)>& wanted = [](const MissionHost&) {
        return true;
      }) const;
  // The mission is off the list and ends with MISSION_NOT_FOUND. Its room is free once it has
  // stopped; then `stopped` is called, on another thread. On error it is not.
  absl::Status Delete(
      const MissionId& id, absl::string_view tenant = {}, std::function<void()> stopped = [] {});

  // Deletes those that have outlived their use, and that nobody but the registry holds: whoever
  // holds a mission uses it. Returns their names.
  std::vector<MissionId> DeleteIdle();

  // MissionHost::EndWaits of all; no mission is made from then on.
  void EndWaits(const absl::Status& status);
  // All missions are off the list and stop; what is queued is dropped.
  void StopAll(const absl::Status& status);
  // For those that were deleted too. False if some still run by then.
  bool AwaitStopped(SteadyTime deadline) { return reaper_.AwaitAll(deadline); }

 private:
  using Hosts = std::map<std::string, std::shared_ptr<MissionHost>>;

  void Reap(Hosts::iterator found, std::function<void()> stopped)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status CheckChoices(const MissionOptions& options) const;
  absl::Status CheckRoom(const MissionId& id, const std::string& key, std::int64_t bytes) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status Reserve(const MissionId& id, const std::string& key, std::int64_t bytes)
      ABSL_LOCKS_EXCLUDED(mutex_);
  absl::StatusOr<std::shared_ptr<MissionHost>> Make(const MissionId& id,
                                                    const MissionOptions& options,
                                                    const MissionOwner& owner) const;

  const RegistryOptions options_;
  const RegistryHooks hooks_;

  mutable absl::Mutex mutex_;
  Hosts hosts_ ABSL_GUARDED_BY(mutex_);
  std::set<std::string> being_made_ ABSL_GUARDED_BY(mutex_);
  std::int64_t reserved_bytes_ ABSL_GUARDED_BY(mutex_) = 0;  // of all of them
  int stopping_missions_ ABSL_GUARDED_BY(mutex_) = 0;        // deleted, but still there
  absl::Status closed_ ABSL_GUARDED_BY(mutex_);              // OK while missions may be made

  MissionReaper reaper_;  // goes first: what it calls uses the above
};

}  // namespace plumescout::server
