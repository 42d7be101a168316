// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/home_orders.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace plumescout {

PlanRequest WithOrders(const Belief& belief, PlanRequest request) {
  const auto found = belief.robots.find(request.robot);
  if (found != belief.robots.end() && IsSentHome(found->second)) request.go_home = true;
  return request;
}

std::string WhySentHome(const Belief& belief, const RobotId& robot) {
  const auto found = belief.robots.find(robot);
  if (found == belief.robots.end() || !IsSentHome(found->second)) return "";
  if (found->second.state.ordered_home) return " An operator ordered the robot home.";
  return absl::StrFormat(" Its battery, at %.0f %%, has been below %.0f %%: it goes home.",
                         100.0 * found->second.state.battery_share.value_or(0.0),
                         100.0 * belief.options->return_home_below_battery_share);
}

std::string WhyOver(const Belief& belief) {
  if (!IsOver(belief)) return "";
  if (belief.objective && IsConcluded(*belief.objective)) {
    return absl::StrCat(" ", Describe(*belief.objective, belief.options->objective));
  }
  return absl::StrFormat(" The deadline, %g s from the first observation, has passed.",
                         belief.options->objective.deadline_s);
}

}  // namespace plumescout
