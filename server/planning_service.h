// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/planning_service.grpc.pb.h"
#include "server/service_context.h"

namespace plumescout::server {

class PlanningService final : public v1::PlanningService::CallbackService {
 public:
  explicit PlanningService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerUnaryReactor* NextBestTrajectory(grpc::CallbackServerContext* call,
                                               const v1::NextBestTrajectoryRequest* request,
                                               v1::NextBestTrajectoryResponse* response) override;
  grpc::ServerUnaryReactor* ReportProgress(grpc::CallbackServerContext* call,
                                           const v1::ReportProgressRequest* request,
                                           v1::ReportProgressResponse* response) override;

 private:
  absl::Status Report(const v1::ReportProgressRequest& request,
                      v1::ReportProgressResponse* response, grpc::ServerUnaryReactor* reactor);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
