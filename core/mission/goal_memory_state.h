// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/belief/belief.h"
#include "core/mission/goal_memory.h"
#include "core/types/visit_types.h"

namespace plumescout {

void Visit(auto& archive, ConstOr<SetAsideGoal> auto& aside) {
  auto& [goal, reason, expires_ns] = aside;
  archive(goal, reason, expires_ns);
}

template <typename Archive, typename Self>
void GoalMemory::VisitedGoal::VisitState(Archive& archive, Self& self) {
  auto& [goal, visits, last_ns, states_then, variance_then_ppm2] = self;
  archive(goal, visits, last_ns, variance_then_ppm2);
  archive.Runs(states_then);
}

template <typename Archive, typename Self>
void GoalMemory::Entry::VisitState(Archive& archive, Self& self) {
  auto& [aside, states_then] = self;
  archive(aside);
  archive.Runs(states_then);
}

template <typename Archive, typename Self>
void GoalMemory::VisitState(Archive& archive, Self& self) {
  archive(self.visited_, self.set_aside_);
}

}  // namespace plumescout
