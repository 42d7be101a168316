// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_planner_client.h"

#include <cstdint>
#include <utility>
#include <variant>

#include "client/grpc_link.h"
#include "client/grpc_observation_stream.h"
#include "client/grpc_plan_stream.h"
#include "client/grpc_robot_watch.h"
#include "client/grpc_status.h"
#include "client/ingest_messages.h"
#include "client/map_call.h"
#include "client/robot_messages.h"
#include "core/types/status_macros.h"
#include "plumescout/v1/ingest_service.grpc.pb.h"
#include "plumescout/v1/map_service.grpc.pb.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "plumescout/v1/system_service.grpc.pb.h"
#include "proto/convert/enums.h"
#include "proto/convert/geometry.h"
#include "proto/convert/inquiry.h"
#include "proto/convert/names.h"
#include "proto/convert/observation.h"
#include "proto/convert/options.h"
#include "proto/convert/plan.h"
#include "proto/convert/status.h"

namespace plumescout::client {
namespace {

constexpr int kMissionsPerPage = 1000;

template <typename Request>
Request RequestFor(const MissionId& mission, const PlanQuery& query) {
  Request request;
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
  return request;
}

v1::CheckTrajectoryRequest RequestFor(const RobotSession& session, const TrajectoryQuery& query) {
  v1::CheckTrajectoryRequest request;
  request.set_robot(RobotResource({session.mission, session.robot}));
  request.set_lease_token(session.lease_token);
  request.set_min_applied_sequence(query.min_applied_sequence);
  if (const PlanId* plan = std::get_if<PlanId>(&query.subject)) {
    request.set_plan(PlanResource({session.mission, *plan}));
    return request;
  }
  const auto& path = std::get<IntendedPath>(query.subject);
  for (const Point2& vertex : path.vertices)
    *request.mutable_path()->add_vertices() = ToProto(vertex);
  request.mutable_path()->set_goal_kind(ToProto(path.goal_kind));
  return request;
}

class GrpcPlannerClient final : public PlannerClient {
 public:
  explicit GrpcPlannerClient(std::shared_ptr<GrpcLink> link)
      : link_(std::move(link)),
        missions_(link_->channel()),
        robots_(link_->channel()),
        ingest_(link_->channel()),
        planning_(link_->channel()),
        maps_(link_->channel()),
        system_(link_->channel()) {}

  absl::Status CreateMission(const MissionId& mission, const MissionOptions& options) override {
    v1::CreateMissionRequest request;
    request.set_mission_id(mission);
    *request.mutable_options() = ChangesToProto(options);
    v1::CreateMissionResponse response;
    return link_->CallNamed(missions_, &v1::MissionService::Stub::CreateMission, request,
                            &response);
  }

  absl::StatusOr<std::vector<MissionId>> ListMissions() override {
    std::vector<MissionId> missions;
    v1::ListMissionsRequest request;
    request.set_page_size(kMissionsPerPage);
    do {
      v1::ListMissionsResponse response;
      PLUMESCOUT_RETURN_IF_ERROR(
          link_->Ask(missions_, &v1::MissionService::Stub::ListMissions, request, &response));
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
    return link_->Call(missions_, &v1::MissionService::Stub::DeleteMission, request, &response);
  }

  absl::StatusOr<RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot,
                                             double radius_m, bool take_over,
                                             std::int64_t log_epoch,
                                             const RobotOutfit& outfit) override {
    v1::RegisterRobotRequest request = RegistrationOf({.mission = mission,
                                                       .robot = robot,
                                                       .radius_m = radius_m,
                                                       .take_over = take_over,
                                                       .log_epoch = log_epoch,
                                                       .frame = outfit.frame,
                                                       .sensors = outfit.sensors});
    v1::RegisterRobotResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_->CallNamed(robots_, &v1::RobotService::Stub::RegisterRobot, request, &response));
    return RobotSession{.mission = mission,
                        .robot = robot,
                        .lease_token = response.lease_token(),
                        .server_boot_id = response.server_boot_id(),
                        .ingest = StateFromProto(response.ingest_state()),
                        .log_continues = response.log_continues()};
  }

  absl::Status RemoveRobot(const MissionId& mission, const RobotId& robot, std::int64_t lease_token,
                           bool force) override {
    v1::RemoveRobotRequest request;
    request.set_robot(RobotResource({mission, robot}));
    request.set_lease_token(lease_token);
    request.set_force(force);
    v1::RemoveRobotResponse response;
    return link_->Call(robots_, &v1::RobotService::Stub::RemoveRobot, request, &response);
  }

  absl::StatusOr<std::unique_ptr<ObservationStream>> OpenObservationStream(
      const RobotSession& session) override {
    const bool linked = link_->AwaitLink();
    return OpenGrpcObservationStream(link_->routes(), ingest_, session,
                                     {.open = link_->options().stream_open_timeout,
                                      .write = link_->options().stream_write_timeout},
                                     linked ? MaxRequest_bytes() : kUsualRequest_bytes);
  }

  absl::Status ReleaseLease(const RobotSession& session) override {
    v1::ReleaseLeaseRequest request;
    request.set_robot(RobotResource({session.mission, session.robot}));
    request.set_lease_token(session.lease_token);
    v1::ReleaseLeaseResponse response;
    return link_->Call(robots_, &v1::RobotService::Stub::ReleaseLease, request, &response);
  }

  absl::StatusOr<BatchReply> IngestBatch(const RobotSession& session,
                                         const std::vector<Observation>& batch) override {
    v1::BatchIngestObservationsRequest request;
    *request.mutable_open() = OpeningOf(session);
    for (const Observation& observation : batch) {
      *request.mutable_batch()->add_observations() = ToProto(observation);
    }
    if (session.robot_clock_ns) request.mutable_batch()->set_sent_time_ns(session.robot_clock_ns());
    v1::BatchIngestObservationsResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(
        link_->Ask(ingest_, &v1::IngestService::Stub::BatchIngestObservations, request, &response));
    BatchReply reply{.state = StateFromProto(response.ingest_state())};
    for (const v1::ObservationRejected& rejected : response.rejections()) {
      reply.rejected.push_back({rejected.sequence(), FromProto(rejected.status())});
    }
    return reply;
  }

  absl::StatusOr<Plan> NextBestTrajectory(const MissionId& mission,
                                          const PlanQuery& query) override {
    const auto request = RequestFor<v1::NextBestTrajectoryRequest>(mission, query);
    v1::NextBestTrajectoryResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(link_->CallNamed(planning_,
                                                &v1::PlanningService::Stub::NextBestTrajectory,
                                                request, &response, query.timeout));
    return FromProto(response.plan(), "plan");
  }

  absl::StatusOr<std::unique_ptr<PlanStream>> StreamNextBestTrajectory(
      const MissionId& mission, const PlanQuery& query) override {
    return OpenGrpcPlanStream(link_->routes(), planning_,
                              RequestFor<v1::StreamNextBestTrajectoryRequest>(mission, query),
                              query.timeout);
  }

  absl::StatusOr<TrajectoryCheck> CheckTrajectory(const RobotSession& session,
                                                  const TrajectoryQuery& query) override {
    v1::CheckTrajectoryResponse response;
    PLUMESCOUT_RETURN_IF_ERROR(link_->Ask(planning_, &v1::PlanningService::Stub::CheckTrajectory,
                                          RequestFor(session, query), &response));
    PLUMESCOUT_ASSIGN_OR_RETURN(TrajectoryVerdict verdict, FromServer(FromProto(response)));
    return TrajectoryCheck{.revision = response.revision(), .verdict = std::move(verdict)};
  }

  absl::Status ReportProgress(const RobotSession& session, PlanId plan,
                              ProgressOutcome outcome) override {
    v1::ReportProgressRequest request;
    request.set_robot(RobotResource({session.mission, session.robot}));
    request.set_lease_token(session.lease_token);
    request.set_plan(PlanResource({session.mission, plan}));
    request.set_outcome(ToProto(outcome));
    v1::ReportProgressResponse response;
    return link_->CallNamed(planning_, &v1::PlanningService::Stub::ReportProgress, request,
                            &response);
  }

  absl::StatusOr<std::unique_ptr<RobotWatch>> WatchRobot(const RobotSession& session) override {
    return OpenGrpcRobotWatch(link_->routes(), robots_, session);
  }

  absl::StatusOr<MapSnapshot> GetMap(const MissionId& mission) override {
    v1::GetMapRequest request;
    request.set_mission(MissionResource(mission));
    request.set_full_precision(true);
    request.set_fresh_posterior(true);
    return FetchMap(*link_, maps_, request, /*all_gases=*/true);
  }

 private:
  // As the server says, which may be another one than a moment ago.
  std::int64_t MaxRequest_bytes() {
    v1::GetServerInfoResponse info;
    const absl::Status told =
        link_->Call(system_, &v1::SystemService::Stub::GetServerInfo, v1::GetServerInfoRequest(),
                    &info, link_->options().stream_open_timeout);
    const std::int64_t bytes = info.limits().max_receive_bytes();
    return told.ok() && bytes > 0 ? bytes : kUsualRequest_bytes;
  }

  const std::shared_ptr<GrpcLink> link_;
  v1::MissionService::Stub missions_;
  v1::RobotService::Stub robots_;
  v1::IngestService::Stub ingest_;
  v1::PlanningService::Stub planning_;
  v1::MapService::Stub maps_;
  v1::SystemService::Stub system_;
};

}  // namespace

std::unique_ptr<PlannerClient> MakeGrpcPlannerClient(std::shared_ptr<GrpcLink> link) {
  return std::make_unique<GrpcPlannerClient>(std::move(link));
}

std::unique_ptr<PlannerClient> MakeGrpcPlannerClient(const GrpcClientOptions& options) {
  return MakeGrpcPlannerClient(MakeGrpcLink(options));
}

}  // namespace plumescout::client
