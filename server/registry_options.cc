// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/registry_options.h"

#include <algorithm>

#include "absl/time/time.h"

namespace plumescout::server {
namespace {

RateOptions ToRateOptions(const LimitConfig& limits) {
  return {.scans_per_s = limits.max_scans_per_s,
          .gas_readings_per_s = limits.max_gas_readings_per_s,
          .ingest_bytes_per_s = limits.max_ingest_bytes_per_s,
          .plans_per_s = limits.max_plans_per_s,
          .ingest_burst = absl::Seconds(limits.ingest_burst_s)};
}

}  // namespace

RegistryOptions ToRegistryOptions(const ServerConfig& config, std::int64_t first_lease_token) {
  RegistryOptions options;
  options.max_missions = config.limits.max_missions;
  options.max_missions_per_tenant = config.limits.max_missions_per_tenant;
  options.memory_budget_bytes = config.limits.memory_budget_bytes;
  options.mission_memory_budget_bytes = config.limits.mission_memory_budget_bytes;
  options.max_map_cell_count = config.limits.max_map_cell_count;
  options.max_beam_count = config.limits.max_beam_count;
  options.max_range_m = config.limits.max_range_m;
  options.host.max_queued_observations = config.limits.max_queued_observations;
  options.host.max_queued_bytes = config.limits.max_queued_bytes;
  options.host.max_waiters = config.limits.max_waiting_calls;
  options.host.max_watchers_per_robot = config.limits.max_watchers_per_robot;
  options.host.max_wait = absl::Seconds(config.limits.max_wait_s);
  options.host.publish_period = absl::Seconds(config.maps.publish_period_s);
  options.host.gas_wait = absl::Seconds(config.maps.gas_wait_s);
  options.host.max_map_part_bytes = config.maps.max_part_bytes;
  options.host.lease_hold = absl::Seconds(config.connection.lease_hold_s);
  options.host.first_lease_token = first_lease_token;
  options.host.max_clock_lead = absl::Seconds(config.limits.max_clock_lead_s);
  options.host.rates = ToRateOptions(config.limits);
  options.max_backlog_bytes = config.store.max_backlog_bytes;
  if (config.store.sleep_after_s > 0.0) {
    options.sleep_after = absl::Seconds(config.store.sleep_after_s);
  }
  return options;
}

ImportLimits ToImportLimits(const ServerConfig& config) {
  ImportLimits limits;
  limits.max_bytes = config.limits.max_import_bytes;
  if (config.store.engine == kSqliteStore) {
    limits.folder = StoreFolder(config.store).value_or("");  // where there should be room
  }
  return limits;
}

RecordingOptions ToRecordingOptions(const RecordConfig& config) {
  RecordingOptions options;
  options.folder = config.folder;
  options.map_period_s = config.map_period_s;
  options.map_share = config.map_share;
  options.file.chunk_period = absl::Seconds(config.chunk_s);
  options.file.max_file_bytes = config.max_file_bytes;
  return options;
}

ServiceLimits ToServiceLimits(const ServerConfig& config) {
  ServiceLimits limits;
  limits.max_batch_observations = config.limits.max_batch_observations;
  limits.stream_window_observations = config.limits.stream_window_observations;
  limits.default_planning_budget = absl::Seconds(config.planning.default_budget_s);
  limits.max_planning_budget = absl::Seconds(config.planning.max_budget_s);
  limits.deadline_margin = absl::Seconds(config.planning.deadline_margin_s);
  limits.replay_period = absl::Seconds(config.maps.publish_period_s);
  limits.import_patience = limits.export_patience = absl::Seconds(config.limits.max_wait_s);
  return limits;
}

FairPoolOptions ToPlanningPoolOptions(const PlanningConfig& config) {
  FairPoolOptions options;
  options.name = "planning";
  options.threads = config.threads;
  options.max_queued = config.max_queued;
  options.max_queued_per_group = config.max_queued_per_mission;
  options.max_queued_per_member = config.max_queued_per_robot;
  options.max_running_per_group = config.max_running_per_mission > 0
                                      ? config.max_running_per_mission
                                      : std::max(1, config.threads - 1);
  return options;
}

FairPoolOptions ToViewersPoolOptions(const std::string& name, int threads,
                                     const MapConfig& config) {
  FairPoolOptions options;
  options.name = name;
  options.threads = threads;
  options.max_queued = config.max_queued_queries;
  options.max_queued_per_group = options.max_queued_per_member =
      std::max(1, options.max_queued / 2);
  options.max_running_per_group = options.max_running_per_member = threads;
  options.groups_leave_room = true;
  options.yields = true;
  return options;
}

}  // namespace plumescout::server
