// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/robot_frame.h"

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"

namespace plumescout {

v1::RobotFrame ToProto(const RobotFrame& frame) {
  v1::RobotFrame proto;
  *proto.mutable_mission_from_robot() = ToProto(frame.mission_from_robot);
  proto.set_position_stddev_m(frame.position_stddev_m);
  proto.set_heading_stddev_rad(frame.heading_stddev_rad);
  return proto;
}

absl::StatusOr<RobotFrame> FromProto(const v1::RobotFrame& proto, absl::string_view field) {
  RobotFrame frame;
  PLUMESCOUT_ASSIGN_OR_RETURN(
      frame.mission_from_robot,
      FromProto(proto.mission_from_robot(), Join(field, "mission_from_robot")));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckNotNegative(Join(field, "position_stddev_m"), proto.position_stddev_m()));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckNotNegative(Join(field, "heading_stddev_rad"), proto.heading_stddev_rad()));
  frame.position_stddev_m = proto.position_stddev_m();
  frame.heading_stddev_rad = proto.heading_stddev_rad();
  return frame;
}

}  // namespace plumescout
