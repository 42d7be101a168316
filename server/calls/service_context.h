// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "core/types/options.h"
#include "server/access/principal.h"
#include "server/base/fair_pool.h"
#include "server/base/request_memory.h"
#include "server/base/worker_pool.h"
#include "server/calls/active_streams.h"
#include "server/calls/door.h"
#include "server/history/history.h"
#include "server/missions/mission_registry.h"

namespace plumescout::server {

// Limits that the services enforce on single calls.
struct ServiceLimits {
  int max_batch_observations = 1024;
  int stream_window_observations = 128;  // in flight on one ingest stream
  absl::Duration default_planning_budget = absl::Seconds(1);
  absl::Duration max_planning_budget = absl::Seconds(5);
  absl::Duration deadline_margin = absl::Milliseconds(20);  // kept back for commit and reply
  // How long a call waits for a mission that is being recovered.
  absl::Duration recovery_patience = absl::Seconds(1);
  absl::Duration replay_period = absl::Milliseconds(100);  // between frames of a past map
  absl::Duration import_patience = absl::Seconds(30);      // for the next piece of an import
  absl::Duration export_patience = absl::Seconds(30);      // for a piece to be taken, or made
};

inline bool MaySeeTenant(const Principal& caller, absl::string_view tenant) {
  return caller.role == Role::kAdmin || tenant == caller.tenant;
}
inline bool MaySee(const Principal& caller, const MissionHost& host) {
  return MaySeeTenant(caller, host.tenant());
}

// What all services work on. Not owned; outlives them.
struct ServiceContext {
  const Door* door = nullptr;
  MissionRegistry* registry = nullptr;
  FairPool* planning_pool = nullptr;    // by tenant, mission and robot
  WorkerPool* map_pool = nullptr;       // frames for watchers
  FairPool* query_pool = nullptr;       // answers that take time; see TurnOf, as of the next
  FairPool* past_pool = nullptr;        // looks at what missions were, which take long
  WorkerPool* creation_pool = nullptr;  // of missions
  ActiveStreams* streams = nullptr;
  MissionOptions mission_defaults;
  ServiceLimits limits;
  std::string boot_id;
  std::shared_ptr<RequestMemory> requests = nullptr;  // of calls that make missions
  History* history = nullptr;                         // null: the server keeps no journal

  // kFailedPrecondition.
  absl::Status CheckKeepsHistory() const {
    if (history != nullptr) return absl::OkStatus();
    return absl::FailedPreconditionError("this server keeps no journal of its missions");
  }

  // The mission, if it is there and the caller may see it: the answer is the same otherwise.
  absl::StatusOr<std::shared_ptr<MissionHost>> FindMission(const Principal& caller,
                                                           const MissionId& id) const {
    auto host = registry->Find(id, caller.tenant);
    if (absl::IsNotFound(host.status()) && caller.role == Role::kAdmin) {
      host = registry->FindOfAnyTenant(id);
    }
    if (host.ok()) (*host)->standing().Touch();
    return host;
  }
  // The same for whoever acts for a robot.
  absl::StatusOr<std::shared_ptr<MissionHost>> FindMissionOf(const Principal& caller,
                                                             const RobotName& robot) const {
    const absl::Status acts = CheckActsFor(caller, robot);
    if (!acts.ok()) return acts;
    return FindMission(caller, robot.mission);
  }
};

}  // namespace plumescout::server
