// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/cell_state.h"
#include "core/types/event.h"
#include "core/types/frontier.h"
#include "core/types/objective.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/robot_notice.h"
#include "plumescout/v1/options.pb.h"
#include "plumescout/v1/planning_service.pb.h"
#include "plumescout/v1/robot_service.pb.h"
#include "plumescout/v1/types.pb.h"

namespace plumescout {

v1::MissionPhase ToProto(MissionPhase value);
v1::GoalKind ToProto(GoalKind value);
v1::GoalKind ToProto(FrontierKind value);
v1::Candidate::PathSource ToProto(PathSource value);
v1::RejectedGoal::Reason ToProto(RejectionReason value);
v1::Plan::End ToProto(PlanEnd value);
v1::PlanInvalidated::Reason ToProto(InvalidationReason value);
v1::ReportProgressRequest::Outcome ToProto(ProgressOutcome value);
v1::GasScale ToProto(GasScale value);
v1::GasPrecisions ToProto(GasPrecisions value);
v1::ObjectiveKind ToProto(ObjectiveKind value);
v1::ObjectiveStatus::State ToProto(ObjectiveState value);
v1::WgfdScope ToProto(WgfdScope value);
v1::GoalPolicy ToProto(GoalPolicy value);
v1::CostKind ToProto(CostKind value);
v1::SamplingKind ToProto(SamplingKind value);
v1::SelectionRule ToProto(SelectionRule value);
v1::SamplingReward ToProto(SamplingReward value);
v1::PathKind ToProto(PathKind value);
v1::CellState ToProto(std::optional<CellState> value);  // none: off the map

// kInvalidArgument naming `field` for unset and unknown values.
absl::StatusOr<MissionPhase> FromProto(v1::MissionPhase proto, absl::string_view field);
absl::StatusOr<GoalKind> FromProto(v1::GoalKind proto, absl::string_view field);
absl::StatusOr<FrontierKind> FrontierKindFromProto(v1::GoalKind proto, absl::string_view field);
absl::StatusOr<PathSource> FromProto(v1::Candidate::PathSource proto, absl::string_view field);
absl::StatusOr<RejectionReason> FromProto(v1::RejectedGoal::Reason proto, absl::string_view field);
absl::StatusOr<PlanEnd> FromProto(v1::Plan::End proto, absl::string_view field);
absl::StatusOr<InvalidationReason> FromProto(v1::PlanInvalidated::Reason proto,
                                             absl::string_view field);
absl::StatusOr<ProgressOutcome> FromProto(v1::ReportProgressRequest::Outcome proto,
                                          absl::string_view field);
absl::StatusOr<GasScale> FromProto(v1::GasScale proto, absl::string_view field);
absl::StatusOr<GasPrecisions> FromProto(v1::GasPrecisions proto, absl::string_view field);
absl::StatusOr<ObjectiveKind> FromProto(v1::ObjectiveKind proto, absl::string_view field);
absl::StatusOr<ObjectiveState> FromProto(v1::ObjectiveStatus::State proto, absl::string_view field);
absl::StatusOr<WgfdScope> FromProto(v1::WgfdScope proto, absl::string_view field);
absl::StatusOr<GoalPolicy> FromProto(v1::GoalPolicy proto, absl::string_view field);
absl::StatusOr<CostKind> FromProto(v1::CostKind proto, absl::string_view field);
absl::StatusOr<SamplingKind> FromProto(v1::SamplingKind proto, absl::string_view field);
absl::StatusOr<SelectionRule> FromProto(v1::SelectionRule proto, absl::string_view field);
absl::StatusOr<SamplingReward> FromProto(v1::SamplingReward proto, absl::string_view field);
absl::StatusOr<PathKind> FromProto(v1::PathKind proto, absl::string_view field);
// None: off the map.
absl::StatusOr<std::optional<CellState>> FromProto(v1::CellState proto, absl::string_view field);

}  // namespace plumescout
