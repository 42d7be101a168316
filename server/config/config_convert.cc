// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config_convert.h"

#include "core/types/status_macros.h"
#include "proto/convert/option_binding.h"
#include "proto/convert/options.h"
#include "server/config/mission_options.h"

namespace plumescout::server {
namespace {

void Visit(OneOf<LimitConfig> auto& limits, auto& field) {
  field("max_missions", limits.max_missions);
  field("max_total_cells", limits.max_total_cells);
  field("max_receive_bytes", limits.max_receive_bytes);
  field("max_batch_observations", limits.max_batch_observations);
  field("stream_window_observations", limits.stream_window_observations);
  field("max_queued_observations", limits.max_queued_observations);
  field("max_waiting_calls", limits.max_waiting_calls);
  field("max_streams_per_connection", limits.max_streams_per_connection);
}

void Visit(OneOf<PlanningConfig> auto& planning, auto& field) {
  field("threads", planning.threads);
  field("max_queued", planning.max_queued);
  field("default_budget_s", planning.default_budget_s);
  field("max_budget_s", planning.max_budget_s);
  field("deadline_margin_s", planning.deadline_margin_s);
  field("rivals", planning.rivals);
}

void Visit(OneOf<MapConfig> auto& maps, auto& field) {
  field("threads", maps.threads);
  field("max_queued", maps.max_queued);
  field("publish_period_s", maps.publish_period_s);
  field("gas_wait_s", maps.gas_wait_s);
}

void Visit(OneOf<EpochConfig> auto& epochs, auto& field) {
  field("threads", epochs.threads);
  field("max_queued", epochs.max_queued);
}

void Visit(OneOf<ConnectionConfig> auto& connection, auto& field) {
  field("keepalive_time_s", connection.keepalive_time_s);
  field("keepalive_timeout_s", connection.keepalive_timeout_s);
  field("min_client_ping_interval_s", connection.min_client_ping_interval_s);
  field("lease_hold_s", connection.lease_hold_s);
  field("drain_s", connection.drain_s);
}

void Visit(OneOf<ServerConfig> auto& config, auto& field) { field("listen", config.listen); }

void Write(const auto& config, google::protobuf::Message& proto) {
  OptionWriter field(proto);
  Visit(config, field);
}

// There is nothing to refuse before Validate: no enums.
void Read(const google::protobuf::Message& proto, auto& config) {
  OptionReader field(proto, "");
  Visit(config, field);
}

}  // namespace

config::v1::ServerConfig ToProto(const ServerConfig& config) {
  config::v1::ServerConfig proto;
  Write(config, proto);
  Write(config.limits, *proto.mutable_limits());
  Write(config.planning, *proto.mutable_planning());
  Write(config.maps, *proto.mutable_maps());
  Write(config.epochs, *proto.mutable_epochs());
  Write(config.connection, *proto.mutable_connection());
  *proto.mutable_mission() = plumescout::ToProto(config.mission);
  return proto;
}

absl::StatusOr<ServerConfig> FromProto(const config::v1::ServerConfig& proto) {
  ServerConfig config;
  Read(proto, config);
  Read(proto.limits(), config.limits);
  Read(proto.planning(), config.planning);
  Read(proto.maps(), config.maps);
  Read(proto.epochs(), config.epochs);
  Read(proto.connection(), config.connection);
  PLUMESCOUT_ASSIGN_OR_RETURN(config.mission,
                              ReadMissionOptions(proto.mission(), config.mission, "mission"));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config));
  return config;
}

}  // namespace plumescout::server
