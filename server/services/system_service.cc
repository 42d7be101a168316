// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/system_service.h"

#include <cmath>
#include <cstdint>

#include "google/protobuf/util/time_util.h"
#include "server/base/log.h"
#include "server/base/version.h"

namespace plumescout::server {
namespace {

using google::protobuf::util::TimeUtil;

google::protobuf::Duration FromSeconds(double seconds) {
  return TimeUtil::NanosecondsToDuration(std::llround(seconds * 1e9));
}

v1::ServerLimits LimitsOf(const ServerConfig& config) {
  const LimitConfig& limits = config.limits;
  v1::ServerLimits proto;
  proto.set_max_receive_bytes(limits.max_receive_bytes);
  proto.set_max_batch_observation_count(limits.max_batch_observations);
  proto.set_stream_window_observation_count(limits.stream_window_observations);
  proto.set_max_beam_count(config.mission.max_beam_count);
  *proto.mutable_max_planning_budget() = FromSeconds(config.planning.max_budget_s);
  proto.set_max_map_part_bytes(config.maps.max_part_bytes);
  proto.set_max_mission_count(limits.max_missions);
  proto.set_memory_budget_bytes(limits.memory_budget_bytes);
  proto.set_mission_memory_budget_bytes(limits.mission_memory_budget_bytes);
  proto.set_max_scans_per_s(limits.max_scans_per_s);
  proto.set_max_gas_readings_per_s(limits.max_gas_readings_per_s);
  proto.set_max_plans_per_s(limits.max_plans_per_s);
  proto.set_max_calls_per_s(limits.max_calls_per_s);
  proto.set_max_costly_calls_per_s(limits.max_costly_calls_per_s);
  proto.set_max_ingest_bytes_per_s(limits.max_ingest_bytes_per_s);
  *proto.mutable_ingest_burst() = FromSeconds(limits.ingest_burst_s);
  proto.set_max_mission_beam_count(limits.max_beam_count);
  proto.set_max_range_m(limits.max_range_m);
  proto.set_max_map_cell_count(limits.max_map_cell_count);
  proto.set_max_import_bytes(limits.max_import_bytes);
  *proto.mutable_max_wait() = FromSeconds(limits.max_wait_s);
  proto.set_max_robot_watcher_count(limits.max_watchers_per_robot);
  *proto.mutable_max_clock_lead() = FromSeconds(limits.max_clock_lead_s);
  return proto;
}

}  // namespace

absl::Status SystemService::Tell(v1::GetServerInfoResponse& response,
                                 const std::shared_ptr<UnaryCall>& call) {
  response.set_version(kVersion);
  response.set_boot_id(context_.boot_id);
  *response.mutable_uptime() = TimeUtil::NanosecondsToDuration(
      absl::ToInt64Nanoseconds(absl::FromChrono(SteadyNow() - started_)));
  *response.mutable_limits() = LimitsOf(config_);
  if (config_.planning.rivals) response.add_features("rivals");
  if (!config_.access.tls_certificate_file.empty()) response.add_features("tls");
  if (!config_.access.tokens_file.empty()) response.add_features("tokens");
  response.set_caller(call->caller().name);
  response.set_caller_role(std::string(RoleName(call->caller().role)));
  *response.mutable_store() = store_();
  if (call->caller().role < Role::kOperator) response.mutable_store()->clear_trouble();
  call->Answer(absl::OkStatus());
  return absl::OkStatus();
}

absl::Status SystemService::Drain(const std::shared_ptr<UnaryCall>& call) {
  if (!drain_) return absl::UnimplementedError("this server is ended by the process it is part of");
  LogInfo("asked to drain",
          {{"caller", call->caller().name}, {"request_id", call->info().request_id}});
  // The call lets go of this when its answer is out.
  call->WhenCancelled(
      [last_act = std::shared_ptr<void>(nullptr, [drain = drain_](void*) { drain(); })] {});
  call->Answer(absl::OkStatus());
  return absl::OkStatus();
}

grpc::ServerUnaryReactor* SystemService::GetServerInfo(grpc::CallbackServerContext* context,
                                                       const v1::GetServerInfoRequest*,
                                                       v1::GetServerInfoResponse* response) {
  return UnaryCall::Start(
      context_, Rpc::kGetServerInfo, context,
      [=, this](const std::shared_ptr<UnaryCall>& call) { return Tell(*response, call); });
}

grpc::ServerUnaryReactor* SystemService::DrainServer(grpc::CallbackServerContext* context,
                                                     const v1::DrainServerRequest*,
                                                     v1::DrainServerResponse*) {
  return UnaryCall::Start(
      context_, Rpc::kDrainServer, context,
      [=, this](const std::shared_ptr<UnaryCall>& call) { return Drain(call); });
}

}  // namespace plumescout::server
