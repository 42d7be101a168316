// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/names.h"

#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "proto/convert/field.h"

namespace plumescout {
namespace {

constexpr char kMissions[] = "missions";
constexpr char kRobots[] = "robots";
constexpr char kPlans[] = "plans";

bool IsId(absl::string_view id) { return ValidateId("id", id).ok(); }

// The two ids of missions/{id}/{collection}/{id}; false if the form is another.
bool Split(absl::string_view name, absl::string_view collection, std::string& parent,
           std::string& child) {
  const std::vector<std::string> parts = absl::StrSplit(name, '/');
  if (parts.size() != 4 || parts[0] != kMissions || parts[2] != collection) return false;
  parent = parts[1];
  child = parts[3];
  return IsId(parent);
}

}  // namespace

std::string MissionResource(const MissionId& mission) {
  return absl::StrCat(kMissions, "/", mission);
}

std::string RobotResource(const RobotName& name) {
  return absl::StrCat(kMissions, "/", name.mission, "/", kRobots, "/", name.robot);
}

std::string PlanResource(const PlanName& name) {
  return absl::StrCat(kMissions, "/", name.mission, "/", kPlans, "/", name.plan);
}

absl::StatusOr<MissionId> ParseMissionName(absl::string_view field, absl::string_view name) {
  const std::vector<std::string> parts = absl::StrSplit(name, '/');
  if (parts.size() == 2 && parts[0] == kMissions && IsId(parts[1])) return parts[1];
  return FieldError(field, name, "must be missions/{mission}");
}

absl::StatusOr<RobotName> ParseRobotName(absl::string_view field, absl::string_view name) {
  RobotName parsed;
  if (Split(name, kRobots, parsed.mission, parsed.robot) && IsId(parsed.robot)) return parsed;
  return FieldError(field, name, "must be missions/{mission}/robots/{robot}");
}

absl::StatusOr<PlanName> ParsePlanName(absl::string_view field, absl::string_view name) {
  PlanName parsed;
  std::string plan;
  if (Split(name, kPlans, parsed.mission, plan) && absl::SimpleAtoi(plan, &parsed.plan) &&
      parsed.plan > 0 && plan == absl::StrCat(parsed.plan)) {
    return parsed;
  }
  return FieldError(field, name, "must be missions/{mission}/plans/{plan}, plans from 1");
}

}  // namespace plumescout
