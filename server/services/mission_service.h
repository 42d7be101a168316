// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "plumescout/v1/mission_service.grpc.pb.h"
#include "server/calls/service_context.h"
#include "server/calls/unary_call.h"
#include "server/services/mission_update.h"
#include "server/services/paging.h"

namespace plumescout::server {

class MissionService final : public v1::MissionService::CallbackService {
 public:
  explicit MissionService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerUnaryReactor* CreateMission(grpc::CallbackServerContext* context,
                                          const v1::CreateMissionRequest* request,
                                          v1::CreateMissionResponse* response) override;
  grpc::ServerUnaryReactor* GetMission(grpc::CallbackServerContext* context,
                                       const v1::GetMissionRequest* request,
                                       v1::GetMissionResponse* response) override;
  grpc::ServerUnaryReactor* ListMissions(grpc::CallbackServerContext* context,
                                         const v1::ListMissionsRequest* request,
                                         v1::ListMissionsResponse* response) override;
  grpc::ServerUnaryReactor* DeleteMission(grpc::CallbackServerContext* context,
                                          const v1::DeleteMissionRequest* request,
                                          v1::DeleteMissionResponse* response) override;
  grpc::ServerUnaryReactor* UpdateMission(grpc::CallbackServerContext* context,
                                          const v1::UpdateMissionRequest* request,
                                          v1::UpdateMissionResponse* response) override;
  grpc::ServerUnaryReactor* PauseMission(grpc::CallbackServerContext* context,
                                         const v1::PauseMissionRequest* request,
                                         v1::PauseMissionResponse* response) override;
  grpc::ServerUnaryReactor* ResumeMission(grpc::CallbackServerContext* context,
                                          const v1::ResumeMissionRequest* request,
                                          v1::ResumeMissionResponse* response) override;
  grpc::ServerUnaryReactor* FinishMission(grpc::CallbackServerContext* context,
                                          const v1::FinishMissionRequest* request,
                                          v1::FinishMissionResponse* response) override;
  grpc::ServerUnaryReactor* ChangeKeepOutAreas(grpc::CallbackServerContext* context,
                                               const v1::ChangeKeepOutAreasRequest* request,
                                               v1::ChangeKeepOutAreasResponse* response) override;

 private:
  // What an operator does to a mission, on its writer's thread.
  using Step = absl::Status (*)(MissionHost&, MissionWriter&);

  absl::Status Create(const v1::CreateMissionRequest* request, v1::CreateMissionResponse* response,
                      const std::shared_ptr<UnaryCall>& call);
  absl::Status Make(const v1::CreateMissionRequest& request, v1::Mission& mission,
                    const std::shared_ptr<UnaryCall>& call);
  // The mission itself, which may take long.
  absl::Status MakeNow(const v1::CreateMissionRequest& request, const MissionUpdate& wishes,
                       v1::Mission& mission, const std::shared_ptr<UnaryCall>& call);
  absl::Status Get(const v1::GetMissionRequest& request, v1::Mission& mission,
                   const std::shared_ptr<UnaryCall>& call);
  absl::Status List(const v1::ListMissionsRequest& request, v1::ListMissionsResponse& response,
                    const std::shared_ptr<UnaryCall>& call);
  absl::Status Fill(const Page& page, const Principal& caller, v1::ListMissionsResponse& response);
  v1::Mission Describe(MissionHost& host) const;
  absl::Status Delete(const v1::DeleteMissionRequest& request,
                      const std::shared_ptr<UnaryCall>& call);
  // A mission that cannot be recovered.
  absl::Status Discard(const MissionId& id, const std::shared_ptr<UnaryCall>& call);
  absl::Status DiscardOfAnyTenant(const MissionId& id, const std::shared_ptr<UnaryCall>& call);
  absl::Status Update(const v1::UpdateMissionRequest& request, v1::Mission& mission,
                      const std::shared_ptr<UnaryCall>& call);
  absl::Status Change(const std::string& name, v1::Mission& mission,
                      const std::shared_ptr<UnaryCall>& call, Step step);
  absl::Status KeepOut(const v1::ChangeKeepOutAreasRequest& request,
                       v1::ChangeKeepOutAreasResponse* response,
                       const std::shared_ptr<UnaryCall>& call);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
