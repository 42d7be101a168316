// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config_table.h"

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace plumescout::server {
namespace {

constexpr double kMaxThreads = 256;
constexpr double kMaxCount = 1e6;
constexpr double kMaxBytes = 64.0 * 1024 * 1024;
constexpr double kDay_s = 86'400;

absl::Status Refuse(const ConfigRow& row, const std::string& text) {
  return absl::InvalidArgumentError(
      absl::StrCat(row.key, " = ", text, " must be a number in [", row.low, ", ", row.high, "]"));
}

bool Parse(const std::string& text, int* value) { return absl::SimpleAtoi(text, value); }
bool Parse(const std::string& text, std::int64_t* value) { return absl::SimpleAtoi(text, value); }
bool Parse(const std::string& text, double* value) { return absl::SimpleAtod(text, value); }

template <typename Number>
absl::Status SetNumber(const ConfigRow& row, const std::string& text, Number* target) {
  Number value{};
  if (!Parse(text, &value)) return Refuse(row, text);
  const auto number = static_cast<double>(value);
  if (!(number >= row.low && number <= row.high)) return Refuse(row, text);
  *target = value;
  return absl::OkStatus();
}

}  // namespace

std::vector<ConfigRow> ConfigTable(ServerConfig& config) {
  LimitConfig& limits = config.limits;
  PlanningConfig& planning = config.planning;
  MapConfig& maps = config.maps;
  EpochConfig& epochs = config.epochs;
  ConnectionConfig& connection = config.connection;
  return {
      {"listen", "address and port; port 0: any free one", &config.listen},
      {"limits.max_missions", "missions at one time", &limits.max_missions, 1, kMaxCount},
      {"limits.max_total_cells", "cells that all maps together may grow to",
       &limits.max_total_cells, 1, 1e12},
      {"limits.max_receive_bytes", "size of one request", &limits.max_receive_bytes, 4096,
       kMaxBytes},
      {"limits.max_batch_observations", "observations in one batch", &limits.max_batch_observations,
       1, kMaxCount},
      {"limits.stream_window_observations", "observations in flight on one ingest stream",
       &limits.stream_window_observations, 1, kMaxCount},
      {"limits.max_queued_observations", "observations that wait for one mission's writer",
       &limits.max_queued_observations, 1, kMaxCount},
      {"limits.max_waiting_calls", "calls that wait for one mission's belief",
       &limits.max_waiting_calls, 1, kMaxCount},
      {"limits.max_streams_per_connection", "calls open at one time on one connection",
       &limits.max_streams_per_connection, 1, kMaxCount},
      {"planning.threads", "threads that plan", &planning.threads, 1, kMaxThreads},
      {"planning.max_queued", "plans that wait for a thread", &planning.max_queued, 1, kMaxCount},
      {"planning.default_budget_s", "time for a plan whose caller names none",
       &planning.default_budget_s, 0.001, 3600},
      {"planning.max_budget_s", "longest time for a plan", &planning.max_budget_s, 0.001, 3600},
      {"planning.deadline_margin_s", "kept back from a call's deadline for the way back",
       &planning.deadline_margin_s, 0, 10},
      {"maps.threads", "threads that make map frames", &maps.threads, 1, kMaxThreads},
      {"maps.max_queued", "map frames that wait for a thread", &maps.max_queued, 1, kMaxCount},
      {"maps.publish_period_s", "watchers see a new belief at most this often",
       &maps.publish_period_s, 0.01, 60},
      {"maps.gas_wait_s", "but see an acknowledged reading after this at the latest",
       &maps.gas_wait_s, 0.01, 60},
      {"epochs.threads", "threads that recompute gas posteriors beside the missions",
       &epochs.threads, 1, kMaxThreads},
      {"epochs.max_queued", "recomputations that wait for a thread", &epochs.max_queued, 1,
       kMaxCount},
      {"connection.keepalive_time_s", "silence after which a connection is probed",
       &connection.keepalive_time_s, 1, kDay_s},
      {"connection.keepalive_timeout_s", "time to answer the probe",
       &connection.keepalive_timeout_s, 1, kDay_s},
      {"connection.min_client_ping_interval_s", "clients that ping more often are sent away",
       &connection.min_client_ping_interval_s, 0.1, kDay_s},
      {"connection.lease_hold_s", "a lease outlives its last use by this", &connection.lease_hold_s,
       0.1, kDay_s},
      {"connection.drain_s", "time that calls in flight get when the server stops",
       &connection.drain_s, 0, 60},
  };
}

absl::Status SetRow(const ConfigRow& row, const std::string& text) {
  if (auto* const* target = std::get_if<std::string*>(&row.target)) {
    **target = text;
    return absl::OkStatus();
  }
  if (auto* const* target = std::get_if<int*>(&row.target)) return SetNumber(row, text, *target);
  if (auto* const* target = std::get_if<std::int64_t*>(&row.target)) {
    return SetNumber(row, text, *target);
  }
  return SetNumber(row, text, std::get<double*>(row.target));
}

std::string RowText(const ConfigRow& row) {
  return std::visit([](const auto* target) { return absl::StrCat(*target); }, row.target);
}

}  // namespace plumescout::server
