// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/gas_at_place.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/trajectory_verdict.h"
#include "plumescout/v1/map_service.pb.h"
#include "plumescout/v1/planning_service.pb.h"

namespace plumescout {

// What callers ask of a belief, and the answers.

inline constexpr int kMaxPoints = 4096;  // of one list: a request of 82 kB

// From 1 to kMaxPoints, each finite and within `limit_m` of the origin on both axes.
absl::StatusOr<std::vector<Point2>> PointsFromProto(
    const google::protobuf::RepeatedPtrField<v1::Point2D>& points, double limit_m,
    absl::string_view field);

// All but the revision.
v1::CheckTrajectoryResponse ToProto(const TrajectoryVerdict& check);
v1::FrontierGoal ToProto(const JudgedFrontier& frontier);
v1::GasAtPoint ToProto(const GasAtPlace& gas);

// kInvalidArgument naming the field of the answer.
absl::StatusOr<TrajectoryVerdict> FromProto(const v1::CheckTrajectoryResponse& proto);
absl::StatusOr<JudgedFrontier> FromProto(const v1::FrontierGoal& proto, absl::string_view field);
absl::StatusOr<GasAtPlace> FromProto(const v1::GasAtPoint& proto, absl::string_view field);

}  // namespace plumescout
