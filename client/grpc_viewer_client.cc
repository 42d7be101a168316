// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_viewer_client.h"

#include <utility>

#include "client/grpc_link.h"
#include "client/grpc_map_watch.h"
#include "client/grpc_status.h"
#include "client/map_call.h"
#include "client/mission_messages.h"
#include "client/robot_messages.h"
#include "core/types/status_macros.h"
#include "plumescout/v1/map_service.grpc.pb.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "plumescout/v1/snapshot_service.grpc.pb.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/inquiry.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "proto/convert/plan.h"

namespace plumescout::client {
namespace {

using plumescout::Join;  // joining missions hides it

constexpr int kItemsPerPage = 1000;

absl::StatusOr<GasAnswer> AnswerFromProto(const v1::QueryGasResponse& proto) {
  GasAnswer answer;
  answer.revision = proto.revision();
  answer.posterior_time_ns = proto.posterior_time_ns();
  for (int i = 0; i < proto.gas_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const GasAtPlace gas, FromProto(proto.gas(i), Join("", "gas", i)));
    answer.gas.push_back(gas);
  }
  answer.quality = FromProto(proto.gas_quality());
  answer.audits = AuditsFromProto(proto.gas_quality());
  answer.sample_time_ns = proto.sample_time_ns();
  return answer;
}

absl::StatusOr<FrontierList> FrontiersFromProto(const v1::ListFrontiersResponse& proto) {
  FrontierList list;
  list.revision = proto.revision();
  for (int i = 0; i < proto.frontiers_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(JudgedFrontier frontier,
                                FromProto(proto.frontiers(i), Join("", "frontiers", i)));
    list.frontiers.push_back(std::move(frontier));
  }
  return list;
}

absl::StatusOr<LivePlan> LivePlanFromProto(const v1::LivePlan& proto, absl::string_view field) {
  LivePlan live;
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlanName plan,
                              ParsePlanName(Join(field, "name"), proto.name()));
  PLUMESCOUT_ASSIGN_OR_RETURN(RobotName robot, ParseRobotName(Join(field, "robot"), proto.robot()));
  live.plan = plan.plan;
  live.robot = std::move(robot.robot);
  PLUMESCOUT_ASSIGN_OR_RETURN(live.goal_kind,
                              FromProto(proto.goal_kind(), Join(field, "goal_kind")));
  PLUMESCOUT_ASSIGN_OR_RETURN(live.goal, FromProto(proto.goal(), Join(field, "goal")));
  live.arrival_time_ns = proto.arrival_time_ns();
  PLUMESCOUT_ASSIGN_OR_RETURN(live.trajectory,
                              FromProto(proto.trajectory(), Join(field, "trajectory")));
  return live;
}

absl::StatusOr<PlanList> PlansFromProto(const v1::ListPlansResponse& proto) {
  PlanList list;
  list.revision = proto.revision();
  for (int i = 0; i < proto.plans_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(LivePlan live,
                                LivePlanFromProto(proto.plans(i), Join("", "plans", i)));
    list.live.push_back(std::move(live));
  }
  for (int i = 0; i < proto.latest_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Plan plan, FromProto(proto.latest(i), Join("", "latest", i)));
    list.latest.push_back(std::move(plan));
  }
  return list;
}

absl::StatusOr<HistoryPage> PageFromProto(const v1::GetMissionHistoryResponse& proto) {
  HistoryPage page;
  for (const v1::MissionEvent& told : proto.events()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(MissionEvent event, EventFromProto(told));
    page.events.push_back(std::move(event));
  }
  page.next_page_token = proto.next_page_token();
  page.head_revision = proto.head_revision();
  page.first_number = proto.first_number();
  return page;
}

class GrpcViewerClient final : public ViewerClient {
 public:
  explicit GrpcViewerClient(std::shared_ptr<GrpcLink> link)
      : link_(std::move(link)),
        missions_(link_->channel()),
        robots_(link_->channel()),
        planning_(link_->channel()),
        maps_(link_->channel()),
        snapshots_(link_->channel()) {}

  absl::StatusOr<MissionDetails> GetMission(const MissionId& mission) override {
    v1::GetMissionRequest request;
    request.set_name(MissionResource(mission));
    v1::GetMissionResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_->Ask(missions_, &v1::MissionService::Stub::GetMission, request, &response));
    return FromServer(DetailsFromProto(response.mission()));
  }

  absl::StatusOr<std::vector<MissionDetails>> ListMissions() override {
    std::vector<MissionDetails> missions;
    v1::ListMissionsRequest request;
    request.set_page_size(kItemsPerPage);
    do {
      v1::ListMissionsResponse response;
      PLUMESCOUT_RETURN_IF_ERROR(
          link_->Ask(missions_, &v1::MissionService::Stub::ListMissions, request, &response));
      for (const v1::Mission& mission : response.missions()) {
        PLUMESCOUT_ASSIGN_OR_RETURN(MissionDetails details, FromServer(DetailsFromProto(mission)));
        missions.push_back(std::move(details));
      }
      request.set_page_token(response.next_page_token());
    } while (!request.page_token().empty());
    return missions;
  }

  absl::StatusOr<RobotDetails> GetRobot(const MissionId& mission, const RobotId& robot) override {
    v1::GetRobotRequest request;
    request.set_name(RobotResource({mission, robot}));
    v1::GetRobotResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_->Ask(robots_, &v1::RobotService::Stub::GetRobot, request, &response));
    return FromServer(DetailsFromProto(response.robot()));
  }

  absl::StatusOr<std::vector<RobotDetails>> ListRobots(const MissionId& mission) override {
    std::vector<RobotDetails> robots;
    v1::ListRobotsRequest request;
    request.set_mission(MissionResource(mission));
    request.set_page_size(kItemsPerPage);
    do {
      v1::ListRobotsResponse response;
      PLUMESCOUT_RETURN_IF_ERROR(
          link_->Ask(robots_, &v1::RobotService::Stub::ListRobots, request, &response));
      for (const v1::Robot& robot : response.robots()) {
        PLUMESCOUT_ASSIGN_OR_RETURN(RobotDetails details, FromServer(DetailsFromProto(robot)));
        robots.push_back(std::move(details));
      }
      request.set_page_token(response.next_page_token());
    } while (!request.page_token().empty());
    return robots;
  }

  absl::StatusOr<MapSnapshot> GetMap(const MissionId& mission, const MapQuery& query) override {
    v1::GetMapRequest request;
    request.set_mission(MissionResource(mission));
    ToProto(query.view, request);
    request.set_fresh_posterior(query.fresh_posterior);
    request.set_revision(query.revision);
    request.set_max_part_bytes(query.max_part_bytes);
    return FetchMap(*link_, maps_, request);
  }

  absl::StatusOr<std::unique_ptr<MapWatch>> WatchMap(const MissionId& mission,
                                                     const MapWatchQuery& query) override {
    v1::WatchMapRequest request;
    request.set_mission(MissionResource(mission));
    ToProto(query.view, request);
    if (query.from_revision) {
      request.set_from_revision(*query.from_revision);
      request.set_speed_ratio(query.speed_ratio);
    }
    return OpenGrpcMapWatch(link_->routes(), maps_, request);
  }

  absl::StatusOr<GasAnswer> QueryGas(const MissionId& mission, const GasQuery& query) override {
    v1::QueryGasRequest request;
    request.set_mission(MissionResource(mission));
    for (const Point2& point : query.points) *request.add_points() = ToProto(point);
    request.set_fresh_posterior(query.fresh_posterior);
    request.set_species(query.species);
    request.set_revision(query.revision);
    request.set_with_verdicts(query.with_verdicts);
    v1::QueryGasResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_->Ask(maps_, &v1::MapService::Stub::QueryGas, request, &response));
    return FromServer(AnswerFromProto(response));
  }

  absl::StatusOr<FrontierList> ListFrontiers(const MissionId& mission,
                                             const RobotId& robot) override {
    v1::ListFrontiersRequest request;
    request.set_robot(RobotResource({mission, robot}));
    v1::ListFrontiersResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_->Ask(planning_, &v1::PlanningService::Stub::ListFrontiers, request, &response));
    return FromServer(FrontiersFromProto(response));
  }

  absl::StatusOr<PlanList> ListPlans(const MissionId& mission, bool with_latest) override {
    v1::ListPlansRequest request;
    request.set_mission(MissionResource(mission));
    request.set_with_latest(with_latest);
    v1::ListPlansResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_->Ask(planning_, &v1::PlanningService::Stub::ListPlans, request, &response));
    return FromServer(PlansFromProto(response));
  }

  absl::StatusOr<HistoryPage> GetHistory(const MissionId& mission,
                                         const HistoryQuery& query) override {
    v1::GetMissionHistoryRequest request;
    request.set_mission(MissionResource(mission));
    for (const MissionEventKind kind : query.kinds) request.add_kinds(ToProto(kind));
    request.set_first_number(query.first_number);
    request.set_page_size(query.page_size);
    request.set_page_token(query.page_token);
    v1::GetMissionHistoryResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_->Ask(snapshots_, &v1::SnapshotService::Stub::GetMissionHistory, request, &response));
    return FromServer(PageFromProto(response));
  }

  absl::StatusOr<FigureHistory> GetFigures(const MissionId& mission) override {
    v1::GetMissionFiguresRequest request;
    request.set_mission(MissionResource(mission));
    v1::GetMissionFiguresResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_->Ask(snapshots_, &v1::SnapshotService::Stub::GetMissionFigures, request, &response));
    FigureHistory history{{}, response.more_follow()};
    for (const v1::MissionFigures& told : response.figures()) {
      PLUMESCOUT_ASSIGN_OR_RETURN(MissionFigures figures, FromServer(FiguresFromProto(told)));
      history.figures.push_back(std::move(figures));
    }
    return history;
  }

 private:
  const std::shared_ptr<GrpcLink> link_;
  v1::MissionService::Stub missions_;
  v1::RobotService::Stub robots_;
  v1::PlanningService::Stub planning_;
  v1::MapService::Stub maps_;
  v1::SnapshotService::Stub snapshots_;
};

}  // namespace

std::unique_ptr<ViewerClient> MakeGrpcViewerClient(std::shared_ptr<GrpcLink> link) {
  return std::make_unique<GrpcViewerClient>(std::move(link));
}

std::unique_ptr<ViewerClient> MakeGrpcViewerClient(const GrpcClientOptions& options) {
  return MakeGrpcViewerClient(MakeGrpcLink(options));
}

}  // namespace plumescout::client
