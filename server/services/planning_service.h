// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/planning_service.grpc.pb.h"
#include "server/base/clock.h"
#include "server/streams/service_context.h"

namespace plumescout::server {

class PlanningService final : public v1::PlanningService::CallbackService {
 public:
  explicit PlanningService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerUnaryReactor* NextBestTrajectory(grpc::CallbackServerContext* call,
                                               const v1::NextBestTrajectoryRequest* request,
                                               v1::NextBestTrajectoryResponse* response) override;
  grpc::ServerWriteReactor<v1::StreamNextBestTrajectoryResponse>* StreamNextBestTrajectory(
      grpc::CallbackServerContext* call,
      const v1::StreamNextBestTrajectoryRequest* request) override;
  grpc::ServerUnaryReactor* CheckTrajectory(grpc::CallbackServerContext* call,
                                            const v1::CheckTrajectoryRequest* request,
                                            v1::CheckTrajectoryResponse* response) override;
  grpc::ServerUnaryReactor* ListFrontiers(grpc::CallbackServerContext* call,
                                          const v1::ListFrontiersRequest* request,
                                          v1::ListFrontiersResponse* response) override;
  grpc::ServerUnaryReactor* ReportProgress(grpc::CallbackServerContext* call,
                                           const v1::ReportProgressRequest* request,
                                           v1::ReportProgressResponse* response) override;

 private:
  absl::Status Check(const v1::CheckTrajectoryRequest& request, SteadyTime deadline,
                     v1::CheckTrajectoryResponse* response, grpc::ServerUnaryReactor* reactor);
  absl::Status List(const v1::ListFrontiersRequest& request, v1::ListFrontiersResponse* response,
                    grpc::ServerUnaryReactor* reactor);
  absl::Status Report(const v1::ReportProgressRequest& request,
                      v1::ReportProgressResponse* response, grpc::ServerUnaryReactor* reactor);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
