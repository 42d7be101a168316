// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/robot_message.h"

#include <optional>

#include "core/traffic/traffic.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/map.h"

namespace plumescout::server {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

double Since_s(std::int64_t time_ns, std::int64_t now_ns) {
  return static_cast<double>(now_ns - time_ns) * kSecondsPerNanosecond;
}

v1::RobotLink LinkOf(const RobotState& robot, const LeaseStanding& lease) {
  if (!lease.held) return v1::ROBOT_LINK_GONE;
  if (robot.silent) return v1::ROBOT_LINK_SILENT;
  return lease.streaming ? v1::ROBOT_LINK_STREAMING : v1::ROBOT_LINK_IDLE;
}

void DescribeClock(const RobotRecord& record, const MissionHost& host, v1::Robot& proto) {
  const std::optional<LinkTimes> link = host.robot_clocks().LinkOf(record.state.id);
  if (record.state.clock_offset_ns != 0) {
    proto.set_clock_offset_s(static_cast<double>(record.state.clock_offset_ns) *
                             kSecondsPerNanosecond);
  }
  if (!link) return;
  const std::int64_t now_ns = host.clock().now_ns();
  proto.set_last_heard_age_s(Since_s(link->heard_ns, now_ns));
  if (link->newest_sample_ns) proto.set_ingest_lag_s(Since_s(*link->newest_sample_ns, now_ns));
}

void DescribePlan(const RobotRecord& record, const Belief& belief, const MissionId& mission,
                  v1::Robot& proto) {
  const bool drives = record.state.has_pose && record.live_trajectory != nullptr &&
                      !record.live_trajectory->waypoints.empty();
  if (!drives) return;
  proto.set_live_plan(PlanResource({mission, record.last_plan}));
  proto.set_progress_s(Progress_s(record, belief.sample_time_ns));
  proto.set_lateness_s(Lateness_s(record, belief.sample_time_ns));
  proto.set_arrival_time_ns(record.live_arrival_ns);
}

}  // namespace

v1::Robot DescribeRobot(const RobotRecord& record, const Belief& belief, MissionHost& host) {
  const RobotState& robot = record.state;
  const LeaseStanding lease = host.leases().Standing(robot.id);
  v1::Robot proto;
  *proto.mutable_on_map() = ToProto(robot, host.id());
  proto.set_leased(lease.held);
  proto.set_streaming(lease.streaming);
  proto.set_link(LinkOf(robot, lease));
  DescribeClock(record, host, proto);
  if (robot.frame != RobotFrame{}) {
    *proto.mutable_frame()->mutable_mission_from_robot() = ToProto(robot.frame.mission_from_robot);
    proto.mutable_frame()->set_position_stddev_m(robot.frame.position_stddev_m);
    proto.mutable_frame()->set_heading_stddev_rad(robot.frame.heading_stddev_rad);
  }
  DescribePlan(record, belief, host.id(), proto);
  if (robot.battery_share) proto.set_battery_share(*robot.battery_share);
  proto.set_ordered_home(robot.ordered_home);
  proto.set_battery_low(record.battery_low);
  const std::optional<Point2> home =
      belief.options->home ? belief.options->home : record.first_place;
  if (home) *proto.mutable_home() = ToProto(*home);
  return proto;
}

absl::StatusOr<RobotName> ReadHomeOrder(const v1::OrderHomeRequest& request) {
  switch (request.target_case()) {
    case v1::OrderHomeRequest::kRobot:
      return ParseRobotName("robot", request.robot());
    case v1::OrderHomeRequest::kMission: {
      PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                                  ParseMissionName("mission", request.mission()));
      return RobotName{mission, {}};
    }
    case v1::OrderHomeRequest::TARGET_NOT_SET:
      break;
  }
  return FieldError("target", "must be one of robot, mission");
}

}  // namespace plumescout::server
