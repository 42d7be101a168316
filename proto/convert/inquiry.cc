// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/inquiry.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/plan.h"

namespace plumescout {
namespace {

// The one below overloads these rather than hides them.
using plumescout::FromProto;

absl::StatusOr<Blockage> FromProto(const v1::Blockage& proto, absl::string_view field) {
  Blockage blockage;
  blockage.cell = FromProto(proto.cell());
  PLUMESCOUT_ASSIGN_OR_RETURN(blockage.position,
                              FromProto(proto.position(), Join(field, "position")));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "distance_m"), proto.distance_m()));
  blockage.distance_m = proto.distance_m();
  PLUMESCOUT_ASSIGN_OR_RETURN(blockage.state, FromProto(proto.state(), Join(field, "state")));
  return blockage;
}

}  // namespace

absl::StatusOr<std::vector<Point2>> PointsFromProto(
    const google::protobuf::RepeatedPtrField<v1::Point2D>& points, double limit_m,
    absl::string_view field) {
  if (points.empty() || points.size() > kMaxPoints) {
    return FieldError(field, absl::StrCat(points.size(), " points"),
                      absl::StrCat("must be 1 to ", kMaxPoints));
  }
  std::vector<Point2> result;
  for (int i = 0; i < points.size(); ++i) {
    const std::string item = Join("", field, i);
    PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 point, FromProto(points.Get(i), item));
    PLUMESCOUT_RETURN_IF_ERROR(CheckRange(Join(item, "x_m"), point.x_m, -limit_m, limit_m));
    PLUMESCOUT_RETURN_IF_ERROR(CheckRange(Join(item, "y_m"), point.y_m, -limit_m, limit_m));
    result.push_back(point);
  }
  return result;
}

v1::CheckTrajectoryResponse ToProto(const TrajectoryVerdict& check) {
  v1::CheckTrajectoryResponse proto;
  if (check.blockage) {
    v1::Blockage& blockage = *proto.mutable_blockage();
    *blockage.mutable_cell() = ToProto(check.blockage->cell);
    *blockage.mutable_position() = ToProto(check.blockage->position);
    blockage.set_distance_m(check.blockage->distance_m);
    blockage.set_state(ToProto(check.blockage->state));
  }
  if (check.rejection) *proto.mutable_rejected_goal() = ToProto(*check.rejection);
  if (check.rest) *proto.mutable_rest() = ToProto(*check.rest);
  return proto;
}

v1::FrontierGoal ToProto(const JudgedFrontier& frontier) {
  v1::FrontierGoal proto;
  *proto.mutable_goal() = ToProto(frontier.goal);
  if (frontier.travel_m) proto.set_travel_m(*frontier.travel_m);
  if (frontier.rejection) {
    proto.set_reason(ToProto(frontier.rejection->reason));
    proto.set_detail(frontier.rejection->detail);
  }
  return proto;
}

v1::GasAtPoint ToProto(const GasAtPlace& gas) {
  v1::GasAtPoint proto;
  proto.set_state(ToProto(gas.state));
  if (gas.mean_ppm) proto.set_mean_ppm(*gas.mean_ppm);
  if (gas.variance_ppm2) proto.set_variance_ppm2(*gas.variance_ppm2);
  proto.set_observed(gas.observed);
  if (gas.nearest_reading) {
    proto.set_nearest_reading_m(gas.nearest_reading->distance_m);
    if (gas.nearest_reading->time_ns) {
      proto.set_nearest_reading_time_ns(*gas.nearest_reading->time_ns);
    }
  }
  if (gas.verdict) proto.set_verdict(ToProto(*gas.verdict));
  return proto;
}

absl::StatusOr<TrajectoryVerdict> FromProto(const v1::CheckTrajectoryResponse& proto) {
  TrajectoryVerdict verdict;
  if (proto.has_blockage()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(verdict.blockage, FromProto(proto.blockage(), "blockage"));
  }
  if (proto.has_rejected_goal()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(verdict.rejection,
                                FromProto(proto.rejected_goal(), "rejected_goal"));
  }
  if (proto.has_rest()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(verdict.rest, FromProto(proto.rest(), "rest"));
  }
  return verdict;
}

absl::StatusOr<JudgedFrontier> FromProto(const v1::FrontierGoal& proto, absl::string_view field) {
  JudgedFrontier frontier;
  PLUMESCOUT_ASSIGN_OR_RETURN(frontier.goal, FromProto(proto.goal(), Join(field, "goal")));
  if (proto.has_travel_m()) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "travel_m"), proto.travel_m()));
    frontier.travel_m = proto.travel_m();
  }
  if (proto.reason() != v1::RejectedGoal::REASON_UNSPECIFIED) {
    frontier.rejection.emplace();
    frontier.rejection->goal = frontier.goal;
    frontier.rejection->detail = proto.detail();
    PLUMESCOUT_ASSIGN_OR_RETURN(frontier.rejection->reason,
                                FromProto(proto.reason(), Join(field, "reason")));
  }
  return frontier;
}

absl::StatusOr<GasAtPlace> FromProto(const v1::GasAtPoint& proto, absl::string_view field) {
  GasAtPlace gas;
  PLUMESCOUT_ASSIGN_OR_RETURN(gas.state, FromProto(proto.state(), Join(field, "state")));
  if (proto.has_mean_ppm()) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "mean_ppm"), proto.mean_ppm()));
    gas.mean_ppm = proto.mean_ppm();
  }
  if (proto.has_variance_ppm2()) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "variance_ppm2"), proto.variance_ppm2()));
    gas.variance_ppm2 = proto.variance_ppm2();
  }
  gas.observed = proto.observed();
  if (proto.has_nearest_reading_m()) {
    const double distance_m = proto.nearest_reading_m();
    PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "nearest_reading_m"), distance_m));
    gas.nearest_reading.emplace().distance_m = distance_m;
    if (proto.has_nearest_reading_time_ns()) {
      gas.nearest_reading->time_ns = proto.nearest_reading_time_ns();
    }
  }
  if (proto.verdict() != v1::OBJECTIVE_VERDICT_UNSPECIFIED) {
    PLUMESCOUT_ASSIGN_OR_RETURN(gas.verdict, FromProto(proto.verdict(), Join(field, "verdict")));
  }
  return gas;
}

}  // namespace plumescout
