// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"

namespace plumescout::client {

// What one call or one client may ask for.
struct ServerLimits {
  std::int64_t max_receive_bytes = 0;  // of one request
  int max_batch_observations = 0;
  int stream_window_observations = 0;  // in flight on one ingest stream
  int max_beams = 0;                   // of one scan
  absl::Duration max_planning_budget;
  std::int64_t max_map_part_bytes = 0;  // about
  int max_missions = 0;
  std::int64_t memory_budget_bytes = 0;  // of all missions
  std::int64_t mission_memory_budget_bytes = 0;
  // Of one robot; 0: any number.
  double max_scans_per_s = 0.0;
  double max_gas_readings_per_s = 0.0;
  double max_plans_per_s = 0.0;
  absl::Duration max_clock_lead;  // of a sample before the server's clock

  friend bool operator==(const ServerLimits&, const ServerLimits&) = default;
};

// Where a server keeps its missions.
struct StoreInfo {
  std::string engine;              // none, sqlite or postgresql
  std::string node;                // of a cluster; empty: the server is alone
  std::string cluster;             // as well
  bool is_available = false;       // whether it takes data now
  std::string trouble;             // what keeps it from that, for operators and admins
  std::int64_t backlog_bytes = 0;  // waits to be durable
  std::int64_t stored_bytes = 0;   // of all missions; looked up once a minute
};

struct ServerInfo {
  std::string version;
  std::string boot_id;  // changes when the server restarts
  absl::Duration uptime;
  ServerLimits limits;
  std::vector<std::string> features;  // optional parts: "rivals", "tls", "tokens"
  std::string caller;                 // name of the caller, as the server knows it
  std::string caller_role;            // robot, viewer, operator or admin
  StoreInfo store;
};

// The server itself. Thread-safe.
class ServerClient {
 public:
  virtual ~ServerClient() = default;

  virtual absl::StatusOr<ServerInfo> GetServerInfo() = 0;
  // Takes it out of service; for admins. Calls in flight get connection.drain_s, then it ends.
  virtual absl::Status DrainServer() = 0;
};

}  // namespace plumescout::client
