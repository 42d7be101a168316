// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_server_client.h"

#include <utility>

#include "client/grpc_link.h"
#include "plumescout/v1/system_service.grpc.pb.h"

namespace plumescout::client {
namespace {

absl::Duration DurationFromProto(const google::protobuf::Duration& proto) {
  return absl::Seconds(proto.seconds()) + absl::Nanoseconds(proto.nanos());
}

ServerLimits LimitsFromProto(const v1::ServerLimits& proto) {
  return {.max_receive_bytes = proto.max_receive_bytes(),
          .max_batch_observations = proto.max_batch_observation_count(),
          .stream_window_observations = proto.stream_window_observation_count(),
          .max_beams = proto.max_beam_count(),
          .max_planning_budget = DurationFromProto(proto.max_planning_budget()),
          .max_map_part_bytes = proto.max_map_part_bytes(),
          .max_missions = proto.max_mission_count(),
          .memory_budget_bytes = proto.memory_budget_bytes(),
          .mission_memory_budget_bytes = proto.mission_memory_budget_bytes(),
          .max_scans_per_s = proto.max_scans_per_s(),
          .max_gas_readings_per_s = proto.max_gas_readings_per_s(),
          .max_plans_per_s = proto.max_plans_per_s(),
          .max_clock_lead = DurationFromProto(proto.max_clock_lead())};
}

StoreInfo StoreFromProto(const v1::StoreInfo& proto) {
  return {.engine = proto.engine(),
          .node = proto.node(),
          .cluster = proto.cluster(),
          .is_available = proto.available(),
          .trouble = proto.trouble(),
          .backlog_bytes = proto.backlog_bytes(),
          .stored_bytes = proto.stored_bytes()};
}

class GrpcServerClient final : public ServerClient {
 public:
  explicit GrpcServerClient(std::shared_ptr<GrpcLink> link)
      : link_(std::move(link)), system_(link_->channel()) {}

  absl::StatusOr<ServerInfo> GetServerInfo() override {
    v1::GetServerInfoResponse response;
    const absl::Status status = link_->Ask(system_, &v1::SystemService::Stub::GetServerInfo,
                                           v1::GetServerInfoRequest(), &response);
    if (!status.ok()) return status;
    return ServerInfo{.version = response.version(),
                      .boot_id = response.boot_id(),
                      .uptime = DurationFromProto(response.uptime()),
                      .limits = LimitsFromProto(response.limits()),
                      .features = {response.features().begin(), response.features().end()},
                      .caller = response.caller(),
                      .caller_role = response.caller_role(),
                      .store = StoreFromProto(response.store())};
  }

  absl::Status DrainServer() override {
    v1::DrainServerResponse response;
    return link_->Call(system_, &v1::SystemService::Stub::DrainServer, v1::DrainServerRequest(),
                       &response);
  }

 private:
  const std::shared_ptr<GrpcLink> link_;
  v1::SystemService::Stub system_;
};

}  // namespace

std::unique_ptr<ServerClient> MakeGrpcServerClient(std::shared_ptr<GrpcLink> link) {
  return std::make_unique<GrpcServerClient>(std::move(link));
}

std::unique_ptr<ServerClient> MakeGrpcServerClient(const GrpcClientOptions& options) {
  return MakeGrpcServerClient(MakeGrpcLink(options));
}

}  // namespace plumescout::client
