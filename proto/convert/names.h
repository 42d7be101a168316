// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/ids.h"

namespace plumescout {

// Resource names: missions/{mission}, missions/{mission}/robots/{robot},
// missions/{mission}/plans/{plan}.

struct RobotName {
  MissionId mission;
  RobotId robot;

  friend bool operator==(const RobotName&, const RobotName&) = default;
};

struct PlanName {
  MissionId mission;
  PlanId plan = 0;

  friend bool operator==(const PlanName&, const PlanName&) = default;
};

std::string MissionResource(const MissionId& mission);
std::string RobotResource(const RobotName& name);
std::string PlanResource(const PlanName& name);

// kInvalidArgument naming `field` if the name has another form.
absl::StatusOr<MissionId> ParseMissionName(absl::string_view field, absl::string_view name);
absl::StatusOr<RobotName> ParseRobotName(absl::string_view field, absl::string_view name);
absl::StatusOr<PlanName> ParsePlanName(absl::string_view field, absl::string_view name);

}  // namespace plumescout
