// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/plan/composed_strategy.h"
#include "core/plan/plan_start.h"
#include "core/plan/sampling/sampling_rule.h"
#include "core/plan/strategy.h"

namespace plumescout {

// Robots that stop at the sites of a lattice and sample, one errand after the other: [IPP] and
// [LHR], and their baselines. Which sites come next is up to the rule.
class SamplingStrategy : public Strategy {
 public:
  // `home` plans the way home. Without a region sites cover the map.
  // REQUIRES: Validate(options).ok(), and MakeSiteLattice takes their region.
  SamplingStrategy(const PlanningOptions& options, std::unique_ptr<const SamplingRule> rule,
                   std::unique_ptr<const Strategy> home)
      : options_(options), rule_(std::move(rule)), home_(std::move(home)) {}

  // As Strategy says; also kFailedPrecondition "OUTSIDE_REGION" if the robot stands outside the
  // region. The mission is complete when no site is left to sample.
  using Strategy::Plan;
  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop,
                                        const PlanListener& improved) const override;

 private:
  absl::Status CheckInside(const RobotId& robot, Point2 place) const;
  // From a place to start to the candidates and the choice.
  absl::Status PlanFrom(const Belief& belief, const StopFn& stop, PlanStart& start) const;
  void Conclude(const SamplingChoice& choice, PlanStart& start) const;

  PlanningOptions options_;
  std::unique_ptr<const SamplingRule> rule_;
  std::unique_ptr<const Strategy> home_;
};

}  // namespace plumescout
