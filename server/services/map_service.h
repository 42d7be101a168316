// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/map_service.grpc.pb.h"
#include "server/calls/service_context.h"
#include "server/calls/unary_call.h"
#include "server/history/past_maps.h"

namespace plumescout::server {

// Maps are sent as bytes that their readers share.
using MapServiceOfBytes =
    v1::MapService::WithRawCallbackMethod_GetMap<v1::MapService::WithRawCallbackMethod_WatchMap<
        v1::MapService::WithCallbackMethod_QueryGas<v1::MapService::Service>>>;

class MapService final : public MapServiceOfBytes {
 public:
  explicit MapService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerUnaryReactor* GetMap(grpc::CallbackServerContext* context,
                                   const grpc::ByteBuffer* request,
                                   grpc::ByteBuffer* response) override;
  grpc::ServerUnaryReactor* QueryGas(grpc::CallbackServerContext* context,
                                     const v1::QueryGasRequest* request,
                                     v1::QueryGasResponse* response) override;
  grpc::ServerWriteReactor<grpc::ByteBuffer>* WatchMap(grpc::CallbackServerContext* context,
                                                       const grpc::ByteBuffer* request) override;

 private:
  absl::Status Get(const grpc::ByteBuffer& bytes, grpc::ByteBuffer* response,
                   const std::shared_ptr<UnaryCall>& call);
  // As the map was.
  absl::Status GetPast(const std::shared_ptr<MissionHost>& host, const PastMapWish& wish,
                       grpc::ByteBuffer* response, const std::shared_ptr<UnaryCall>& call);
  absl::Status Query(const v1::QueryGasRequest& request, v1::QueryGasResponse* response,
                     const std::shared_ptr<UnaryCall>& call);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
