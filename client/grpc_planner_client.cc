// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_planner_client.h"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/credentials.h"
#include "client/grpc_observation_stream.h"
#include "client/grpc_robot_watch.h"
#include "client/grpc_status.h"
#include "client/request_ids.h"
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

// Pings and their patience match the server's minimum ping interval; see the wire's documentation.
constexpr int kKeepaliveTime_ms = 10'000;
constexpr int kKeepaliveTimeout_ms = 5'000;
constexpr int kMinReconnect_ms = 100;
constexpr int kMaxReconnect_ms = 500;
// How long opening a stream waits for a link: longer than an attempt and the pause before it.
constexpr absl::Duration kLinkPatience = absl::Milliseconds(600);
constexpr int kMaxReceive_bytes = 256 << 20;  // more than any server sends in one part of a map
constexpr int kMissionsPerPage = 1000;
constexpr int kMapAttempts = 5;
constexpr std::int64_t kMaxDuration_s = 315'576'000'000;  // of a google.protobuf.Duration

grpc::ChannelArguments MakeArguments() {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveTime_ms);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveTimeout_ms);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);  // as many as it takes
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kMinReconnect_ms);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kMinReconnect_ms);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kMaxReconnect_ms);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // one connection a client
  arguments.SetMaxReceiveMessageSize(kMaxReceive_bytes);
  return arguments;
}

// Longer than the wire can say: as long as it can say.
void SetDuration(absl::Duration duration, google::protobuf::Duration* proto) {
  duration = std::min(duration, absl::Seconds(kMaxDuration_s));
  proto->set_seconds(absl::IDivDuration(duration, absl::Seconds(1), &duration));
  proto->set_nanos(static_cast<std::int32_t>(absl::ToInt64Nanoseconds(duration)));
}

class GrpcPlannerClient final : public PlannerClient {
 public:
  explicit GrpcPlannerClient(const GrpcClientOptions& options)
      : options_(options),
        channel_(MakeChannel(options.target, options.credentials, MakeArguments())),
        missions_(channel_),
        robots_(channel_),
        ingest_(channel_),
        planning_(channel_),
        maps_(channel_) {}

  absl::Status CreateMission(const MissionId& mission, const MissionOptions& options) override {
    v1::CreateMissionRequest request;
    request.set_mission_id(mission);
    *request.mutable_options() = ChangesToProto(options);
    v1::CreateMissionResponse response;
    return CallNamed(missions_, &v1::MissionService::Stub::CreateMission, request, &response,
                     options_.call_timeout);
  }

  absl::StatusOr<std::vector<MissionId>> ListMissions() override {
    std::vector<MissionId> missions;
    v1::ListMissionsRequest request;
    request.set_page_size(kMissionsPerPage);
    do {
      v1::ListMissionsResponse response;
      PLUMESCOUT_RETURN_IF_ERROR(
          Call(missions_, &v1::MissionService::Stub::ListMissions, request, &response));
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
    return Call(missions_, &v1::MissionService::Stub::DeleteMission, request, &response);
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
    PLUMESCOUT_RETURN_IF_ERROR(CallNamed(robots_, &v1::RobotService::Stub::RegisterRobot, request,
                                         &response, options_.call_timeout));
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
    return Call(robots_, &v1::RobotService::Stub::RemoveRobot, request, &response);
  }

  absl::StatusOr<std::unique_ptr<ObservationStream>> OpenObservationStream(
      const RobotSession& session) override {
    AwaitLink();
    return OpenGrpcObservationStream(
        ingest_, session,
        {.open = options_.stream_open_timeout, .write = options_.stream_write_timeout});
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
    PLUMESCOUT_RETURN_IF_ERROR(CallNamed(planning_, &v1::PlanningService::Stub::NextBestTrajectory,
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
    return Call(planning_, &v1::PlanningService::Stub::ReportProgress, request, &response);
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
    PLUMESCOUT_RETURN_IF_ERROR(Call(maps_, &v1::MapService::Stub::GetMap, request, &part));
    if (part.status().gases_size() > 1) {  // it has the layers of the first
      for (const v1::GasStatus& gas : part.status().gases()) request.add_species(gas.species());
      PLUMESCOUT_RETURN_IF_ERROR(Call(maps_, &v1::MapService::Stub::GetMap, request, &part));
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(MapSnapshot map, FromProto(part));
    while (!part.next_part_token().empty()) {
      request.set_part_token(part.next_part_token());
      PLUMESCOUT_RETURN_IF_ERROR(Call(maps_, &v1::MapService::Stub::GetMap, request, &part));
      PLUMESCOUT_RETURN_IF_ERROR(AddTiles(part, map));
    }
    return map;
  }

  template <typename Stub, typename Method, typename Request, typename Response>
  absl::Status Call(Stub& stub, Method method, const Request& request, Response* response,
                    absl::Duration timeout) {
    grpc::ClientContext context;
    context.set_deadline(absl::ToChronoTime(absl::Now() + timeout));
    context.set_wait_for_ready(true);
    const absl::Status status = FromGrpc((stub.*method)(&context, request, response));
    const bool linked = channel_->GetState(/*try_to_connect=*/false) == GRPC_CHANNEL_READY;
    if (!absl::IsDeadlineExceeded(status) || linked) return status;
    return absl::UnavailableError(
        absl::StrCat("no link to ", options_.target, " within ", absl::FormatDuration(timeout)));
  }
  template <typename Stub, typename Method, typename Request, typename Response>
  absl::Status Call(Stub& stub, Method method, const Request& request, Response* response) {
    return Call(stub, method, request, response, options_.call_timeout);
  }

  // The request has a name by which the server knows it again.
  template <typename Stub, typename Method, typename Request, typename Response>
  absl::Status CallNamed(Stub& stub, Method method, Request request, Response* response,
                         absl::Duration timeout) {
    const std::string content = absl::StrCat(request.GetTypeName(), request.SerializeAsString());
    request.set_request_id(request_ids_.NameOf(content));
    const absl::Status status = Call(stub, method, request, response, timeout);
    request_ids_.NoteEnd(content, request.request_id(), status);
    return status;
  }

  // Between calls that fail at once nobody drives the channel's attempts to connect, and gRPC looks
  // at them every five seconds only. Whoever waits for the channel drives them.
  void AwaitLink() { channel_->WaitForConnected(absl::ToChronoTime(absl::Now() + kLinkPatience)); }

  const GrpcClientOptions options_;
  RequestIds request_ids_;
  const std::shared_ptr<grpc::Channel> channel_;
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
