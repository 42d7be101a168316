// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>
#include <grpcpp/security/server_credentials.h>
#include <grpcpp/server_builder.h>

#include <chrono>
#include <random>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

std::uint64_t RandomBits() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

std::string NewBootId() { return absl::StrCat(absl::Hex(RandomBits(), absl::kZeroPad16)); }

// Far from the tokens of an earlier start, with room to count up for ever.
std::int64_t FirstLeaseToken() {
  constexpr int kTokensPerBoot_bits = 20;
  constexpr std::uint64_t kBootMask = (std::uint64_t{1} << 40) - 1;
  return static_cast<std::int64_t>((RandomBits() & kBootMask) << kTokensPerBoot_bits) + 1;
}

RegistryOptions ToRegistryOptions(const ServerConfig& config) {
  RegistryOptions options;
  options.max_missions = config.limits.max_missions;
  options.max_total_cells = config.limits.max_total_cells;
  options.host.max_queued_observations = config.limits.max_queued_observations;
  options.host.max_waiters = config.limits.max_waiting_calls;
  options.host.publish_period = absl::Seconds(config.maps.publish_period_s);
  options.host.gas_wait = absl::Seconds(config.maps.gas_wait_s);
  options.host.lease_hold = absl::Seconds(config.connection.lease_hold_s);
  options.host.first_lease_token = FirstLeaseToken();
  return options;
}

// One is enough for audits to take their share of all missions, and few enough not to be missed.
constexpr int kAuditThreads = 1;

ServiceLimits ToServiceLimits(const ServerConfig& config) {
  ServiceLimits limits;
  limits.max_batch_observations = config.limits.max_batch_observations;
  limits.stream_window_observations = config.limits.stream_window_observations;
  limits.default_planning_budget = absl::Seconds(config.planning.default_budget_s);
  limits.max_planning_budget = absl::Seconds(config.planning.max_budget_s);
  limits.deadline_margin = absl::Seconds(config.planning.deadline_margin_s);
  return limits;
}

RegistryHooks Complete(RegistryHooks hooks, const ServerConfig& config, WorkerPool* epoch_pool,
                       WorkerPool* audit_pool) {
  hooks.epoch_pool = epoch_pool;
  hooks.audit_pool = audit_pool;
  if (config.planning.rivals) {
    hooks.make_strategy = [](const PlanningOptions& options) {
      return MakeMissionStrategy(options, Rivals::kOn);
    };
  }
  return hooks;
}

int Milliseconds(double seconds) {
  return static_cast<int>(absl::ToInt64Milliseconds(absl::Seconds(seconds)));
}

void SetArguments(const ServerConfig& config, grpc::ServerBuilder& builder) {
  const ConnectionConfig& connection = config.connection;
  builder.SetMaxReceiveMessageSize(config.limits.max_receive_bytes);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS,
                             config.limits.max_streams_per_connection);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, Milliseconds(connection.keepalive_time_s));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS,
                             Milliseconds(connection.keepalive_timeout_s));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS,
                             Milliseconds(connection.min_client_ping_interval_s));
  // Two servers must not share a port by accident.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
}

}  // namespace

Server::Server(Private, const ServerConfig& config, RegistryHooks hooks)
    : config_(config),
      epoch_pool_({"epoch", config.epochs.threads, config.epochs.max_queued}),
      audit_pool_({"audit", kAuditThreads, config.limits.max_missions}),
      registry_(ToRegistryOptions(config),
                Complete(std::move(hooks), config, &epoch_pool_, &audit_pool_)),
      planning_pool_({"planning", config.planning.threads, config.planning.max_queued}),
      map_pool_({"map", config.maps.threads, config.maps.max_queued}),
      context_{&registry_,     &planning_pool_,         &map_pool_, &streams_,
               config.mission, ToServiceLimits(config), NewBootId()},
      mission_service_(&context_),
      robot_service_(&context_),
      ingest_service_(&context_),
      planning_service_(&context_),
      map_service_(&context_) {}

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const ServerConfig& config,
                                                      RegistryHooks hooks) {
  if (config.planning.rivals && !HasRivals()) {
    return absl::InvalidArgumentError(
        "planning.rivals = true needs a server that is built with OMPL");
  }
  auto server = std::make_unique<Server>(Private(), config, std::move(hooks));
  PLUMESCOUT_RETURN_IF_ERROR(server->Listen());
  return server;
}

Server::~Server() { Drain(); }

absl::Status Server::Listen() {
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  SetArguments(config_, builder);
  if (!config_.listen.empty()) {
    builder.AddListeningPort(config_.listen, grpc::InsecureServerCredentials(), &port_);
  }
  builder.RegisterService(&mission_service_);
  builder.RegisterService(&robot_service_);
  builder.RegisterService(&ingest_service_);
  builder.RegisterService(&planning_service_);
  builder.RegisterService(&map_service_);
  grpc_server_ = builder.BuildAndStart();
  if (grpc_server_ == nullptr || (!config_.listen.empty() && port_ == 0)) {
    return absl::UnavailableError(absl::StrCat("cannot listen on ", config_.listen));
  }
  grpc_server_->GetHealthCheckService()->SetServingStatus(true);
  return absl::OkStatus();
}

std::shared_ptr<grpc::Channel> Server::InProcessChannel() {
  return grpc_server_->InProcessChannel(grpc::ChannelArguments());
}

void Server::Drain() {
  if (drained_) return;
  drained_ = true;
  if (grpc_server_ != nullptr) {
    grpc_server_->GetHealthCheckService()->SetServingStatus(false);
    streams_.EndAll(Draining());
    grpc_server_->Shutdown(std::chrono::system_clock::now() +
                           std::chrono::milliseconds(Milliseconds(config_.connection.drain_s)));
    grpc_server_->Wait();
  }
  registry_.StopAll(Draining());
}

}  // namespace plumescout::server
