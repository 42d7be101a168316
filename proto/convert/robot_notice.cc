// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/robot_notice.h"

#include <utility>

#include "absl/status/status.h"
#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/geometry.h"
#include "proto/convert/names.h"

namespace plumescout {
namespace {

void Put(const RobotStanding& standing, const MissionId&, v1::WatchRobotResponse& response) {
  v1::RobotStanding& proto = *response.mutable_standing();
  proto.set_paused(standing.paused);
  proto.set_finished(standing.finished);
  proto.set_ordered_home(standing.ordered_home);
  proto.set_frame_suspect(standing.frame_suspect);
  proto.set_silent(standing.silent);
  proto.set_leased(standing.leased);
}

void Put(const PlanInvalidated& invalidated, const MissionId& mission,
         v1::WatchRobotResponse& response) {
  v1::PlanInvalidated& proto = *response.mutable_plan_invalidated();
  proto.set_plan(PlanResource({mission, invalidated.plan}));
  proto.set_reason(ToProto(invalidated.reason));
  if (!invalidated.robot.empty()) proto.set_robot(RobotResource({mission, invalidated.robot}));
  proto.set_meets_in_s(invalidated.meets_in_s);
  if (invalidated.place) *proto.mutable_place() = ToProto(*invalidated.place);
  proto.set_detail(invalidated.detail);
}

void Put(const PlanAssigned& assigned, const MissionId& mission, v1::WatchRobotResponse& response) {
  response.mutable_plan_assigned()->set_plan(PlanResource({mission, assigned.plan}));
}

RobotStanding StandingFrom(const v1::RobotStanding& proto) {
  return {.paused = proto.paused(),
          .finished = proto.finished(),
          .ordered_home = proto.ordered_home(),
          .frame_suspect = proto.frame_suspect(),
          .silent = proto.silent(),
          .leased = proto.leased()};
}

absl::StatusOr<RobotNotice> InvalidatedFrom(const v1::PlanInvalidated& proto) {
  PlanInvalidated invalidated;
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlanName plan,
                              ParsePlanName("plan_invalidated.plan", proto.plan()));
  invalidated.plan = plan.plan;
  PLUMESCOUT_ASSIGN_OR_RETURN(invalidated.reason,
                              FromProto(proto.reason(), "plan_invalidated.reason"));
  if (!proto.robot().empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName robot,
                                ParseRobotName("plan_invalidated.robot", proto.robot()));
    invalidated.robot = robot.robot;
  }
  invalidated.meets_in_s = proto.meets_in_s();
  if (proto.has_place()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(invalidated.place,
                                FromProto(proto.place(), "plan_invalidated.place"));
  }
  invalidated.detail = proto.detail();
  return RobotNotice(std::move(invalidated));
}

}  // namespace

v1::WatchRobotResponse ToProto(const RobotNotice& notice, const MissionId& mission) {
  v1::WatchRobotResponse response;
  std::visit([&](const auto& body) { Put(body, mission, response); }, notice);
  return response;
}

absl::StatusOr<RobotNotice> FromProto(const v1::WatchRobotResponse& proto) {
  if (proto.has_standing()) return RobotNotice(StandingFrom(proto.standing()));
  if (proto.has_plan_invalidated()) return InvalidatedFrom(proto.plan_invalidated());
  if (!proto.has_plan_assigned()) return absl::InvalidArgumentError("notice must be set");
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlanName plan,
                              ParsePlanName("plan_assigned.plan", proto.plan_assigned().plan()));
  return RobotNotice(PlanAssigned{plan.plan});
}

}  // namespace plumescout
