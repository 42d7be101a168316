// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <prometheus/registry.h>

#include <cstdint>
#include <string>
#include <vector>

#include "server/base/clock.h"
#include "server/base/pool_load.h"
#include "server/calls/active_streams.h"
#include "server/missions/mission_registry.h"
#include "server/missions/stray_calls.h"
#include "server/observe/call_metrics.h"
#include "server/observe/mission_metrics.h"
#include "server/store/mission_store.h"
#include "server/store_usage.h"

namespace plumescout::server {

// What is looked at when metrics are asked for. Not owned.
struct ServerState {
  const MissionRegistry* missions = nullptr;
  const ActiveStreams* streams = nullptr;
  std::vector<PoolLoad> pools = {};
  std::string boot_id = {};
  SteadyTime began = {};
  int max_missions = 0;
  std::int64_t memory_budget_bytes = 0;  // of all missions
  // Missions beyond these, in order of name, have no series: those cost whoever keeps them.
  int max_mission_series = 100;
  bool draining = false;
  const MissionStore* store = nullptr;  // null: none
  StoreUsage::Sizes store_sizes = {};
  StrayFigures strays = {};
};

// All metrics of a server: what was counted and timed so far, and how things stand.
// docs/operations.md lists them. Thread-safe.
class ServerMetrics {
 public:
  ServerMetrics() : calls_(registry_), missions_(registry_) {}
  ServerMetrics(const ServerMetrics&) = delete;
  ServerMetrics& operator=(const ServerMetrics&) = delete;

  CallMetrics& calls() { return calls_; }
  MissionMetrics& missions() { return missions_; }

  // Everything in Prometheus' text format.
  std::string Text(const ServerState& state) const;

 private:
  prometheus::Registry registry_;  // first: the others keep their figures there
  CallMetrics calls_;
  MissionMetrics missions_;
};

}  // namespace plumescout::server
