// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/map_service.grpc.pb.h"
#include "server/streams/service_context.h"

namespace plumescout::server {

class MapService final : public v1::MapService::CallbackService {
 public:
  explicit MapService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerUnaryReactor* GetMap(grpc::CallbackServerContext* call,
                                   const v1::GetMapRequest* request,
                                   v1::GetMapResponse* response) override;
  grpc::ServerUnaryReactor* QueryGas(grpc::CallbackServerContext* call,
                                     const v1::QueryGasRequest* request,
                                     v1::QueryGasResponse* response) override;
  grpc::ServerWriteReactor<v1::WatchMapResponse>* WatchMap(
      grpc::CallbackServerContext* call, const v1::WatchMapRequest* request) override;

 private:
  absl::Status Get(const v1::GetMapRequest& request, v1::GetMapResponse* response,
                   grpc::ServerUnaryReactor* reactor);
  absl::Status Query(const v1::QueryGasRequest& request, v1::QueryGasResponse* response,
                     grpc::ServerUnaryReactor* reactor);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
