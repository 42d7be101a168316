// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "plumescout/v1/system_service.grpc.pb.h"
#include "server/base/clock.h"
#include "server/calls/service_context.h"
#include "server/calls/unary_call.h"
#include "server/config/config.h"

namespace plumescout::server {

class SystemService final : public v1::SystemService::CallbackService {
 public:
  // `drain` begins to take the process out of service and returns at once; null: whoever started
  // this server ends it in another way. `store` tells of the store; it must not block.
  SystemService(const ServiceContext* context, const ServerConfig* config,
                std::function<v1::StoreInfo()> store, std::function<void()> drain)
      : context_(*context),
        config_(*config),
        store_(std::move(store)),
        drain_(std::move(drain)),
        started_(SteadyNow()) {}

  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const v1::GetServerInfoRequest* request,
                                          v1::GetServerInfoResponse* response) override;
  grpc::ServerUnaryReactor* DrainServer(grpc::CallbackServerContext* context,
                                        const v1::DrainServerRequest* request,
                                        v1::DrainServerResponse* response) override;

 private:
  absl::Status Tell(v1::GetServerInfoResponse& response, const std::shared_ptr<UnaryCall>& call);
  absl::Status Drain(const std::shared_ptr<UnaryCall>& call);

  const ServiceContext& context_;
  const ServerConfig& config_;
  const std::function<v1::StoreInfo()> store_;
  const std::function<void()> drain_;
  const SteadyTime started_;
};

}  // namespace plumescout::server
