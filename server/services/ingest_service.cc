// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/ingest_service.h"

#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/names.h"
#include "server/services/unary.h"
#include "server/streams/ingest_frames.h"
#include "server/streams/ingest_stream.h"

namespace plumescout::server {

grpc::ServerBidiReactor<v1::StreamObservationsRequest, v1::StreamObservationsResponse>*
IngestService::StreamObservations(grpc::CallbackServerContext*) {
  return IngestStream::Start(&context_);
}

absl::Status IngestService::BatchIngest(const v1::BatchIngestObservationsRequest& request,
                                        v1::BatchIngestObservationsResponse* response,
                                        grpc::ServerUnaryReactor* reactor) {
  const int window = context_.limits.max_batch_observations;
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name,
                              ParseRobotName("open.robot", request.open().robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto incoming, ReadBatch(request.batch(), window));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(name.mission));
  const std::int64_t token = request.open().lease_token();
  PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(name.robot, token));
  const int count = static_cast<int>(incoming.size());
  PLUMESCOUT_RETURN_IF_ERROR(host->Reserve(count));
  const absl::Status posted =
      host->Post([=, incoming = std::move(incoming)](MissionWriter& writer) mutable {
        const IngestResult result = writer.conduct().Ingest(name.robot, token, std::move(incoming));
        host->Release(count);
        *response->mutable_ingest_state() = ToIngestState(result.position, window);
        for (const auto& refused : result.refused)
          *response->add_rejections() = ToRejected(refused);
        Answer(reactor, result.status);
      });
  if (!posted.ok()) host->Release(count);
  return posted;
}

grpc::ServerUnaryReactor* IngestService::BatchIngestObservations(
    grpc::CallbackServerContext* call, const v1::BatchIngestObservationsRequest* request,
    v1::BatchIngestObservationsResponse* response) {
  auto* reactor = call->DefaultReactor();
  const absl::Status started = BatchIngest(*request, response, reactor);
  if (!started.ok()) Answer(reactor, started);
  return reactor;
}

}  // namespace plumescout::server
