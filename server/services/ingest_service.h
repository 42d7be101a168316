// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/ingest_service.grpc.pb.h"
#include "server/streams/service_context.h"

namespace plumescout::server {

class IngestService final : public v1::IngestService::CallbackService {
 public:
  explicit IngestService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerBidiReactor<v1::StreamObservationsRequest, v1::StreamObservationsResponse>*
  StreamObservations(grpc::CallbackServerContext* call) override;
  grpc::ServerUnaryReactor* BatchIngestObservations(
      grpc::CallbackServerContext* call, const v1::BatchIngestObservationsRequest* request,
      v1::BatchIngestObservationsResponse* response) override;

 private:
  absl::Status BatchIngest(const v1::BatchIngestObservationsRequest& request,
                           v1::BatchIngestObservationsResponse* response,
                           grpc::ServerUnaryReactor* reactor);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
