// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "core/mission/mission.h"
#include "server/missions/mission_host.h"
#include "server/missions/mission_registry.h"
#include "tests/support/ingest_batch.h"
#include "tests/support/scripted_strategy.h"

namespace plumescout::server {

using support::GasBatch;
using support::PlanTo;
using support::RoomRunBatch;
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

}  // namespace plumescout::server
