// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/snapshot_service.h"

#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/names.h"
#include "server/calls/call_stop.h"
#include "server/history/mission_history.h"
#include "server/services/mission_message.h"
#include "server/streams/export_stream.h"
#include "server/streams/import_stream.h"

namespace plumescout::server {

absl::Status SnapshotService::History(const v1::GetMissionHistoryRequest& request,
                                      v1::GetMissionHistoryResponse* response,
                                      const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const HistoryPage page, HistoryPageFromProto(request));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), mission));
  PLUMESCOUT_RETURN_IF_ERROR(context_.CheckKeepsHistory());
  return AnswerInTurn(call, mission, context_.past_pool, [=, store = &context_.history->store] {
    const CallStop stop(call, host);
    auto history =
        ReadHistory(*store, KeyOf(*host), host->id(), page, [&stop] { return stop.stops(); });
    if (history.ok()) *response = *std::move(history);
    return stop.AnswerOf(history.status());
  });
}

absl::Status SnapshotService::Figures(const v1::GetMissionFiguresRequest& request,
                                      v1::GetMissionFiguresResponse* response,
                                      const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), mission));
  PLUMESCOUT_RETURN_IF_ERROR(context_.CheckKeepsHistory());
  PLUMESCOUT_ASSIGN_OR_RETURN(*response,
                              context_.history->past_figures.Ask(
                                  host, {context_.past_pool, TurnOf(call->info(), mission)}));
  call->Answer(absl::OkStatus());
  return absl::OkStatus();
}

grpc::ServerWriteReactor<v1::ExportMissionResponse>* SnapshotService::ExportMission(
    grpc::CallbackServerContext* context, const v1::ExportMissionRequest* request) {
  return ExportStream::Start(&context_, context, *request);
}

grpc::ServerReadReactor<v1::ImportMissionRequest>* SnapshotService::ImportMission(
    grpc::CallbackServerContext* context, v1::ImportMissionResponse* response) {
  return ImportStream::Start(&context_, context, response, [this](MissionHost& host) {
    return DescribeMission(host, WithoutPriorMap(host.options()), context_.registry->node());
  });
}

grpc::ServerUnaryReactor* SnapshotService::GetMissionHistory(
    grpc::CallbackServerContext* context, const v1::GetMissionHistoryRequest* request,
    v1::GetMissionHistoryResponse* response) {
  return UnaryCall::Start(context_, Rpc::kGetMissionHistory, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return History(*request, response, call);
                          });
}

grpc::ServerUnaryReactor* SnapshotService::GetMissionFigures(
    grpc::CallbackServerContext* context, const v1::GetMissionFiguresRequest* request,
    v1::GetMissionFiguresResponse* response) {
  return UnaryCall::Start(context_, Rpc::kGetMissionFigures, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Figures(*request, response, call);
                          });
}

}  // namespace plumescout::server
