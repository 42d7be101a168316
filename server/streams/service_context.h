// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/time/time.h"
#include "core/types/options.h"
#include "server/base/worker_pool.h"
#include "server/missions/mission_registry.h"
#include "server/streams/active_streams.h"

namespace plumescout::server {

// Limits that the services enforce on single calls.
struct ServiceLimits {
  int max_batch_observations = 1024;
  int stream_window_observations = 128;  // in flight on one ingest stream
  absl::Duration default_planning_budget = absl::Seconds(1);
  absl::Duration max_planning_budget = absl::Seconds(60);
  absl::Duration deadline_margin = absl::Milliseconds(20);  // kept back for commit and reply
};

// What all services work on. Not owned; outlives them.
struct ServiceContext {
  MissionRegistry* registry = nullptr;
  WorkerPool* planning_pool = nullptr;
  WorkerPool* map_pool = nullptr;
  ActiveStreams* streams = nullptr;
  MissionOptions mission_defaults;
  ServiceLimits limits;
  std::string boot_id;
};

}  // namespace plumescout::server
