// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>

#include "absl/status/statusor.h"
#include "core/plan/strategy.h"

namespace plumescout::support {

// A strategy that does what a test says.
class ScriptedStrategy final : public Strategy {
 public:
  using Script = std::function<absl::StatusOr<plumescout::Plan>(const Belief&, const PlanRequest&,
                                                                const StopFn&)>;
  // The same of a search with better plans on the way.
  using AnytimeScript = std::function<absl::StatusOr<plumescout::Plan>(
      const Belief&, const PlanRequest&, const StopFn&, const PlanListener&)>;

  explicit ScriptedStrategy(Script script)
      : script_([script = std::move(script)](const Belief& belief, const PlanRequest& request,
                                             const StopFn& stop, const PlanListener&) {
          return script(belief, request, stop);
        }) {}
  explicit ScriptedStrategy(AnytimeScript script) : script_(std::move(script)) {}
  using Strategy::Plan;
  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop,
                                        const PlanListener& improved) const override {
    return script_(belief, request, stop, improved);
  }

 private:
  AnytimeScript script_;
};

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

}  // namespace plumescout::support
