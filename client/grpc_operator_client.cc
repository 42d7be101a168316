// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_operator_client.h"

#include <utility>

#include "client/grpc_link.h"
#include "client/grpc_robot_watch.h"
#include "client/grpc_status.h"
#include "client/mission_file.h"
#include "client/mission_messages.h"
#include "core/types/status_macros.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "plumescout/v1/snapshot_service.grpc.pb.h"
#include "plumescout/v1/system_service.grpc.pb.h"
#include "proto/convert/field.h"
#include "proto/convert/keep_out.h"
#include "proto/convert/names.h"
#include "proto/convert/plan.h"

namespace plumescout::client {
namespace {

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

class GrpcOperatorClient final : public OperatorClient {
 public:
  explicit GrpcOperatorClient(std::shared_ptr<GrpcLink> link)
      : link_(std::move(link)),
        missions_(link_->channel()),
        robots_(link_->channel()),
        planning_(link_->channel()),
        snapshots_(link_->channel()),
        system_(link_->channel()) {}

  absl::Status PauseMission(const MissionId& mission) override {
    v1::PauseMissionRequest request;
    request.set_name(MissionResource(mission));
    v1::PauseMissionResponse response;
    return link_->Call(missions_, &v1::MissionService::Stub::PauseMission, request, &response);
  }

  absl::Status ResumeMission(const MissionId& mission) override {
    v1::ResumeMissionRequest request;
    request.set_name(MissionResource(mission));
    v1::ResumeMissionResponse response;
    return link_->Call(missions_, &v1::MissionService::Stub::ResumeMission, request, &response);
  }

  absl::Status FinishMission(const MissionId& mission) override {
    v1::FinishMissionRequest request;
    request.set_name(MissionResource(mission));
    v1::FinishMissionResponse response;
    return link_->Call(missions_, &v1::MissionService::Stub::FinishMission, request, &response);
  }

  absl::Status RemoveRobot(const MissionId& mission, const RobotId& robot) override {
    v1::RemoveRobotRequest request;
    request.set_robot(RobotResource({mission, robot}));
    request.set_force(true);
    v1::RemoveRobotResponse response;
    return link_->Call(robots_, &v1::RobotService::Stub::RemoveRobot, request, &response);
  }

  absl::Status ReleaseLease(const MissionId& mission, const RobotId& robot) override {
    v1::ReleaseLeaseRequest request;
    request.set_robot(RobotResource({mission, robot}));
    request.set_force(true);
    v1::ReleaseLeaseResponse response;
    return link_->Call(robots_, &v1::RobotService::Stub::ReleaseLease, request, &response);
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
    return link_->CallNamed(robots_, &v1::RobotService::Stub::OrderHome, request, &response);
  }

  absl::Status UpdateMission(const MissionId& mission, const MissionUpdate& update) override {
    v1::UpdateMissionRequest request;
    request.mutable_mission()->set_name(MissionResource(mission));
    if (update.idle_time_to_live) {
      request.mutable_update_mask()->add_paths("idle_time_to_live");
      if (*update.idle_time_to_live != absl::InfiniteDuration()) {
        SetDuration(*update.idle_time_to_live,
                    request.mutable_mission()->mutable_idle_time_to_live());
      }
    }
    if (update.event_retention) {
      request.mutable_update_mask()->add_paths("event_retention");
      request.mutable_mission()->set_event_retention(ToProto(*update.event_retention));
    }
    v1::UpdateMissionResponse response;
    return link_->Call(missions_, &v1::MissionService::Stub::UpdateMission, request, &response);
  }

  absl::StatusOr<std::vector<Polygon>> ChangeKeepOutAreas(const MissionId& mission,
                                                          const KeepOutChanged& change) override {
    v1::ChangeKeepOutAreasRequest request = ToProto(change);
    request.set_name(MissionResource(mission));
    v1::ChangeKeepOutAreasResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(link_->CallNamed(
        missions_, &v1::MissionService::Stub::ChangeKeepOutAreas, request, &response));
    return FromServer(FromProto(response.areas(), "areas"));
  }

  absl::StatusOr<ExportedMission> ExportMission(const MissionId& mission, MissionFileFormat format,
                                                const MissionFileSink& sink) override {
    link_->AwaitLink();
    return ReceiveMissionFile(link_->routes(), snapshots_, mission, format, sink);
  }

  absl::StatusOr<MissionId> ImportMission(const MissionId& mission,
                                          const MissionFileSource& source) override {
    v1::GetServerInfoResponse info;
    PLUMESCOUT_RETURN_IF_ERROR(link_->Ask(system_, &v1::SystemService::Stub::GetServerInfo,
                                          v1::GetServerInfoRequest(), &info));
    return SendMissionFile(snapshots_, mission, source, info.limits().max_receive_bytes());
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
    PLUMESCOUT_RETURN_IF_ERROR(link_->CallNamed(planning_, &v1::PlanningService::Stub::PlanTeam,
                                                request, &response, query.timeout));
    return FromServer(TeamFromProto(response));
  }

  absl::StatusOr<std::unique_ptr<RobotWatch>> WatchRobot(const MissionId& mission,
                                                         const RobotId& robot) override {
    RobotSession anybody;  // without a lease
    anybody.mission = mission;
    anybody.robot = robot;
    return OpenGrpcRobotWatch(link_->routes(), robots_, anybody);
  }

 private:
  const std::shared_ptr<GrpcLink> link_;
  v1::MissionService::Stub missions_;
  v1::RobotService::Stub robots_;
  v1::PlanningService::Stub planning_;
  v1::SnapshotService::Stub snapshots_;
  v1::SystemService::Stub system_;
};

}  // namespace

std::unique_ptr<OperatorClient> MakeGrpcOperatorClient(std::shared_ptr<GrpcLink> link) {
  return std::make_unique<GrpcOperatorClient>(std::move(link));
}

std::unique_ptr<OperatorClient> MakeGrpcOperatorClient(const GrpcClientOptions& options) {
  return MakeGrpcOperatorClient(MakeGrpcLink(options));
}

}  // namespace plumescout::client
