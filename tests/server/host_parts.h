// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/mission/mission.h"
#include "core/plan/strategy.h"
#include "server/mission_host.h"
#include "server/mission_registry.h"
#include "tests/support/box_room.h"

namespace plumescout::server {

// A strategy that does what a test says.
class ScriptedStrategy final : public Strategy {
 public:
  using Script = std::function<absl::StatusOr<plumescout::Plan>(const Belief&, const PlanRequest&,
                                                                const StopFn&)>;

  explicit ScriptedStrategy(Script script) : script_(std::move(script)) {}
  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop) const override {
    return script_(belief, request, stop);
  }

 private:
  Script script_;
};

// Hooks of a registry whose missions plan by `script`.
inline RegistryHooks ScriptedHooks(ScriptedStrategy::Script script) {
  RegistryHooks hooks;
  hooks.make_strategy = [script = std::move(script)](const PlanningOptions&) {
    return std::make_unique<const ScriptedStrategy>(script);
  };
  return hooks;
}

// A plan that drives robot `robot` to (x, 0), made on `belief`.
inline Plan PlanTo(const Belief& belief, const RobotId& robot, double x_m) {
  Candidate candidate;
  candidate.goal.kind = GoalKind::kOccupancyFrontier;
  candidate.goal.position = {x_m, 0.0};
  candidate.path = {{0.0, 0.0}, {x_m, 0.0}};
  Plan plan;
  plan.robot = robot;
  plan.belief_revision = belief.revision;
  plan.candidates = {candidate};
  plan.chosen = 0;
  return plan;
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

}  // namespace plumescout::server
