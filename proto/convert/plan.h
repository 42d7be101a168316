// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/plan.h"
#include "plumescout/v1/planning_service.pb.h"

namespace plumescout {

v1::Goal ToProto(const Goal& goal);
v1::Candidate ToProto(const Candidate& candidate);
v1::RejectedGoal ToProto(const RejectedGoal& rejected);
v1::Trajectory ToProto(const Trajectory& trajectory);

// Resource names are built below `mission`; a plan that is not committed (id 0) has no name.
v1::Plan ToProto(const Plan& plan, const MissionId& mission);

// These check that every number is finite, that the choice is one of the candidates and that the
// trajectory does not go back in time.
absl::StatusOr<Goal> FromProto(const v1::Goal& proto, absl::string_view field);
absl::StatusOr<Candidate> FromProto(const v1::Candidate& proto, absl::string_view field);
absl::StatusOr<RejectedGoal> FromProto(const v1::RejectedGoal& proto, absl::string_view field);
absl::StatusOr<Trajectory> FromProto(const v1::Trajectory& proto, absl::string_view field);
absl::StatusOr<Plan> FromProto(const v1::Plan& proto, absl::string_view field);

}  // namespace plumescout
