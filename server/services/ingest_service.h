// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/ingest_service.grpc.pb.h"
#include "server/calls/service_context.h"
#include "server/calls/unary_call.h"

namespace plumescout::server {

class IngestService final : public v1::IngestService::CallbackService {
 public:
  explicit IngestService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerBidiReactor<v1::StreamObservationsRequest, v1::StreamObservationsResponse>*
  StreamObservations(grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* BatchIngestObservations(
      grpc::CallbackServerContext* context, const v1::BatchIngestObservationsRequest* request,
      v1::BatchIngestObservationsResponse* response) override;

 private:
  absl::Status BatchIngest(const v1::BatchIngestObservationsRequest& request,
                           v1::BatchIngestObservationsResponse* response,
                           const std::shared_ptr<UnaryCall>& call);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
