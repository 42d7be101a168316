// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/mission_service.grpc.pb.h"
#include "server/streams/service_context.h"

namespace plumescout::server {

class MissionService final : public v1::MissionService::CallbackService {
 public:
  explicit MissionService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerUnaryReactor* CreateMission(grpc::CallbackServerContext* call,
                                          const v1::CreateMissionRequest* request,
                                          v1::CreateMissionResponse* response) override;
  grpc::ServerUnaryReactor* GetMission(grpc::CallbackServerContext* call,
                                       const v1::GetMissionRequest* request,
                                       v1::GetMissionResponse* response) override;
  grpc::ServerUnaryReactor* ListMissions(grpc::CallbackServerContext* call,
                                         const v1::ListMissionsRequest* request,
                                         v1::ListMissionsResponse* response) override;
  grpc::ServerUnaryReactor* DeleteMission(grpc::CallbackServerContext* call,
                                          const v1::DeleteMissionRequest* request,
                                          v1::DeleteMissionResponse* response) override;

 private:
  absl::Status Create(const v1::CreateMissionRequest& request, v1::Mission& mission);
  absl::Status Get(const v1::GetMissionRequest& request, v1::Mission& mission);
  absl::Status List(const v1::ListMissionsRequest& request, v1::ListMissionsResponse& response);
  absl::Status Delete(const v1::DeleteMissionRequest& request, grpc::ServerUnaryReactor* reactor);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
