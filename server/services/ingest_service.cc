// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/ingest_service.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/names.h"
#include "server/base/errors.h"
#include "server/calls/unary_call.h"
#include "server/streams/ingest_frames.h"
#include "server/streams/ingest_stream.h"

namespace plumescout::server {

grpc::ServerBidiReactor<v1::StreamObservationsRequest, v1::StreamObservationsResponse>*
IngestService::StreamObservations(grpc::CallbackServerContext* context) {
  return IngestStream::Start(&context_, context);
}

absl::Status IngestService::BatchIngest(const v1::BatchIngestObservationsRequest& request,
                                        v1::BatchIngestObservationsResponse* response,
                                        const std::shared_ptr<UnaryCall>& call) {
  const int window = context_.limits.max_batch_observations;
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name,
                              ParseRobotName("open.robot", request.open().robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto incoming, ReadBatch(request.batch(), window));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMissionOf(call->caller(), name));
  const std::int64_t token = request.open().lease_token();
  const BatchTimes times{request.batch().sent_time_ns(), host->clock().now_ns()};
  PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(name.robot, token));
  PLUMESCOUT_RETURN_IF_ERROR(host->CheckMayWrite());
  PLUMESCOUT_RETURN_IF_ERROR(
      host->rates().AdmitBatch(name.robot, RateLoadOf(incoming, request.batch().ByteSizeLong())));
  auto room = host->room().TryTake(LoadOf(incoming));
  if (room == nullptr) {
    return Overloaded(absl::StrCat("the ingest queue of mission ", host->id(), " is full"));
  }
  return host->Post(
      {[=, &open = request.open(), incoming = std::move(incoming),
        posted = SteadyNow()](MissionWriter& writer) mutable {
         call->info().stage_times->Add(Stage::kCommit, absl::FromChrono(SteadyNow() - posted));
         const auto position = writer.conduct().Position(name.robot);
         const absl::Status fits = position.ok()
                                       ? CheckNotRolledBack(open, *position, writer.metrics())
                                       : position.status();
         if (!fits.ok()) return call->Answer(fits);
         const IngestResult result =
             host->Ingest(writer, name.robot, token, std::move(incoming), times);
         writer.NoteIngest(call->info().began);
         for (const auto& refused : result.refused) {
           *response->add_rejections() = ToRejected(refused);
         }
         if (!result.status.ok()) return call->Answer(result.status);
         // Who sends a batch wants to forget it.
         host->WhenDurable([=, position = result.position](const absl::Status& durable) {
           *response->mutable_ingest_state() =
               ToIngestState(position, name.robot, host->journal(), window);
           call->Answer(durable);
         });
       },
       Refusal(call), std::move(room)});
}

grpc::ServerUnaryReactor* IngestService::BatchIngestObservations(
    grpc::CallbackServerContext* context, const v1::BatchIngestObservationsRequest* request,
    v1::BatchIngestObservationsResponse* response) {
  return UnaryCall::Start(context_, Rpc::kBatchIngestObservations, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return BatchIngest(*request, response, call);
                          });
}

}  // namespace plumescout::server
