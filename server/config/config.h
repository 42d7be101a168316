// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/options.h"

namespace plumescout::server {

struct LimitConfig {
  int max_missions = 8;
  // Of all missions together, each counted with all that it may come to hold.
  std::int64_t memory_budget_bytes = std::int64_t{4} << 30;
  int max_receive_bytes = 262'144;  // of one request message
  int max_batch_observations = 1024;
  int stream_window_observations = 128;  // in flight on one ingest stream
  int max_queued_observations = 4096;    // of one mission
  int max_waiting_calls = 256;           // of one mission, for a belief
  int max_streams_per_connection = 100;
  std::int64_t max_queued_bytes = 8'388'608;  // of one mission's observations that wait
  double max_wait_s = 30.0;                   // for a belief, whatever the caller's deadline
  // What missions may choose for themselves at most.
  std::int64_t mission_memory_budget_bytes = std::int64_t{1} << 30;
  std::int64_t max_map_cell_count = 16'000'000;
  int max_beam_count = 16'384;
  double max_range_m = 300.0;
  // Of one robot; 0: any number.
  double max_scans_per_s = 50.0;
  double max_gas_readings_per_s = 200.0;
  double max_ingest_bytes_per_s = 4'194'304.0;
  double max_plans_per_s = 10.0;
  double ingest_burst_s = 60.0;   // so much time's worth of observations may come at once
  double max_clock_lead_s = 5.0;  // of a robot's sample; 0: any
  std::int64_t max_import_bytes = std::int64_t{4} << 30;
  int max_watchers_per_robot = 64;  // with its lease, and as many without
  // Of one caller; 0: any number.
  double max_calls_per_s = 2000.0;
  double max_costly_calls_per_s = 500.0;
  int max_missions_per_tenant = 0;                             // 0: as many as there are
  std::int64_t max_connection_bytes = std::int64_t{64} << 20;  // of all connections
};

struct PlanningConfig {
  int threads = 3;
  int max_queued = 64;
  double default_budget_s = 1.0;
  double max_budget_s = 5.0;
  double deadline_margin_s = 0.02;  // kept back from a call's deadline for commit and reply
  bool rivals = false;              // missions may choose the planners of OMPL
  int max_queued_per_mission = 32;
  int max_queued_per_robot = 4;
  int max_running_per_mission = 0;  // 0: all threads but one, but at least one
};

struct MapConfig {
  int threads = 1;
  int max_queued = 128;
  double publish_period_s = 0.1;
  double gas_wait_s = 0.06;  // in spite of the period, a reading is seen after this
  int query_threads = 2;
  int max_queued_queries = 256;
  int max_part_bytes = 3 << 20;  // of one message; clients take 4 MiB unless told otherwise
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
  double drain_s = 1.0;              // calls in flight get this long when the server stops
  double self_probe_period_s = 5.0;  // the server knocks at its own door this often; 0: never
};

// Values of trusted_front that are no names: whoever comes from this machine, or by a Unix socket.
inline constexpr char kLocalFront[] = "loopback";
inline constexpr char kUnixFront[] = "unix";

struct AccessConfig {
  std::string tls_certificate_file = "";  // empty: plaintext, as for those that follow
  std::string tls_key_file = "";
  std::string client_ca_file = "";
  bool require_client_certificate = false;
  std::string tokens_file = "";
  bool allow_anonymous = false;
  bool allow_plaintext = false;
  std::string trusted_front = "";
};

struct ObserveConfig {
  std::string http_listen = "auto";  // of metrics and health; see HttpListen
  std::string log_level = "info";
  std::string log_format = "text";
  double slow_call_s = 1.0;  // calls that take longer are logged with what they waited for
  bool reflection = true;
  bool channelz = false;
};

struct ConsoleConfig {
  std::string listen = "";    // empty: there is none
  std::string folder = "";    // of its pages; empty: calls alone are served
  int max_stream_count = 64;  // of all pages, at one time
  std::string hosts = "";     // names of a front, with commas between
};

struct RecordConfig {
  std::string folder = "";  // empty: missions are not recorded
  double map_period_s = 10.0;
  double map_share = 0.1;  // MissionView::kMapShare
  double chunk_s = 10.0;
  std::int64_t max_file_bytes = std::int64_t{1} << 30;
};

// Values of store.engine.
inline constexpr char kNoStore[] = "none";
inline constexpr char kSqliteStore[] = "sqlite";
inline constexpr char kPostgresqlStore[] = "postgresql";

struct StoreConfig {
  // Whoever makes a server in a process of theirs says where it may write; see ProgramDefaults.
  std::string engine = kNoStore;
  std::string folder = "";  // empty: see StoreFolder
  std::int64_t max_backlog_bytes = 67'108'864;
  int recovery_threads = 2;
  double slow_commit_s = 0.1;
  double sleep_after_s = 900.0;
  std::string url = "";   // may hold a password: it goes into no log and no message
  std::string node = "";  // a word
  double lease_s = 10.0;
  std::string advertise = "";          // empty: ServerConfig::listen
  std::string cluster = "plumescout";  // a word
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
  AccessConfig access;
  ObserveConfig observe;
  StoreConfig store;
  ConsoleConfig console;
  RecordConfig record;
  MissionOptions mission;  // what missions get for fields that their creator leaves unset
};

// What plumescout-server begins with: missions are kept.
ServerConfig ProgramDefaults();

// kInvalidArgument naming option, value and range: "planning.threads = 0 must be in [1, 256]".
absl::Status Validate(const ServerConfig& config);

// Whether the text is the URL of a database in PostgreSQL, by how it begins.
bool IsPostgresqlUrl(absl::string_view text);

// Where missions are kept: store.folder, or else plumescout below the user's folder of state,
// $XDG_STATE_HOME or ~/.local/state. kInvalidArgument if the user has none.
absl::StatusOr<std::string> StoreFolder(const StoreConfig& store);

// Whether callers of this machine alone reach the server, by gRPC or through the console.
bool IsServedLocally(const ServerConfig& config);

// Where HTTP is served. For "auto" that is the port after the one of `listen` on loopback, or any
// free one if `listen` takes any. Empty: nowhere.
std::string HttpListen(const ServerConfig& config);

}  // namespace plumescout::server
