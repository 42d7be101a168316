// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "core/belief/belief.h"
#include "core/mission/fleet.h"
#include "core/types/visit_types.h"

namespace plumescout {

void Visit(auto& archive, ConstOr<RobotRecord> auto& record) {
  auto& [state, plans_issued, fruitless_fallbacks, first_place, travelled_m, last_plan,
         live_trajectory, live_goal, live_arrival_ns, battery_low, heard_ns, assigned_plan,
         wanted_goal, wanted_since_ns, live_gone_s, pose_ns] = record;
  archive(state, plans_issued, fruitless_fallbacks, first_place, travelled_m, last_plan,
          live_trajectory, live_goal, live_arrival_ns);
  // heard_ns is of the fleet
  archive.Since(2, battery_low, assigned_plan, wanted_goal, wanted_since_ns);
  // They follow from the poses; missions of before have the hash that they had.
  if constexpr (!std::decay_t<decltype(archive)>::kHashes) {
    archive.Since(3, live_gone_s);
    archive.Since(5, pose_ns);
  }
}

template <typename Archive, typename Self>
void Fleet::LivePlan::VisitState(Archive& archive, Self& self) {
  auto& [id, phase, goal, expires_ns, map_update_ns, handed_back] = self;
  archive(id, phase, goal, expires_ns, map_update_ns);
  archive.Since(2, handed_back);
}

template <typename Archive, typename Self>
void Fleet::Member::VisitState(Archive& archive, Self& self) {
  auto& [record, odometer, lease_token, log_epoch, last_phase, live, heard_ns, sensors, removed,
         first_ns, clock] = self;
  archive(record, odometer, lease_token, log_epoch, last_phase, live, heard_ns, removed);
  archive.Since(2, sensors);
  // Every robot has one: with it missions of before would not have the hash that they had.
  if constexpr (!Archive::kHashes) {
    archive.Since(2, first_ns);
    archive.Since(4, clock);
  }
}

template <typename Archive, typename Self>
void Fleet::VisitState(Archive& archive, Self& self) {
  archive(self.robots_, self.next_plan_, self.phase_);
  archive.Since(2, self.has_offsets_);
}

}  // namespace plumescout
