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
  field("memory_budget_bytes", limits.memory_budget_bytes);
  field("max_receive_bytes", limits.max_receive_bytes);
  field("max_batch_observations", limits.max_batch_observations);
  field("stream_window_observations", limits.stream_window_observations);
  field("max_queued_observations", limits.max_queued_observations);
  field("max_waiting_calls", limits.max_waiting_calls);
  field("max_streams_per_connection", limits.max_streams_per_connection);
  field("max_queued_bytes", limits.max_queued_bytes);
  field("max_wait_s", limits.max_wait_s);
  field("mission_memory_budget_bytes", limits.mission_memory_budget_bytes);
  field("max_map_cell_count", limits.max_map_cell_count);
  field("max_beam_count", limits.max_beam_count);
  field("max_range_m", limits.max_range_m);
  field("max_scans_per_s", limits.max_scans_per_s);
  field("max_gas_readings_per_s", limits.max_gas_readings_per_s);
  field("max_ingest_bytes_per_s", limits.max_ingest_bytes_per_s);
  field("max_plans_per_s", limits.max_plans_per_s);
  field("ingest_burst_s", limits.ingest_burst_s);
  field("max_clock_lead_s", limits.max_clock_lead_s);
  field("max_import_bytes", limits.max_import_bytes);
  field("max_watchers_per_robot", limits.max_watchers_per_robot);
  field("max_calls_per_s", limits.max_calls_per_s);
  field("max_costly_calls_per_s", limits.max_costly_calls_per_s);
  field("max_missions_per_tenant", limits.max_missions_per_tenant);
  field("max_connection_bytes", limits.max_connection_bytes);
}

void Visit(OneOf<PlanningConfig> auto& planning, auto& field) {
  field("threads", planning.threads);
  field("max_queued", planning.max_queued);
  field("default_budget_s", planning.default_budget_s);
  field("max_budget_s", planning.max_budget_s);
  field("deadline_margin_s", planning.deadline_margin_s);
  field("rivals", planning.rivals);
  field("max_queued_per_mission", planning.max_queued_per_mission);
  field("max_queued_per_robot", planning.max_queued_per_robot);
  field("max_running_per_mission", planning.max_running_per_mission);
}

void Visit(OneOf<MapConfig> auto& maps, auto& field) {
  field("threads", maps.threads);
  field("max_queued", maps.max_queued);
  field("publish_period_s", maps.publish_period_s);
  field("gas_wait_s", maps.gas_wait_s);
  field("query_threads", maps.query_threads);
  field("max_queued_queries", maps.max_queued_queries);
  field("max_part_bytes", maps.max_part_bytes);
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
  field("self_probe_period_s", connection.self_probe_period_s);
}

void Visit(OneOf<AccessConfig> auto& access, auto& field) {
  field("tls_certificate_file", access.tls_certificate_file);
  field("tls_key_file", access.tls_key_file);
  field("client_ca_file", access.client_ca_file);
  field("require_client_certificate", access.require_client_certificate);
  field("tokens_file", access.tokens_file);
  field("allow_anonymous", access.allow_anonymous);
  field("allow_plaintext", access.allow_plaintext);
  field("trusted_front", access.trusted_front);
}

void Visit(OneOf<ObserveConfig> auto& observe, auto& field) {
  field("http_listen", observe.http_listen);
  field("log_level", observe.log_level);
  field("log_format", observe.log_format);
  field("slow_call_s", observe.slow_call_s);
  field("reflection", observe.reflection);
  field("channelz", observe.channelz);
}

void Visit(OneOf<StoreConfig> auto& store, auto& field) {
  field("engine", store.engine);
  field("folder", store.folder);
  field("max_backlog_bytes", store.max_backlog_bytes);
  field("recovery_threads", store.recovery_threads);
  field("slow_commit_s", store.slow_commit_s);
  field("sleep_after_s", store.sleep_after_s);
  field("url", store.url);
  field("node", store.node);
  field("lease_s", store.lease_s);
  field("advertise", store.advertise);
  field("cluster", store.cluster);
}

void Visit(OneOf<ConsoleConfig> auto& console, auto& field) {
  field("listen", console.listen);
  field("folder", console.folder);
  field("max_stream_count", console.max_stream_count);
  field("hosts", console.hosts);
}

void Visit(OneOf<RecordConfig> auto& record, auto& field) {
  field("folder", record.folder);
  field("map_period_s", record.map_period_s);
  field("map_share", record.map_share);
  field("chunk_s", record.chunk_s);
  field("max_file_bytes", record.max_file_bytes);
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

config::v1::ServerConfig ServerConfigToProto(const ServerConfig& config) {
  config::v1::ServerConfig proto;
  Write(config, proto);
  Write(config.limits, *proto.mutable_limits());
  Write(config.planning, *proto.mutable_planning());
  Write(config.maps, *proto.mutable_maps());
  Write(config.epochs, *proto.mutable_epochs());
  Write(config.connection, *proto.mutable_connection());
  Write(config.access, *proto.mutable_access());
  Write(config.observe, *proto.mutable_observe());
  Write(config.store, *proto.mutable_store());
  Write(config.console, *proto.mutable_console());
  Write(config.record, *proto.mutable_record());
  *proto.mutable_mission() = plumescout::ToProto(config.mission);
  return proto;
}

absl::StatusOr<ServerConfig> ServerConfigFromProto(const config::v1::ServerConfig& proto) {
  ServerConfig config;
  Read(proto, config);
  Read(proto.limits(), config.limits);
  Read(proto.planning(), config.planning);
  Read(proto.maps(), config.maps);
  Read(proto.epochs(), config.epochs);
  Read(proto.connection(), config.connection);
  Read(proto.access(), config.access);
  Read(proto.observe(), config.observe);
  Read(proto.store(), config.store);
  Read(proto.console(), config.console);
  Read(proto.record(), config.record);
  PLUMESCOUT_ASSIGN_OR_RETURN(config.mission,
                              ReadMissionOptions(proto.mission(), config.mission, "mission"));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config));
  return config;
}

}  // namespace plumescout::server
