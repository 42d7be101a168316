// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/mission/mission.h"
#include "server/missions/mission_host.h"
#include "server/missions/mission_registry.h"
#include "tests/support/box_room.h"
#include "tests/support/room_run.h"
#include "tests/support/scripted_strategy.h"

namespace plumescout::server {

using support::PlanTo;
using support::ScriptedStrategy;

// Hooks of a registry whose missions plan by `script`.
inline RegistryHooks ScriptedHooks(ScriptedStrategy::Script script) {
  RegistryHooks hooks;
  hooks.make_strategy = [script = std::move(script)](const PlanningOptions&) {
    return std::make_unique<const ScriptedStrategy>(script);
  };
  return hooks;
}

// The same with better plans on the way.
inline RegistryHooks AnytimeHooks(ScriptedStrategy::AnytimeScript script) {
  RegistryHooks hooks;
  hooks.make_strategy = [script = std::move(script)](const PlanningOptions&) {
    return std::make_unique<const ScriptedStrategy>(script);
  };
  return hooks;
}

inline MissionHost::Parts HostParts(ScriptedStrategy::Script script = nullptr,
                                    EventSink sink = nullptr) {
  return {"hall", std::make_unique<Mission>(MissionOptions{}),
          std::make_unique<const ScriptedStrategy>(std::move(script)), std::move(sink)};
}

// Entries first .. last of a robot's log: gas readings at the origin.
inline std::vector<IncomingObservation> GasBatch(std::int64_t first, std::int64_t last) {
  std::vector<IncomingObservation> batch;
  for (std::int64_t sequence = first; sequence <= last; ++sequence) {
    batch.push_back({{sequence, sequence * 1'000'000, {0.5, 0.5, 0.0}, GasReading{1.0, 0.0}},
                     absl::OkStatus()});
  }
  return batch;
}

inline std::vector<IncomingObservation> RoomRunBatch() {
  std::vector<IncomingObservation> batch;
  for (Observation& observation : support::RoomRun()) {
    batch.push_back({std::move(observation), absl::OkStatus()});
  }
  return batch;
}

}  // namespace plumescout::server
