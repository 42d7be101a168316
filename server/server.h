// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/server.h>

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/config/config.h"
#include "server/services/ingest_service.h"
#include "server/services/map_service.h"
#include "server/services/mission_service.h"
#include "server/services/planning_service.h"
#include "server/services/robot_service.h"
#include "server/streams/service_context.h"

namespace plumescout::server {

// The whole service in one object: missions, pools, gRPC.
class Server {
  struct Private {
    explicit Private() = default;
  };

 public:
  Server(Private, const ServerConfig& config, RegistryHooks hooks);  // Start makes servers
  // kUnavailable if the address cannot be listened on. An empty `listen`: in-process only.
  static absl::StatusOr<std::unique_ptr<Server>> Start(const ServerConfig& config,
                                                       RegistryHooks hooks = {});
  // Drains.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const { return port_; }  // 0 if in-process only
  const std::string& boot_id() const { return context_.boot_id; }
  std::shared_ptr<grpc::Channel> InProcessChannel();

  // Turns health to NOT_SERVING, ends all streams with UNAVAILABLE and a time to retry, lets calls
  // in flight finish for `config.connection.drain_s`, then cancels them; stops the missions.
  // Returns when all is quiet. Idempotent.
  void Drain();

 private:
  absl::Status Listen();

  const ServerConfig config_;
  WorkerPool epoch_pool_;  // before the missions that use it, as is the next
  WorkerPool audit_pool_;
  MissionRegistry registry_;
  WorkerPool planning_pool_;
  WorkerPool map_pool_;
  ActiveStreams streams_;
  const ServiceContext context_;

  MissionService mission_service_;
  RobotService robot_service_;
  IngestService ingest_service_;
  PlanningService planning_service_;
  MapService map_service_;

  int port_ = 0;
  bool drained_ = false;
  std::unique_ptr<grpc::Server> grpc_server_;
};

}  // namespace plumescout::server
