// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/server.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/access/authenticator.h"
#include "server/base/periodic_task.h"
#include "server/calls/call_log.h"
#include "server/calls/service_context.h"
#include "server/config/config.h"
#include "server/history/history.h"
#include "server/missions/recorder.h"
#include "server/missions/stray_calls.h"
#include "server/self_probe.h"
#include "server/server_metrics.h"
#include "server/services/ingest_service.h"
#include "server/services/map_service.h"
#include "server/services/mission_service.h"
#include "server/services/planning_service.h"
#include "server/services/robot_service.h"
#include "server/services/snapshot_service.h"
#include "server/services/system_service.h"
#include "server/store/mission_store.h"
#include "server/store_usage.h"
#include "server/store_watch.h"

namespace plumescout::server {

// What a server tells whoever runs it, from any thread. None may block, or drain the server itself.
struct ServerEvents {
  // A caller wants it drained; see SystemService. Null: callers cannot.
  std::function<void()> drain = nullptr;
  // Nobody can connect to it any more, and its health is NOT_SERVING. Called once at most.
  std::function<void()> unreachable = nullptr;
};

// The whole service in one object: missions, pools, gRPC.
class Server {
  struct Private {
    explicit Private() = default;
  };

 public:
  Server(Private, const ServerConfig& config, RegistryHooks hooks,
         std::unique_ptr<MissionStore> store, std::shared_ptr<const Authenticator> authenticator,
         ServerEvents events);  // Start makes
  // Missions of the store are there from then on, and recovered one after the other. kUnavailable
  // if the address cannot be listened on; see OpenStore for the store, which `hooks` may give
  // instead. An empty `listen`: in-process only.
  static absl::StatusOr<std::unique_ptr<Server>> Start(const ServerConfig& config,
                                                       RegistryHooks hooks = {},
                                                       ServerEvents events = {});
  // Drains.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const { return port_; }  // 0 if in-process only
  const std::string& boot_id() const { return context_.boot_id; }
  bool draining() const { return draining_; }
  // Why the server is not ready for all calls: it drains, or has missions to recover. Empty: it is.
  std::string NotReady() const;
  // What its operator should know although it is ready: the store takes no data. Empty: nothing.
  std::string Trouble() const;
  // All metrics in Prometheus' text format. From any thread.
  std::string MetricsText() const;
  std::shared_ptr<grpc::Channel> InProcessChannel();

  // Turns health to NOT_SERVING; ends all streams, and all calls that wait for a belief or a plan,
  // with UNAVAILABLE and a time to retry; lets other calls in flight finish for
  // `config.connection.drain_s`, then cancels them, and stops the missions. Returns when every call
  // has its answer and every mission has stopped, but does not wait for missions longer than
  // kStopLimit after that time. Before it returns, events of the missions are durable, unless that
  // takes as long. Idempotent.
  void Drain();
  static constexpr absl::Duration kStopLimit = absl::Milliseconds(800);

 private:
  absl::Status Listen();
  // Deletes missions that nobody has called for during their idle time to live, and ends streams
  // whose callers would not be let in any more.
  void Sweep();
  // Of a store that several servers share: see MissionRegistry::DeleteForgotten.
  void DeleteForgotten();
  // Returns when every call has its answer; drops what the missions have queued at `cut`.
  void EndCalls(SteadyTime cut);
  // Whether the server takes connections and answers calls.
  absl::Status Probe();
  void StartProbe(std::function<void()> unreachable);
  void HeedLostLeases();
  absl::Status BeginRecovery();

  const ServerConfig config_;
  const SteadyTime began_ = SteadyNow();
  ServerMetrics metrics_;                          // before all that counts
  const std::unique_ptr<MissionStore> own_store_;  // before what it keeps; null: none, or another's
  MissionStore* const store_;                      // null: none
  const std::unique_ptr<StoreUsage> store_usage_;  // null without a store
  WorkerPool epoch_pool_;  // before the missions that use it, as is the next
  WorkerPool audit_pool_;
  WorkerPool snapshot_pool_;
  const std::unique_ptr<Recorder> recorder_;  // as well; null: missions are not recorded
  MissionRegistry registry_;
  StrayCalls stray_calls_;
  const std::unique_ptr<History> history_;  // before the pools that use it; null without a store
  FairPool planning_pool_;
  WorkerPool map_pool_;
  FairPool query_pool_;
  FairPool past_pool_;
  WorkerPool creation_pool_;
  ActiveStreams streams_;
  Door door_;
  const ServiceContext context_;

  MissionService mission_service_;
  RobotService robot_service_;
  IngestService ingest_service_;
  PlanningService planning_service_;
  MapService map_service_;
  SnapshotService snapshot_service_;
  SystemService system_service_;
  std::unique_ptr<WorkerPool> recovery_pool_;  // null without a store, as is the next
  std::unique_ptr<StoreWatch> store_watch_;    // while the server serves
  std::unique_ptr<PeriodicTask> sweeper_;      // as well
  std::unique_ptr<PeriodicTask> forgetter_;  // null unless servers share the store, as is the next
  std::unique_ptr<PeriodicTask> stray_follower_;

  int port_ = 0;
  std::atomic<bool> drain_begun_ = false;
  std::atomic<bool> draining_ = false;
  std::unique_ptr<grpc::Server> grpc_server_;
  std::unique_ptr<SelfProbe> probe_;  // null: none
};

}  // namespace plumescout::server
