// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/objective.h"

#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"

namespace plumescout {

v1::ObjectiveStatus ToProto(const ObjectiveStatus& status) {
  v1::ObjectiveStatus proto;
  proto.set_state(ToProto(status.state));
  proto.set_confidence(status.confidence);
  proto.set_undecided_area_m2(status.undecided_area_m2);
  proto.set_open_frontier_count(status.open_frontiers);
  if (status.place) *proto.mutable_place() = ToProto(*status.place);
  proto.set_mean_ppm(status.mean_ppm);
  proto.set_stddev_ppm(status.stddev_ppm);
  if (status.strongest) *proto.mutable_strongest() = ToProto(*status.strongest);
  proto.set_since_ns(status.since_ns);
  return proto;
}

absl::StatusOr<ObjectiveStatus> FromProto(const v1::ObjectiveStatus& proto,
                                          absl::string_view field) {
  ObjectiveStatus status;
  PLUMESCOUT_ASSIGN_OR_RETURN(status.state, FromProto(proto.state(), Join(field, "state")));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "confidence"), proto.confidence()));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckFinite(Join(field, "undecided_area_m2"), proto.undecided_area_m2()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "mean_ppm"), proto.mean_ppm()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "stddev_ppm"), proto.stddev_ppm()));
  status.confidence = proto.confidence();
  status.undecided_area_m2 = proto.undecided_area_m2();
  status.open_frontiers = proto.open_frontier_count();
  status.mean_ppm = proto.mean_ppm();
  status.stddev_ppm = proto.stddev_ppm();
  status.since_ns = proto.since_ns();
  if (proto.has_place()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(status.place, FromProto(proto.place(), Join(field, "place")));
  }
  if (proto.has_strongest()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(status.strongest,
                                FromProto(proto.strongest(), Join(field, "strongest")));
  }
  return status;
}

}  // namespace plumescout
