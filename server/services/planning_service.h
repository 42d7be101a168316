// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/planning_service.grpc.pb.h"
#include "server/calls/service_context.h"
#include "server/calls/unary_call.h"
#include "server/missions/plan_job.h"
#include "server/missions/team_job.h"

namespace plumescout::server {

class PlanningService final : public v1::PlanningService::CallbackService {
 public:
  explicit PlanningService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerUnaryReactor* NextBestTrajectory(grpc::CallbackServerContext* context,
                                               const v1::NextBestTrajectoryRequest* request,
                                               v1::NextBestTrajectoryResponse* response) override;
  grpc::ServerWriteReactor<v1::StreamNextBestTrajectoryResponse>* StreamNextBestTrajectory(
      grpc::CallbackServerContext* context,
      const v1::StreamNextBestTrajectoryRequest* request) override;
  grpc::ServerUnaryReactor* CheckTrajectory(grpc::CallbackServerContext* context,
                                            const v1::CheckTrajectoryRequest* request,
                                            v1::CheckTrajectoryResponse* response) override;
  grpc::ServerUnaryReactor* ListFrontiers(grpc::CallbackServerContext* context,
                                          const v1::ListFrontiersRequest* request,
                                          v1::ListFrontiersResponse* response) override;
  grpc::ServerUnaryReactor* ReportProgress(grpc::CallbackServerContext* context,
                                           const v1::ReportProgressRequest* request,
                                           v1::ReportProgressResponse* response) override;
  grpc::ServerUnaryReactor* ListPlans(grpc::CallbackServerContext* context,
                                      const v1::ListPlansRequest* request,
                                      v1::ListPlansResponse* response) override;

  grpc::ServerUnaryReactor* PlanTeam(grpc::CallbackServerContext* context,
                                     const v1::PlanTeamRequest* request,
                                     v1::PlanTeamResponse* response) override;

 private:
  absl::Status Order(const v1::NextBestTrajectoryRequest& request,
                     v1::NextBestTrajectoryResponse* response,
                     const std::shared_ptr<UnaryCall>& call);
  absl::Status Search(const std::shared_ptr<MissionHost>& host, PlanOrder order,
                      v1::NextBestTrajectoryResponse* response,
                      const std::shared_ptr<UnaryCall>& call);
  absl::Status Check(const v1::CheckTrajectoryRequest& request,
                     v1::CheckTrajectoryResponse* response, const std::shared_ptr<UnaryCall>& call);
  absl::Status List(const v1::ListFrontiersRequest& request, v1::ListFrontiersResponse* response,
                    const std::shared_ptr<UnaryCall>& call);
  absl::Status Report(const v1::ReportProgressRequest& request,
                      v1::ReportProgressResponse* response, const std::shared_ptr<UnaryCall>& call);
  absl::Status ListLive(const v1::ListPlansRequest& request, v1::ListPlansResponse* response,
                        const std::shared_ptr<UnaryCall>& call);
  absl::Status OrderTeam(const v1::PlanTeamRequest& request, v1::PlanTeamResponse* response,
                         const std::shared_ptr<UnaryCall>& call);
  absl::Status SearchTeam(const std::shared_ptr<MissionHost>& host, TeamOrder order,
                          v1::PlanTeamResponse* response, const std::shared_ptr<UnaryCall>& call);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
