// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "plumescout/v1/snapshot_service.grpc.pb.h"
#include "server/calls/service_context.h"
#include "server/calls/unary_call.h"

namespace plumescout::server {

class SnapshotService final : public v1::SnapshotService::CallbackService {
 public:
  explicit SnapshotService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerWriteReactor<v1::ExportMissionResponse>* ExportMission(
      grpc::CallbackServerContext* context, const v1::ExportMissionRequest* request) override;
  grpc::ServerReadReactor<v1::ImportMissionRequest>* ImportMission(
      grpc::CallbackServerContext* context, v1::ImportMissionResponse* response) override;
  grpc::ServerUnaryReactor* GetMissionHistory(grpc::CallbackServerContext* context,
                                              const v1::GetMissionHistoryRequest* request,
                                              v1::GetMissionHistoryResponse* response) override;
  grpc::ServerUnaryReactor* GetMissionFigures(grpc::CallbackServerContext* context,
                                              const v1::GetMissionFiguresRequest* request,
                                              v1::GetMissionFiguresResponse* response) override;

 private:
  absl::Status History(const v1::GetMissionHistoryRequest& request,
                       v1::GetMissionHistoryResponse* response,
                       const std::shared_ptr<UnaryCall>& call);
  absl::Status Figures(const v1::GetMissionFiguresRequest& request,
                       v1::GetMissionFiguresResponse* response,
                       const std::shared_ptr<UnaryCall>& call);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
