// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config.h"

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"

namespace plumescout::server {
namespace {

constexpr double kMaxThreads = 256;
constexpr double kMaxCount = 1e6;
constexpr double kMaxBytes = 64.0 * 1024 * 1024;
constexpr double kMaxCells = 1e12;
constexpr double kDay_s = 86'400;

absl::Status Validate(const LimitConfig& limits) {
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRange("limits.max_missions", limits.max_missions, 1, kMaxCount)
          .InRange("limits.max_total_cells", static_cast<double>(limits.max_total_cells), 1,
                   kMaxCells)
          .InRange("limits.max_receive_bytes", limits.max_receive_bytes, 4096, kMaxBytes)
          .InRange("limits.max_batch_observations", limits.max_batch_observations, 1, kMaxCount)
          .InRange("limits.stream_window_observations", limits.stream_window_observations, 1,
                   kMaxCount)
          .InRange("limits.max_queued_observations", limits.max_queued_observations, 1, kMaxCount)
          .InRange("limits.max_waiting_calls", limits.max_waiting_calls, 1, kMaxCount)
          .InRange("limits.max_streams_per_connection", limits.max_streams_per_connection, 1,
                   kMaxCount)
          .status());
  if (limits.stream_window_observations <= limits.max_queued_observations &&
      limits.max_batch_observations <= limits.max_queued_observations) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      absl::StrCat("limits.max_queued_observations = ", limits.max_queued_observations,
                   " must hold a batch and the window of a stream"));
}

absl::Status Validate(const PlanningConfig& planning) {
  return Checker()
      .InRange("planning.threads", planning.threads, 1, kMaxThreads)
      .InRange("planning.max_queued", planning.max_queued, 1, kMaxCount)
      .InRange("planning.default_budget_s", planning.default_budget_s, 0.001, 3600)
      .InRange("planning.max_budget_s", planning.max_budget_s, 0.001, 3600)
      .InRange("planning.deadline_margin_s", planning.deadline_margin_s, 0, 10)
      .status();
}

absl::Status Validate(const MapConfig& maps) {
  return Checker()
      .InRange("maps.threads", maps.threads, 1, kMaxThreads)
      .InRange("maps.max_queued", maps.max_queued, 1, kMaxCount)
      .InRange("maps.publish_period_s", maps.publish_period_s, 0.01, 60)
      .InRange("maps.gas_wait_s", maps.gas_wait_s, 0.01, 60)
      .status();
}

absl::Status Validate(const EpochConfig& epochs) {
  return Checker()
      .InRange("epochs.threads", epochs.threads, 1, kMaxThreads)
      .InRange("epochs.max_queued", epochs.max_queued, 1, kMaxCount)
      .status();
}

absl::Status Validate(const ConnectionConfig& connection) {
  return Checker()
      .InRange("connection.keepalive_time_s", connection.keepalive_time_s, 1, kDay_s)
      .InRange("connection.keepalive_timeout_s", connection.keepalive_timeout_s, 1, kDay_s)
      .InRange("connection.min_client_ping_interval_s", connection.min_client_ping_interval_s, 0.1,
               kDay_s)
      .InRange("connection.lease_hold_s", connection.lease_hold_s, 0.1, kDay_s)
      .InRange("connection.drain_s", connection.drain_s, 0, 60)
      .status();
}

}  // namespace

absl::Status Validate(const ServerConfig& config) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.limits));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.planning));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.maps));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.epochs));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.connection));
  return WithField(plumescout::Validate(config.mission), "mission");
}

}  // namespace plumescout::server
