// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "core/types/options.h"
#include "core/types/stop.h"
#include "server/missions/mission_host.h"
#include "server/missions/mission_strategy.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

struct RegistryOptions {
  int max_missions = 64;
  int max_missions_per_tenant = 0;  // 0: as many
  // Of all missions together, each counted with all that it may come to hold.
  std::int64_t memory_budget_bytes = std::numeric_limits<std::int64_t>::max();
  // What missions may choose for themselves at most.
  std::int64_t mission_memory_budget_bytes = std::numeric_limits<std::int64_t>::max();
  std::int64_t max_map_cell_count = std::numeric_limits<std::int64_t>::max();
  int max_beam_count = std::numeric_limits<int>::max();
  double max_range_m = std::numeric_limits<double>::infinity();
  std::int64_t max_backlog_bytes = std::int64_t{64} << 20;  // of the store; see JournalHome
  // Missions that a store keeps and that nobody has used for so long leave memory.
  absl::Duration sleep_after = absl::InfiniteDuration();
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
  // Packs snapshots of them for the store; as above. Null: none are taken.
  WorkerPool* snapshot_pool = nullptr;
  // Keeps the missions, and outlives them. Null: they end with the process.
  MissionStore* store = nullptr;
  // Records them; as above. Null: nobody does.
  Recorder* recorder = nullptr;
  // What time it is in them; null: as RegistryOptions::host says.
  SteadyClock clock = nullptr;
  WallClock wall_clock = nullptr;
};

// A mission's name among those of all tenants. Each tenant has names of its own, so that nobody
// learns of another's missions by the names that are taken.
std::string MissionKey(absl::string_view tenant, const MissionId& id);

// Makes missions and revives those of the store, with what a registry gives to all of them.
// Thread-safe; blocks as long as a mission takes.
class MissionMaker {
 public:
  MissionMaker(const RegistryOptions& options, RegistryHooks hooks)
      : options_(options), hooks_(std::move(hooks)) {}

  // kInvalidArgument naming the option if one is beyond what missions may choose.
  absl::Status CheckChoices(const MissionOptions& options) const;
  // A new mission, which the store, if there is one, has durably. As MissionRegistry::Create.
  absl::StatusOr<std::shared_ptr<MissionHost>> Make(const MissionId& id,
                                                    const MissionOptions& options,
                                                    const MissionOwner& owner) const;
  // What the options of a stored mission say, which alone are read of it. REQUIRES: there is a
  // store.
  absl::StatusOr<std::int64_t> StoredBudget_bytes(const std::string& key) const;
  // REQUIRES: there is a store. As RecoverMission.
  absl::StatusOr<std::shared_ptr<MissionHost>> Revive(const std::string& key, const StopFn& stop,
                                                      std::int64_t* epoch = nullptr) const;

 private:
  std::shared_ptr<MissionHost> MakeHost(MissionHost::Parts parts, JournalHome home,
                                        const JournalStart& start) const;

  const RegistryOptions options_;
  const RegistryHooks hooks_;
};

}  // namespace plumescout::server
