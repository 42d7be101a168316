// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "core/types/options.h"
#include "server/missions/mission_host.h"
#include "server/missions/mission_strategy.h"

namespace plumescout::server {

struct RegistryOptions {
  int max_missions = 64;
  // Bound on the memory of all maps together, in the unit in which missions bound theirs.
  std::int64_t max_total_cells = 128'000'000;
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
};

// The most cells that a mission's map can come to have.
std::int64_t CellBound(const OccupancyOptions& options);

// All missions of a server, by name. Thread-safe; only StopAll blocks.
class MissionRegistry {
 public:
  MissionRegistry(const RegistryOptions& options, RegistryHooks hooks);

  // ALREADY_EXISTS; LIMIT_REACHED before anything is allocated if the map could outgrow the server.
  absl::StatusOr<std::shared_ptr<MissionHost>> Create(const MissionId& id,
                                                      const MissionOptions& options);
  absl::StatusOr<std::shared_ptr<MissionHost>> Find(const MissionId& id) const;
  // At most `limit` missions whose names come after `after`, in order of name.
  std::vector<std::shared_ptr<MissionHost>> List(const MissionId& after, int limit) const;
  // Takes the mission off the list; the caller stops it.
  absl::StatusOr<std::shared_ptr<MissionHost>> Remove(const MissionId& id);

  void StopAll(const absl::Status& status);

 private:
  absl::Status CheckRoom(const MissionId& id, std::int64_t cells) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const RegistryOptions options_;
  const RegistryHooks hooks_;

  mutable absl::Mutex mutex_;
  std::map<MissionId, std::shared_ptr<MissionHost>> hosts_ ABSL_GUARDED_BY(mutex_);
  std::int64_t reserved_cells_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace plumescout::server
