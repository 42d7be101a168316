// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_planner_client.h"

#include <cstdint>
#include <utility>

#include "client/grpc_link.h"
#include "client/grpc_observation_stream.h"
#include "client/grpc_robot_watch.h"
#include "core/types/status_macros.h"
#include "plumescout/v1/ingest_service.grpc.pb.h"
#include "plumescout/v1/map_service.grpc.pb.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "proto/convert/enums.h"
#include "proto/convert/geometry.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "proto/convert/options.h"
#include "proto/convert/plan.h"
#include "proto/convert/robot.h"
#include "proto/convert/robot_frame.h"

namespace plumescout::client {
namespace {

constexpr int kMissionsPerPage = 1000;
constexpr int kMapAttempts = 5;

class GrpcPlannerClient final : public PlannerClient {
 public:
  explicit GrpcPlannerClient(const GrpcClientOptions& options)
      : link_(options),
        missions_(link_.channel()),
        robots_(link_.channel()),
        ingest_(link_.channel()),
        planning_(link_.channel()),
        maps_(link_.channel()) {}

  absl::Status CreateMission(const MissionId& mission, const MissionOptions& options) override {
    v1::CreateMissionRequest request;
    request.set_mission_id(mission);
    *request.mutable_options() = ChangesToProto(options);
    v1::CreateMissionResponse response;
    return link_.CallNamed(missions_, &v1::MissionService::Stub::CreateMission, request, &response);
  }

  absl::StatusOr<std::vector<MissionId>> ListMissions() override {
    std::vector<MissionId> missions;
    v1::ListMissionsRequest request;
    request.set_page_size(kMissionsPerPage);
    do {
      v1::ListMissionsResponse response;
      PLUMESCOUT_RETURN_IF_ERROR(
          link_.Call(missions_, &v1::MissionService::Stub::ListMissions, request, &response));
      for (const v1::Mission& mission : response.missions()) {
        PLUMESCOUT_ASSIGN_OR_RETURN(MissionId id,
                                    ParseMissionName("missions.name", mission.name()));
        missions.push_back(std::move(id));
      }
      request.set_page_token(response.next_page_token());
    } while (!request.page_token().empty());
    return missions;
  }

  absl::Status DeleteMission(const MissionId& mission) override {
    v1::DeleteMissionRequest request;
    request.set_name(MissionResource(mission));
    v1::DeleteMissionResponse response;
    return link_.Call(missions_, &v1::MissionService::Stub::DeleteMission, request, &response);
  }

  absl::StatusOr<RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot,
                                             double radius_m, bool take_over,
                                             std::int64_t log_epoch,
                                             const RobotOutfit& outfit) override {
    v1::RegisterRobotRequest request;
    request.set_mission(MissionResource(mission));
    request.set_robot_id(robot);
    request.set_radius_m(radius_m);
    request.set_take_over(take_over);
    request.set_log_epoch(log_epoch);
    if (outfit.frame != RobotFrame()) *request.mutable_frame() = ToProto(outfit.frame);
    ToProto(outfit.sensors, request);
    v1::RegisterRobotResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_.CallNamed(robots_, &v1::RobotService::Stub::RegisterRobot, request, &response));
    const v1::IngestState& state = response.ingest_state();
    return RobotSession{.mission = mission,
                        .robot = robot,
                        .lease_token = response.lease_token(),
                        .server_boot_id = response.server_boot_id(),
                        .ingest = {.applied_sequence = state.applied_sequence(),
                                   .durable_sequence = state.durable_sequence(),
                                   .credit_sequence = state.credit_sequence(),
                                   .revision = state.revision()},
                        .log_continues = response.log_continues()};
  }

  absl::Status RemoveRobot(const MissionId& mission, const RobotId& robot, std::int64_t lease_token,
                           bool force) override {
    v1::RemoveRobotRequest request;
    request.set_robot(RobotResource({mission, robot}));
    request.set_lease_token(lease_token);
    request.set_force(force);
    v1::RemoveRobotResponse response;
    return link_.Call(robots_, &v1::RobotService::Stub::RemoveRobot, request, &response);
  }

  absl::StatusOr<std::unique_ptr<ObservationStream>> OpenObservationStream(
      const RobotSession& session) override {
    link_.AwaitLink();
    return OpenGrpcObservationStream(ingest_, session,
                                     {.open = link_.options().stream_open_timeout,
                                      .write = link_.options().stream_write_timeout});
  }

  absl::StatusOr<Plan> NextBestTrajectory(const MissionId& mission,
                                          const PlanQuery& query) override {
    v1::NextBestTrajectoryRequest request;
    request.set_robot(RobotResource({mission, query.request.robot}));
    request.set_lease_token(query.lease_token);
    if (query.request.start.has_value()) *request.mutable_start() = ToProto(*query.request.start);
    request.set_min_applied_sequence(query.min_applied_sequence);
    if (query.budget > absl::ZeroDuration()) {
      SetDuration(query.budget, request.mutable_planning_budget());
    }
    request.set_seed(static_cast<std::int64_t>(query.request.seed));
    request.set_go_home(query.request.go_home);
    request.set_max_edge_evaluation_count(query.request.max_edge_evaluations);
    v1::NextBestTrajectoryResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(link_.CallNamed(planning_,
                                               &v1::PlanningService::Stub::NextBestTrajectory,
                                               request, &response, query.timeout));
    return FromProto(response.plan(), "plan");
  }

  absl::Status ReportProgress(const RobotSession& session, PlanId plan,
                              ProgressOutcome outcome) override {
    v1::ReportProgressRequest request;
    request.set_robot(RobotResource({session.mission, session.robot}));
    request.set_lease_token(session.lease_token);
    request.set_plan(PlanResource({session.mission, plan}));
    request.set_outcome(ToProto(outcome));
    v1::ReportProgressResponse response;
    return link_.Call(planning_, &v1::PlanningService::Stub::ReportProgress, request, &response);
  }

  absl::StatusOr<std::unique_ptr<RobotWatch>> WatchRobot(const RobotSession& session) override {
    return OpenGrpcRobotWatch(robots_, session);
  }

  absl::StatusOr<MapSnapshot> GetMap(const MissionId& mission) override {
    absl::StatusOr<MapSnapshot> map;
    // The revision of the first part may go while the others are fetched.
    for (int attempt = 0; attempt < kMapAttempts; ++attempt) {
      map = GetMapParts(mission);
      if (!absl::IsAborted(map.status())) break;
    }
    return map;
  }

 private:
  absl::StatusOr<MapSnapshot> GetMapParts(const MissionId& mission) {
    v1::GetMapRequest request;
    request.set_mission(MissionResource(mission));
    request.set_full_precision(true);
    request.set_fresh_posterior(true);
    v1::GetMapResponse part;
    PLUMESCOUT_RETURN_IF_ERROR(link_.Call(maps_, &v1::MapService::Stub::GetMap, request, &part));
    if (part.status().gases_size() > 1) {  // it has the layers of the first
      for (const v1::GasStatus& gas : part.status().gases()) request.add_species(gas.species());
      PLUMESCOUT_RETURN_IF_ERROR(link_.Call(maps_, &v1::MapService::Stub::GetMap, request, &part));
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(MapSnapshot map, FromProto(part));
    while (!part.next_part_token().empty()) {
      request.set_part_token(part.next_part_token());
      PLUMESCOUT_RETURN_IF_ERROR(link_.Call(maps_, &v1::MapService::Stub::GetMap, request, &part));
      PLUMESCOUT_RETURN_IF_ERROR(AddTiles(part, map));
    }
    return map;
  }

  GrpcLink link_;
  v1::MissionService::Stub missions_;
  v1::RobotService::Stub robots_;
  v1::IngestService::Stub ingest_;
  v1::PlanningService::Stub planning_;
  v1::MapService::Stub maps_;
};

}  // namespace

std::unique_ptr<PlannerClient> MakeGrpcPlannerClient(const GrpcClientOptions& options) {
  return std::make_unique<GrpcPlannerClient>(options);
}

}  // namespace plumescout::client
