// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/server.h"

#include <grpcpp/ext/channelz_service_plugin.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/impl/server_builder_option.h>
#include <grpcpp/resource_quota.h>
#include <grpcpp/server_builder.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "server/access/server_credentials.h"
#include "server/base/errors.h"
#include "server/base/knock.h"
#include "server/base/log.h"
#include "server/open_store.h"
#include "server/registry_options.h"
#include "server/store/store_nodes.h"
#include "server/store_info.h"

namespace plumescout::server {
namespace {

std::uint64_t RandomBits() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

std::string NewBootId() { return absl::StrCat(absl::Hex(RandomBits(), absl::kZeroPad16)); }

absl::StatusOr<Identity> IdentityOf(const std::shared_ptr<const Authenticator>& authenticator,
                                    const CallCredentials& credentials) {
  PLUMESCOUT_ASSIGN_OR_RETURN(Principal caller, authenticator->Identify(credentials));
  return Identity{caller, [authenticator, credentials, caller]() -> absl::Status {
                    PLUMESCOUT_ASSIGN_OR_RETURN(const auto now,
                                                authenticator->Identify(credentials));
                    if (now == caller) return absl::OkStatus();
                    return absl::UnauthenticatedError("the caller's role or tenant has changed");
                  }};
}

// Times to live are seconds at least; who is locked out is so within this.
constexpr absl::Duration kSweepPeriod = absl::Seconds(1);
// How often servers that share a store tell it for how long missions are to be kept.
constexpr absl::Duration kForgettingPeriod = absl::Seconds(30);

// What robots leave of the CPU is for it: plans, and what they wait for, go first.
constexpr bool kYields = true;
// Looks at the past take seconds, and do not keep anybody from what is now.
constexpr int kPastThreads = 1;
// Audits are rare and nobody waits for them: one thread does for all missions.
constexpr int kAuditThreads = 1;
// Snapshots are packed in milliseconds, and nobody waits for them.
constexpr int kSnapshotThreads = 1;
// Missions are created now and then; those with large known maps take a second, beside the others.
constexpr int kCreationThreads = 1;

RegistryHooks Complete(RegistryHooks hooks, const ServerConfig& config, MissionStore* store,
                       WorkerPool* epoch_pool, WorkerPool* audit_pool, WorkerPool* snapshot_pool,
                       Recorder* recorder, MissionMetrics* metrics) {
  hooks.snapshot_pool = snapshot_pool;
  hooks.recorder = recorder;
  hooks.store = store;
  hooks.epoch_pool = epoch_pool;
  hooks.audit_pool = audit_pool;
  hooks.metrics = metrics;
  if (config.planning.rivals) {
    hooks.make_strategy = [](const PlanningOptions& options) {
      return MakeMissionStrategy(options, Rivals::kOn);
    };
  }
  return hooks;
}

std::unique_ptr<Recorder> MakeRecorder(const RecordConfig& config, MissionMetrics* metrics) {
  if (config.folder.empty()) return nullptr;
  return std::make_unique<Recorder>(ToRecordingOptions(config), metrics);
}

constexpr int kHandshakeTimeout_ms = 10'000;  // who connects and says nothing is hung up on
constexpr absl::Duration kProbeTimeout = absl::Seconds(5);
constexpr absl::Duration kStorePeriod = absl::Seconds(1);
// What health calls the store; what a server says of the whole of it does not depend on the disk.
constexpr char kStoreHealth[] = "plumescout.store";

int Milliseconds(double seconds) {
  return static_cast<int>(absl::ToInt64Milliseconds(absl::Seconds(seconds)));
}

void SetArguments(const ServerConfig& config, grpc::ServerBuilder& builder) {
  const ConnectionConfig& connection = config.connection;
  builder.SetMaxReceiveMessageSize(config.limits.max_receive_bytes);
  grpc::ResourceQuota quota("connections");
  quota.Resize(static_cast<std::size_t>(config.limits.max_connection_bytes));
  builder.SetResourceQuota(quota);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS,
                             config.limits.max_streams_per_connection);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, Milliseconds(connection.keepalive_time_s));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS,
                             Milliseconds(connection.keepalive_timeout_s));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS,
                             Milliseconds(connection.min_client_ping_interval_s));
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, kHandshakeTimeout_ms);
  // Two servers must not share a port by accident.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
}

// gRPC gives its plugins to every server of a process; this takes away what a server is not to
// have.
class PluginChoice final : public grpc::ServerBuilderOption {
 public:
  explicit PluginChoice(const ObserveConfig& observe) : observe_(observe) {}

  void UpdateArguments(grpc::ChannelArguments*) override {}
  void UpdatePlugins(std::vector<std::unique_ptr<grpc::ServerBuilderPlugin>>* plugins) override {
    std::erase_if(*plugins, [&](const auto& plugin) {
      if (plugin->name() == "proto_server_reflection") return !observe_.reflection;
      return plugin->name() == "channelz_service" && !observe_.channelz;
    });
  }

 private:
  const ObserveConfig observe_;
};

void ChoosePlugins(const ObserveConfig& observe, grpc::ServerBuilder& builder) {
  builder.SetOption(std::make_unique<PluginChoice>(observe));
}

// Of builders that are made from now on.
void OfferPlugins() {
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::channelz::experimental::InitChannelzService();
}

}  // namespace

Server::Server(Private, const ServerConfig& config, RegistryHooks hooks,
               std::unique_ptr<MissionStore> store,
               std::shared_ptr<const Authenticator> authenticator, ServerEvents events)
    : config_(config),
      own_store_(std::move(store)),
      store_(hooks.store != nullptr ? hooks.store : own_store_.get()),
      store_usage_(store_ == nullptr ? nullptr : std::make_unique<StoreUsage>(store_)),
      epoch_pool_({"epoch", config.epochs.threads, config.epochs.max_queued}),
      audit_pool_({"audit", kAuditThreads, config.limits.max_missions, kYields}),
      snapshot_pool_({"snapshot", kSnapshotThreads, config.limits.max_missions, kYields}),
      recorder_(MakeRecorder(config.record, &metrics_.missions())),
      registry_(ToRegistryOptions(config, FirstLeaseToken(RandomBits())),
                Complete(std::move(hooks), config, store_, &epoch_pool_, &audit_pool_,
                         &snapshot_pool_, recorder_.get(), &metrics_.missions())),
      stray_calls_(store_ == nullptr ? nullptr : store_->nodes(),
                   [this](const StrayMission& stray) { return registry_.GiveUp(stray); }),
      history_(store_ == nullptr
                   ? nullptr
                   : std::make_unique<History>(store_, &registry_, ToImportLimits(config))),
      planning_pool_(ToPlanningPoolOptions(config.planning)),
      map_pool_({"map", config.maps.threads, config.maps.max_queued, kYields}),
      query_pool_(ToViewersPoolOptions("query", config.maps.query_threads, config.maps)),
      past_pool_(ToViewersPoolOptions("past", kPastThreads, config.maps)),
      creation_pool_({"creation", kCreationThreads, config.limits.max_missions, kYields}),
      door_(
          [authenticator = std::move(authenticator)](const grpc::CallbackServerContext& call) {
            return IdentityOf(authenticator, ReadCredentials(call));
          },
          CallRateOptions{config.limits.max_calls_per_s, config.limits.max_costly_calls_per_s}),
      context_{&door_,          &registry_,
               &planning_pool_, &map_pool_,
               &query_pool_,    &past_pool_,
               &creation_pool_, &streams_,
               config.mission,  ToServiceLimits(config),
               NewBootId(),     std::make_shared<RequestMemory>(),
               history_.get()},
      mission_service_(&context_),
      robot_service_(&context_),
      ingest_service_(&context_),
      planning_service_(&context_),
      map_service_(&context_),
      snapshot_service_(&context_),
      system_service_(
          &context_, &config_,
          [this] {
            return TellOfStore(config_.store, store_, store_usage_.get(), stray_calls_.figures());
          },
          std::move(events.drain)) {
  door_.SetOnStray([this](const OwnedMission& mission) { stray_calls_.Note(mission); });
  door_.AddObserver([this](const CallInfo& info, const CallEnd& end) {
    metrics_.calls().Note(info.rpc, end.status, end.duration);
  });
  door_.AddObserver([log = CallLog(absl::Seconds(config.observe.slow_call_s))](
                        const CallInfo& info, const CallEnd& end) { log.Note(info, end); });
}

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const ServerConfig& config,
                                                      RegistryHooks hooks, ServerEvents events) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckRivals(config.planning.rivals));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto authenticator,
                              Authenticator::Make(config.access, IsServedLocally(config)));
  if (!config.record.folder.empty()) {
    PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(config.record.folder));
  }
  auto unreachable = std::move(events.unreachable);
  std::unique_ptr<MissionStore> store;
  if (hooks.store == nullptr) {
    PLUMESCOUT_ASSIGN_OR_RETURN(store, OpenStore(config.store, config.listen));
  }
  auto server = std::make_unique<Server>(Private(), config, std::move(hooks), std::move(store),
                                         std::move(authenticator), std::move(events));
  // Of several servers another one may be at it.
  if (server->store_ != nullptr && server->store_->nodes() == nullptr) {
    PLUMESCOUT_RETURN_IF_ERROR(DropUnfinishedImports(*server->store_));
  }
  PLUMESCOUT_RETURN_IF_ERROR(server->registry_.FindStored());
  server->HeedLostLeases();
  PLUMESCOUT_RETURN_IF_ERROR(server->Listen());
  PLUMESCOUT_RETURN_IF_ERROR(server->BeginRecovery());
  server->StartProbe(std::move(unreachable));
  return server;
}

Server::~Server() {
  Drain();
  registry_.AwaitStopped(SteadyTime::max());
}

absl::Status Server::Listen() {
  OfferPlugins();
  grpc::ServerBuilder builder;
  SetArguments(config_, builder);
  ChoosePlugins(config_.observe, builder);
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto credentials, MakeServerCredentials(config_.access));
  if (!config_.listen.empty()) builder.AddListeningPort(config_.listen, credentials, &port_);
  builder.RegisterService(&mission_service_);
  builder.RegisterService(&robot_service_);
  builder.RegisterService(&ingest_service_);
  builder.RegisterService(&planning_service_);
  builder.RegisterService(&map_service_);
  builder.RegisterService(&snapshot_service_);
  builder.RegisterService(&system_service_);
  grpc_server_ = builder.BuildAndStart();
  if (grpc_server_ == nullptr || (!config_.listen.empty() && port_ == 0)) {
    return absl::UnavailableError(absl::StrCat("cannot listen on ", config_.listen));
  }
  grpc_server_->GetHealthCheckService()->SetServingStatus(true);
  sweeper_ = std::make_unique<PeriodicTask>(kSweepPeriod, [this] { Sweep(); });
  if (store_ != nullptr && store_->nodes() != nullptr) {
    forgetter_ = std::make_unique<PeriodicTask>(kForgettingPeriod, [this] { DeleteForgotten(); });
    stray_follower_ =
        std::make_unique<PeriodicTask>(kStorePeriod, [this] { stray_calls_.Follow(); });
  }
  return absl::OkStatus();
}

// Before any call can make it own a mission.
void Server::HeedLostLeases() {
  StoreNodes* const nodes = store_ == nullptr ? nullptr : store_->nodes();
  if (nodes == nullptr) return;
  nodes->SetOnLost([this](const absl::Status& why) {
    LogError("lease lost", {{"why", std::string(why.message())}});
    registry_.LoseAll(StoreTakesNothing("this node has lost its lease in it"));
  });
}

absl::Status Server::BeginRecovery() {
  if (store_ == nullptr) return absl::OkStatus();
  const int threads = config_.store.recovery_threads;
  recovery_pool_ = std::make_unique<WorkerPool>(WorkerPoolOptions{"recovery", threads, threads});
  grpc::HealthCheckServiceInterface* const health = grpc_server_->GetHealthCheckService();
  health->SetServingStatus(kStoreHealth, true);
  store_watch_ = std::make_unique<StoreWatch>(store_, kStorePeriod, [health](bool available) {
    health->SetServingStatus(kStoreHealth, available);
  });
  const auto recover = [this] {
    return recovery_pool_->Submit([this] {
      while (registry_.RecoverNext()) {
      }
    });
  };
  // If too many wait there is one among them that has not begun, and it does for all.
  registry_.SetOnCalledFor([recover] { recover().IgnoreError(); });
  for (int i = 0; i < threads; ++i) PLUMESCOUT_RETURN_IF_ERROR(recover());
  return absl::OkStatus();
}

std::string Server::NotReady() const {
  if (draining_) return "draining";
  if (store_ != nullptr && store_->nodes() != nullptr) {
    // What it recovers it takes from others, one at a time: it serves the rest.
    const absl::Status lease = store_->nodes()->status();
    return lease.ok() ? "" : absl::StrCat("no lease in the store: ", lease.message());
  }
  const int recovering = registry_.absent().recovering;
  return recovering == 0 ? "" : absl::StrCat("recovering ", recovering, " missions");
}

std::string Server::Trouble() const {
  return store_ == nullptr ? "" : std::string(store_->state().status.message());
}

void Server::Sweep() {
  for (const MissionId& id : registry_.DeleteIdle()) {
    LogInfo("mission deleted", {{"mission", id}, {"why", "idle"}});
  }
  for (const MissionId& id : registry_.SleepIdle()) {
    LogInfo("mission sleeps", {{"mission", id}});
  }
  const int ended = streams_.EndLockedOut();
  if (ended > 0) LogWarning("callers were locked out", {{"streams", absl::StrCat(ended)}});
}

void Server::DeleteForgotten() {
  const auto deleted = registry_.DeleteForgotten(kForgettingPeriod);
  if (!deleted.ok()) {
    LogWarning("store not told how long missions are kept",
               {{"why", std::string(deleted.status().message())}});
    return;
  }
  for (const MissionId& id : *deleted) {
    LogInfo("mission deleted", {{"mission", id}, {"why", "idle, and of no server"}});
  }
}

std::shared_ptr<grpc::Channel> Server::InProcessChannel() {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);  // what we send ourselves we take
  return grpc_server_->InProcessChannel(arguments);
}

absl::Status Server::Probe() {
  PLUMESCOUT_RETURN_IF_ERROR(Knock(config_.listen, port_, kProbeTimeout));
  grpc::GenericStub stub(InProcessChannel());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + absl::ToChronoSeconds(kProbeTimeout));
  const grpc::Slice whole_server;  // HealthCheckRequest{}
  const grpc::ByteBuffer request(&whole_server, 1);
  grpc::ByteBuffer response;
  std::promise<grpc::Status> answer;
  stub.UnaryCall(&context, "/grpc.health.v1.Health/Check", {}, &request, &response,
                 [&](grpc::Status status) { answer.set_value(std::move(status)); });
  const grpc::Status status = answer.get_future().get();
  if (status.ok()) return absl::OkStatus();
  return absl::UnavailableError(absl::StrCat("health: ", status.error_message()));
}

void Server::StartProbe(std::function<void()> unreachable) {
  if (config_.listen.empty() || config_.connection.self_probe_period_s == 0.0) return;
  SelfProbe::Options options;
  options.period = absl::Seconds(config_.connection.self_probe_period_s);
  probe_ = std::make_unique<SelfProbe>(
      options, [this] { return Probe(); },
      [this, unreachable = std::move(unreachable)](const absl::Status& why) {
        LogWarning("the server does not reach itself", {{"why", std::string(why.message())}});
        grpc_server_->GetHealthCheckService()->SetServingStatus(false);
        if (unreachable) unreachable();
      });
}

std::string Server::MetricsText() const {
  ServerState state;
  state.missions = &registry_;
  state.streams = &streams_;
  state.pools = {planning_pool_.load(), map_pool_.load(),      query_pool_.load(),
                 past_pool_.load(),     creation_pool_.load(), epoch_pool_.load(),
                 audit_pool_.load(),    snapshot_pool_.load()};
  state.boot_id = context_.boot_id;
  state.began = began_;
  state.max_missions = config_.limits.max_missions;
  state.memory_budget_bytes = config_.limits.memory_budget_bytes;
  state.draining = draining_;
  state.store = store_;
  state.strays = stray_calls_.figures();
  if (history_ != nullptr) state.pools.push_back(history_->imports.pool().load());
  if (recovery_pool_ != nullptr) state.pools.push_back(recovery_pool_->load());
  if (store_usage_ != nullptr) state.store_sizes = store_usage_->sizes();
  return metrics_.Text(state);
}

void Server::Drain() {
  if (drain_begun_.exchange(true)) return;
  const SteadyTime cut = After(SteadyNow(), absl::Seconds(config_.connection.drain_s));
  if (registry_.HandOverAll(cut)) {
    draining_ = true;
    // Whoever still comes is told where to go, until routers have noticed: they look every 0.2 s
    // whether a server is ready (deploy/cluster/haproxy.cfg).
    absl::SleepFor(std::min(absl::Milliseconds(400), absl::FromChrono(cut - SteadyNow())));
  }
  draining_ = true;
  probe_.reset();
  if (grpc_server_ != nullptr) EndCalls(cut);
  sweeper_.reset();
  registry_.StopAll(Draining());
  const SteadyTime limit = After(std::max(cut, SteadyNow()), kStopLimit);
  const bool stopped = registry_.AwaitStopped(limit);
  if (!registry_.AwaitStored(limit) || !stopped) {
    LogWarning("not all that was applied is durable; robots have what is not");
  }
  if (store_ != nullptr && store_->nodes() != nullptr) store_->nodes()->SetOnLost(nullptr);
  registry_.ReleaseAll();
  store_watch_.reset();
  forgetter_.reset();       // it may wait for the store; what it does no mission waits for
  stray_follower_.reset();  // as well
}

void Server::EndCalls(SteadyTime cut) {
  grpc_server_->GetHealthCheckService()->SetServingStatus(false);
  registry_.EndWaits(Draining());
  streams_.EndAll(Draining());
  // gRPC waits for the answers that queued commands owe.
  absl::Notification answered;
  std::thread cutter([&] {
    answered.WaitForNotificationWithTimeout(absl::FromChrono(cut - SteadyNow()));
    registry_.StopAll(Draining());
  });
  grpc_server_->Shutdown(std::chrono::system_clock::now() + (cut - SteadyNow()));
  grpc_server_->Wait();
  answered.Notify();
  cutter.join();
}

}  // namespace plumescout::server
