// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <optional>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "server/base/address.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

constexpr double kMaxThreads = 256;
constexpr double kMaxCount = 1e6;
constexpr int kMaxBytes = 64 << 20;
constexpr std::int64_t kMaxQueuedBytes = std::int64_t{1} << 40;
// Ranges travel as 16 bits and are kept as 32.
constexpr std::int64_t kReadOverWire = 2;
constexpr std::int64_t kMinConnection_bytes = std::int64_t{16} << 20;
constexpr std::int64_t kMinBudget_bytes = std::int64_t{32} << 20;
constexpr std::int64_t kMaxBudget_bytes = 1'000'000'000'000;
constexpr double kMaxRate = 1e12;
constexpr double kDay_s = 86'400;

absl::Status Validate(const LimitConfig& limits) {
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRange("limits.max_missions", limits.max_missions, 1, kMaxCount)
          .InRange("limits.memory_budget_bytes", limits.memory_budget_bytes, kMinBudget_bytes,
                   kMaxBudget_bytes)
          .InRange("limits.mission_memory_budget_bytes", limits.mission_memory_budget_bytes,
                   kMinBudget_bytes, kMaxBudget_bytes)
          .InRange("limits.max_map_cell_count", limits.max_map_cell_count, 4096, 16'000'000)
          .InRange("limits.max_beam_count", limits.max_beam_count, 1, 100'000)
          .InRange("limits.max_range_m", limits.max_range_m, 0.1, 1000)
          .InRange("limits.max_receive_bytes", limits.max_receive_bytes, 4096, kMaxBytes)
          .InRange("limits.max_batch_observations", limits.max_batch_observations, 1, kMaxCount)
          .InRange("limits.stream_window_observations", limits.stream_window_observations, 1,
                   kMaxCount)
          .InRange("limits.max_queued_observations", limits.max_queued_observations, 1, kMaxCount)
          .InRange("limits.max_queued_bytes", limits.max_queued_bytes, 4096, kMaxQueuedBytes)
          .InRange("limits.max_waiting_calls", limits.max_waiting_calls, 1, kMaxCount)
          .InRange("limits.max_wait_s", limits.max_wait_s, 0.1, 3600)
          .InRange("limits.max_streams_per_connection", limits.max_streams_per_connection, 1,
                   kMaxCount)
          .InRange("limits.max_connection_bytes", limits.max_connection_bytes, kMinConnection_bytes,
                   kMaxBudget_bytes)
          .status());
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRange("limits.max_scans_per_s", limits.max_scans_per_s, 0, kMaxCount)
          .InRange("limits.max_gas_readings_per_s", limits.max_gas_readings_per_s, 0, kMaxCount)
          .InRange("limits.max_ingest_bytes_per_s", limits.max_ingest_bytes_per_s, 0, kMaxRate)
          .InRange("limits.max_plans_per_s", limits.max_plans_per_s, 0, kMaxCount)
          .InRange("limits.max_missions_per_tenant", limits.max_missions_per_tenant, 0, kMaxCount)
          .InRange("limits.max_calls_per_s", limits.max_calls_per_s, 0, kMaxCount)
          .InRange("limits.max_costly_calls_per_s", limits.max_costly_calls_per_s, 0, kMaxCount)
          .InRange("limits.ingest_burst_s", limits.ingest_burst_s, 1, kDay_s)
          .InRange("limits.max_clock_lead_s", limits.max_clock_lead_s, 0, kDay_s)
          .InRange("limits.max_import_bytes", limits.max_import_bytes, 65536, kMaxQueuedBytes)
          .InRange("limits.max_watchers_per_robot", limits.max_watchers_per_robot, 1, kMaxCount)
          .status());
  if (limits.stream_window_observations > limits.max_queued_observations ||
      limits.max_batch_observations > limits.max_queued_observations) {
    return absl::InvalidArgumentError(
        absl::StrCat("limits.max_queued_observations = ", limits.max_queued_observations,
                     " must hold a batch and the window of a stream"));
  }
  if (limits.max_queued_bytes < kReadOverWire * limits.max_receive_bytes) {
    return absl::InvalidArgumentError(absl::StrCat(
        "limits.max_queued_bytes = ", limits.max_queued_bytes, " must hold ", kReadOverWire,
        " times limits.max_receive_bytes, what a request may be once it is read"));
  }
  if (limits.max_queued_bytes > limits.memory_budget_bytes / limits.max_missions) {
    return absl::InvalidArgumentError(
        absl::StrCat("limits.max_queued_bytes = ", limits.max_queued_bytes, " must fit into ",
                     "limits.memory_budget_bytes = ", limits.memory_budget_bytes,
                     " limits.max_missions = ", limits.max_missions, " times"));
  }
  return absl::OkStatus();
}

// A mission that its creator says nothing of has to be one that the server takes.
absl::Status CheckDefaults(const MissionOptions& mission, const LimitConfig& limits) {
  return Checker()
      .InRange("mission.memory_budget_bytes", mission.memory_budget_bytes, kMinBudget_bytes,
               std::min(limits.memory_budget_bytes, limits.mission_memory_budget_bytes))
      .InRange("mission.occupancy.max_cell_count", mission.occupancy.max_cell_count, 4096,
               limits.max_map_cell_count)
      .InRange("mission.max_beam_count", mission.max_beam_count, 1, limits.max_beam_count)
      .InRange("mission.max_range_m", mission.max_range_m, 0.1, limits.max_range_m)
      .status();
}

absl::Status Validate(const PlanningConfig& planning) {
  return Checker()
      .InRange("planning.threads", planning.threads, 1, kMaxThreads)
      .InRange("planning.max_queued", planning.max_queued, 1, kMaxCount)
      .InRange("planning.max_queued_per_mission", planning.max_queued_per_mission, 1, kMaxCount)
      .InRange("planning.max_queued_per_robot", planning.max_queued_per_robot, 1, kMaxCount)
      .InRange("planning.max_running_per_mission", planning.max_running_per_mission, 0, kMaxThreads)
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
      .InRange("maps.query_threads", maps.query_threads, 1, kMaxThreads)
      .InRange("maps.max_queued_queries", maps.max_queued_queries, 1, kMaxCount)
      .InRange("maps.max_part_bytes", maps.max_part_bytes, 65'536, kMaxBytes)
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
      .InRange("connection.self_probe_period_s", connection.self_probe_period_s, 0, 3600)
      .status();
}

// OK if it holds; otherwise kInvalidArgument naming the option and what it needs.
absl::Status Need(bool holds, absl::string_view option, absl::string_view value,
                  absl::string_view rule) {
  if (holds) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(option, " = ", value, " ", rule));
}

absl::Status Validate(const AccessConfig& access) {
  const bool has_tls = !access.tls_certificate_file.empty();
  const bool front_is_a_name = !access.trusted_front.empty() &&
                               access.trusted_front != kLocalFront &&
                               access.trusted_front != kUnixFront;
  PLUMESCOUT_RETURN_IF_ERROR(Need(has_tls == !access.tls_key_file.empty(), "access.tls_key_file",
                                  access.tls_key_file, "must come with tls_certificate_file"));
  PLUMESCOUT_RETURN_IF_ERROR(Need(access.client_ca_file.empty() || has_tls, "access.client_ca_file",
                                  access.client_ca_file, "needs tls_certificate_file"));
  PLUMESCOUT_RETURN_IF_ERROR(
      Need(!access.require_client_certificate || !access.client_ca_file.empty(),
           "access.require_client_certificate", "true", "needs client_ca_file"));
  PLUMESCOUT_RETURN_IF_ERROR(Need(!front_is_a_name || !access.client_ca_file.empty(),
                                  "access.trusted_front", access.trusted_front,
                                  "must be loopback or unix, or needs client_ca_file"));
  const bool front_is_local = !access.trusted_front.empty() && !front_is_a_name;
  return Need(!access.allow_anonymous || !front_is_local, "access.allow_anonymous", "true",
              "would make an admin of whoever comes through trusted_front without a certificate");
}

// Whether anything can say who calls.
bool TellsCallersApart(const AccessConfig& access) {
  return !access.client_ca_file.empty() || !access.tokens_file.empty() ||
         !access.trusted_front.empty();
}

// What is served to other machines is encrypted, and not to just anybody, unless that is asked for.
absl::Status ValidateReach(const ServerConfig& config) {
  if (IsLocalAddress(config.listen)) return absl::OkStatus();
  const AccessConfig& access = config.access;
  PLUMESCOUT_RETURN_IF_ERROR(
      Need(!access.tls_certificate_file.empty() || access.allow_plaintext, "listen", config.listen,
           "can be reached from other machines: set access.tls_certificate_file and "
           "access.tls_key_file, or access.allow_plaintext = true on a trusted network"));
  return Need(TellsCallersApart(access) || access.allow_anonymous, "listen", config.listen,
              "can be reached from other machines: set access.tokens_file or "
              "access.client_ca_file, or access.allow_anonymous = true to make everybody an admin");
}

// The console speaks plaintext: TLS is for a front before it.
absl::Status ValidateReach(const ConsoleConfig& console, const AccessConfig& access) {
  if (IsLocalAddress(console.listen)) return absl::OkStatus();
  PLUMESCOUT_RETURN_IF_ERROR(Need(
      access.allow_plaintext, "console.listen", console.listen,
      "can be reached from other machines: keep it on loopback behind a front that speaks TLS, "
      "or set access.allow_plaintext = true on a trusted network"));
  return Need(!access.tokens_file.empty() || access.allow_anonymous, "console.listen",
              console.listen,
              "can be reached from other machines: set access.tokens_file, or "
              "access.allow_anonymous = true to make everybody an admin");
}

constexpr char kAuto[] = "auto";
constexpr int kMaxPort = 65'535;

// The port of "host:port", or nothing.
std::optional<int> PortOf(absl::string_view address) {
  const std::size_t colon = address.rfind(':');
  int port = 0;
  if (colon == absl::string_view::npos || !absl::SimpleAtoi(address.substr(colon + 1), &port)) {
    return std::nullopt;
  }
  return port >= 0 && port <= kMaxPort ? std::optional(port) : std::nullopt;
}

absl::Status Refuse(absl::string_view option, absl::string_view value, absl::string_view rule) {
  return absl::InvalidArgumentError(absl::StrCat(option, " = ", value, " must be ", rule));
}

absl::Status Validate(const ConsoleConfig& console) {
  if (!console.listen.empty() && (IsUnixAddress(console.listen) || !PortOf(console.listen))) {
    return Refuse("console.listen", console.listen, "HOST:PORT or empty");
  }
  if (!std::all_of(console.hosts.begin(), console.hosts.end(), [](char c) {
        return absl::ascii_isalnum(static_cast<unsigned char>(c)) || absl::StrContains(".-:[],", c);
      })) {
    return Refuse("console.hosts", console.hosts,
                  "HOST or HOST:PORT, with commas between, or empty");
  }
  constexpr int kMaxStreams = 10'000;
  return Checker()
      .InRange("console.max_stream_count", console.max_stream_count, 1, kMaxStreams)
      .status();
}

constexpr std::size_t kMaxWord = 63;

absl::Status ValidateWord(absl::string_view option, const std::string& value,
                          absl::string_view how) {
  const bool is_word =
      !value.empty() && value.size() <= kMaxWord &&
      std::all_of(value.begin(), value.end(), [](char c) {
        return absl::ascii_isalnum(static_cast<unsigned char>(c)) || absl::StrContains("._-", c);
      });
  if (is_word) return absl::OkStatus();
  return Refuse(option, value,
                absl::StrCat("a word of 1 to ", kMaxWord,
                             " letters, digits, dots, dashes and underscores", how));
}

// Of a database that servers share.
absl::Status ValidateShared(const StoreConfig& store) {
  if (!IsPostgresqlUrl(store.url)) {
    // Whatever stands there may hold a password.
    return absl::InvalidArgumentError(
        "store.url must be postgresql://user@host:port/database for store.engine = postgresql");
  }
  PLUMESCOUT_RETURN_IF_ERROR(ValidateWord("store.node", store.node, " (--node)"));
  return ValidateWord("store.cluster", store.cluster, "");
}

absl::Status Validate(const StoreConfig& store) {
  const bool is_shared = store.engine == kPostgresqlStore;
  if (store.engine != kNoStore && store.engine != kSqliteStore && !is_shared) {
    return Refuse("store.engine", store.engine, "one of none, sqlite, postgresql");
  }
  if (is_shared) PLUMESCOUT_RETURN_IF_ERROR(ValidateShared(store));
  return Checker()
      .InRange("store.lease_s", store.lease_s, 0.5, 3600)
      .InRange("store.max_backlog_bytes", store.max_backlog_bytes, 65'536, kMaxQueuedBytes)
      .InRange("store.recovery_threads", store.recovery_threads, 1, kMaxThreads)
      .InRange("store.slow_commit_s", store.slow_commit_s, 0.001, 3600)
      .InRange("store.sleep_after_s", store.sleep_after_s, 0, 31'536'000)
      .status();
}

absl::Status Validate(const RecordConfig& record) {
  return Checker()
      .InRange("record.map_period_s", record.map_period_s, 0.1, 3600)
      .InRange("record.map_share", record.map_share, 0, 1000)
      .InRange("record.chunk_s", record.chunk_s, 0.1, 3600)
      .InRange("record.max_file_bytes", record.max_file_bytes, 1'048'576, kMaxQueuedBytes)
      .status();
}

absl::Status Validate(const ObserveConfig& observe) {
  const std::string& http = observe.http_listen;
  if (!http.empty() && http != kAuto && !PortOf(http).has_value()) {
    return Refuse("observe.http_listen", http, "HOST:PORT, auto or empty");
  }
  if (!ParseLogLevel(observe.log_level).has_value()) {
    return Refuse("observe.log_level", observe.log_level, "one of debug, info, warning, error");
  }
  if (!ParseLogFormat(observe.log_format).has_value()) {
    return Refuse("observe.log_format", observe.log_format, "one of text, json");
  }
  return Checker().InRange("observe.slow_call_s", observe.slow_call_s, 0, 3600).status();
}

}  // namespace

ServerConfig ProgramDefaults() {
  ServerConfig config;
  config.store.engine = kSqliteStore;
  return config;
}

bool IsPostgresqlUrl(absl::string_view text) {
  return absl::StartsWith(text, "postgresql://") || absl::StartsWith(text, "postgres://");
}

absl::StatusOr<std::string> StoreFolder(const StoreConfig& store) {
  if (!store.folder.empty()) return store.folder;
  const auto variable = [](const char* name) -> std::string {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  // What is not absolute is to be ignored, says the specification of these folders.
  const std::string state = variable("XDG_STATE_HOME");
  if (absl::StartsWith(state, "/")) return absl::StrCat(state, "/plumescout");
  const std::string home = variable("HOME");
  if (absl::StartsWith(home, "/")) return absl::StrCat(home, "/.local/state/plumescout");
  return absl::InvalidArgumentError(
      "store.folder must be set: neither XDG_STATE_HOME nor HOME names a folder");
}

bool IsServedLocally(const ServerConfig& config) {
  return IsLocalAddress(config.listen) && IsLocalAddress(config.console.listen);
}

std::string HttpListen(const ServerConfig& config) {
  if (config.observe.http_listen != kAuto) return config.observe.http_listen;
  const std::optional<int> port = PortOf(config.listen);
  if (!port.has_value()) return "";
  return absl::StrCat("127.0.0.1:", *port == 0 || *port == kMaxPort ? 0 : *port + 1);
}

absl::Status Validate(const ServerConfig& config) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.limits));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.planning));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.maps));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.epochs));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.connection));
  PLUMESCOUT_RETURN_IF_ERROR(CheckDefaults(config.mission, config.limits));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.access));
  PLUMESCOUT_RETURN_IF_ERROR(ValidateReach(config));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.observe));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.store));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.console));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(config.record));
  PLUMESCOUT_RETURN_IF_ERROR(ValidateReach(config.console, config.access));
  return WithField(plumescout::Validate(config.mission), "mission");
}

}  // namespace plumescout::server
