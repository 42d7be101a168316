// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_messages.h"

#include <cmath>

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "proto/convert/robot.h"
#include "proto/convert/robot_frame.h"

namespace plumescout::client {
namespace {

constexpr double kMostOffset_s = 9e9;  // what nanoseconds can say

RobotLink LinkFromProto(v1::RobotLink link) {
  switch (link) {
    case v1::ROBOT_LINK_STREAMING:
      return RobotLink::kStreaming;
    case v1::ROBOT_LINK_IDLE:
      return RobotLink::kIdle;
    case v1::ROBOT_LINK_SILENT:
      return RobotLink::kSilent;
    case v1::ROBOT_LINK_GONE:
      return RobotLink::kGone;
    default:
      return RobotLink::kUnknown;  // of a newer server
  }
}

absl::StatusOr<RobotState> StateFromProto(const v1::Robot& proto) {
  PLUMESCOUT_ASSIGN_OR_RETURN(RobotState state, FromProto(proto.on_map(), "robot.on_map"));
  if (proto.has_frame()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(state.frame, FromProto(proto.frame(), "robot.frame"));
  }
  if (proto.has_battery_share()) state.battery_share = proto.battery_share();
  state.ordered_home = proto.ordered_home();
  return state;
}

}  // namespace

v1::RegisterRobotRequest RegistrationOf(const Participation& participation) {
  v1::RegisterRobotRequest request;
  request.set_mission(MissionResource(participation.mission));
  request.set_robot_id(participation.robot);
  request.set_radius_m(participation.radius_m);
  request.set_take_over(participation.take_over);
  request.set_log_epoch(participation.log_epoch);
  if (participation.frame != RobotFrame()) *request.mutable_frame() = ToProto(participation.frame);
  ToProto(participation.sensors, request);
  return request;
}

absl::StatusOr<RobotDetails> DetailsFromProto(const v1::Robot& proto) {
  RobotDetails details;
  PLUMESCOUT_ASSIGN_OR_RETURN(details.state, StateFromProto(proto));
  if (proto.has_clock_offset_s()) {
    PLUMESCOUT_RETURN_IF_ERROR(
        CheckRange("robot.clock_offset_s", proto.clock_offset_s(), -kMostOffset_s, kMostOffset_s));
    constexpr double kNanosecondsPerSecond = 1e9;
    details.state.clock_offset_ns = std::llround(proto.clock_offset_s() * kNanosecondsPerSecond);
    details.clock_offset_ns = details.state.clock_offset_ns;
  }
  details.link = LinkFromProto(proto.link());
  details.leased = proto.leased();
  if (proto.has_last_heard_age_s()) details.last_heard_age_s = proto.last_heard_age_s();
  if (proto.has_ingest_lag_s()) details.ingest_lag_s = proto.ingest_lag_s();
  if (!proto.live_plan().empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const PlanName plan,
                                ParsePlanName("robot.live_plan", proto.live_plan()));
    details.live_plan =
        PlanProgress{plan.plan, proto.progress_s(), proto.lateness_s(), proto.arrival_time_ns()};
  }
  details.battery_low = proto.battery_low();
  if (proto.has_home()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(details.home, FromProto(proto.home(), "robot.home"));
  }
  return details;
}

}  // namespace plumescout::client
