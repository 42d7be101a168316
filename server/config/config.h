// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "core/types/options.h"

namespace plumescout::server {

struct LimitConfig {
  int max_missions = 64;
  std::int64_t max_total_cells = 128'000'000;  // of all missions' maps together
  int max_receive_bytes = 262'144;             // of one request message
  int max_batch_observations = 1024;
  int stream_window_observations = 128;  // in flight on one ingest stream
  int max_queued_observations = 4096;    // of one mission
  int max_waiting_calls = 256;           // of one mission, for a belief
  int max_streams_per_connection = 100;
};

struct PlanningConfig {
  int threads = 2;
  int max_queued = 64;
  double default_budget_s = 1.0;
  double max_budget_s = 60.0;
  double deadline_margin_s = 0.02;  // kept back from a call's deadline for commit and reply
  bool rivals = false;              // missions may choose the planners of OMPL
};

struct MapConfig {
  int threads = 1;
  int max_queued = 128;
  double publish_period_s = 0.1;
  double gas_wait_s = 0.06;  // in spite of the period, a reading is seen after this
};

struct EpochConfig {
  int threads = 1;
  int max_queued = 64;
};

struct ConnectionConfig {
  double keepalive_time_s = 10.0;
  double keepalive_timeout_s = 5.0;
  double min_client_ping_interval_s = 5.0;  // clients that ping more often are sent away
  double lease_hold_s = 10.0;
  double drain_s = 1.0;  // calls in flight get this long when the server stops
};

// Everything that can be set, by file or flag: the fields of plumescout.config.v1.ServerConfig,
// where their meaning and range stand. See config_file.h.
struct ServerConfig {
  std::string listen = "127.0.0.1:50551";
  LimitConfig limits;
  PlanningConfig planning;
  MapConfig maps;
  EpochConfig epochs;
  ConnectionConfig connection;
  MissionOptions mission;  // what missions get for fields that their creator leaves unset
};

// kInvalidArgument naming option, value and range: "planning.threads = 0 must be in [1, 256]".
absl::Status Validate(const ServerConfig& config);

}  // namespace plumescout::server
