// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_operator_client.h"

#include <cmath>
#include <utility>

#include "client/grpc_link.h"
#include "client/grpc_robot_watch.h"
#include "core/types/status_macros.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "proto/convert/field.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "proto/convert/plan.h"
#include "proto/convert/robot_frame.h"

namespace plumescout::client {
namespace {

constexpr int kRobotsPerPage = 1000;
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
  return details;
}

absl::StatusOr<TeamPlans> TeamFromProto(const v1::PlanTeamResponse& proto) {
  TeamPlans team;
  for (int i = 0; i < proto.plans_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Plan plan, FromProto(proto.plans(i), Join("", "plans", i)));
    team.plans.push_back(std::move(plan));
  }
  for (const v1::PlanTeamResponse::LeftOut& left_out : proto.left_out()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(RobotName name, ParseRobotName("left_out.robot", left_out.robot()));
    team.left_out.push_back({std::move(name.robot), left_out.reason()});
  }
  team.order_count = proto.order_count();
  return team;
}

// It is the server, not the caller, who is to blame for an answer that cannot be read.
template <typename T>
absl::StatusOr<T> FromServer(absl::StatusOr<T> read) {
  if (read.ok()) return read;
  return absl::InternalError(read.status().message());
}

class GrpcOperatorClient final : public OperatorClient {
 public:
  explicit GrpcOperatorClient(const GrpcClientOptions& options)
      : link_(options),
        missions_(link_.channel()),
        robots_(link_.channel()),
        planning_(link_.channel()) {}

  absl::Status PauseMission(const MissionId& mission) override {
    v1::PauseMissionRequest request;
    request.set_name(MissionResource(mission));
    v1::PauseMissionResponse response;
    return link_.Call(missions_, &v1::MissionService::Stub::PauseMission, request, &response);
  }

  absl::Status ResumeMission(const MissionId& mission) override {
    v1::ResumeMissionRequest request;
    request.set_name(MissionResource(mission));
    v1::ResumeMissionResponse response;
    return link_.Call(missions_, &v1::MissionService::Stub::ResumeMission, request, &response);
  }

  absl::Status FinishMission(const MissionId& mission) override {
    v1::FinishMissionRequest request;
    request.set_name(MissionResource(mission));
    v1::FinishMissionResponse response;
    return link_.Call(missions_, &v1::MissionService::Stub::FinishMission, request, &response);
  }

  absl::StatusOr<RobotDetails> GetRobot(const MissionId& mission, const RobotId& robot) override {
    v1::GetRobotRequest request;
    request.set_name(RobotResource({mission, robot}));
    v1::GetRobotResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_.Call(robots_, &v1::RobotService::Stub::GetRobot, request, &response));
    return FromServer(DetailsFromProto(response.robot()));
  }

  absl::StatusOr<std::vector<RobotDetails>> ListRobots(const MissionId& mission) override {
    std::vector<RobotDetails> robots;
    v1::ListRobotsRequest request;
    request.set_mission(MissionResource(mission));
    request.set_page_size(kRobotsPerPage);
    do {
      v1::ListRobotsResponse response;
      PLUMESCOUT_RETURN_IF_ERROR(
          link_.Call(robots_, &v1::RobotService::Stub::ListRobots, request, &response));
      for (const v1::Robot& robot : response.robots()) {
        PLUMESCOUT_ASSIGN_OR_RETURN(RobotDetails details, FromServer(DetailsFromProto(robot)));
        robots.push_back(std::move(details));
      }
      request.set_page_token(response.next_page_token());
    } while (!request.page_token().empty());
    return robots;
  }

  absl::Status RemoveRobot(const MissionId& mission, const RobotId& robot) override {
    v1::RemoveRobotRequest request;
    request.set_robot(RobotResource({mission, robot}));
    request.set_force(true);
    v1::RemoveRobotResponse response;
    return link_.Call(robots_, &v1::RobotService::Stub::RemoveRobot, request, &response);
  }

  absl::Status ReleaseLease(const MissionId& mission, const RobotId& robot) override {
    v1::ReleaseLeaseRequest request;
    request.set_robot(RobotResource({mission, robot}));
    request.set_force(true);
    v1::ReleaseLeaseResponse response;
    return link_.Call(robots_, &v1::RobotService::Stub::ReleaseLease, request, &response);
  }

  absl::Status OrderHome(const MissionId& mission, const std::optional<RobotId>& robot,
                         bool home) override {
    v1::OrderHomeRequest request;
    if (robot) {
      request.set_robot(RobotResource({mission, *robot}));
    } else {
      request.set_mission(MissionResource(mission));
    }
    request.set_home(home);
    v1::OrderHomeResponse response;
    return link_.CallNamed(robots_, &v1::RobotService::Stub::OrderHome, request, &response);
  }

  absl::StatusOr<TeamPlans> PlanTeam(const MissionId& mission, const TeamQuery& query) override {
    v1::PlanTeamRequest request;
    request.set_mission(MissionResource(mission));
    for (const RobotId& robot : query.robots) request.add_robots(RobotResource({mission, robot}));
    if (query.budget > absl::ZeroDuration()) {
      SetDuration(query.budget, request.mutable_planning_budget());
    }
    request.set_seed(static_cast<std::int64_t>(query.seed));
    request.set_max_order_count(query.max_order_count);
    request.set_go_home(query.go_home);
    request.set_max_edge_evaluation_count(query.max_edge_evaluations);
    v1::PlanTeamResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(link_.CallNamed(planning_, &v1::PlanningService::Stub::PlanTeam,
                                               request, &response, query.timeout));
    return FromServer(TeamFromProto(response));
  }

  absl::StatusOr<std::unique_ptr<RobotWatch>> WatchRobot(const MissionId& mission,
                                                         const RobotId& robot) override {
    RobotSession anybody;  // without a lease
    anybody.mission = mission;
    anybody.robot = robot;
    return OpenGrpcRobotWatch(robots_, anybody);
  }

 private:
  GrpcLink link_;
  v1::MissionService::Stub missions_;
  v1::RobotService::Stub robots_;
  v1::PlanningService::Stub planning_;
};

}  // namespace

std::unique_ptr<OperatorClient> MakeGrpcOperatorClient(const GrpcClientOptions& options) {
  return std::make_unique<GrpcOperatorClient>(options);
}

}  // namespace plumescout::client
