// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/robot_service.grpc.pb.h"
#include "server/streams/service_context.h"

namespace plumescout::server {

class RobotService final : public v1::RobotService::CallbackService {
 public:
  explicit RobotService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerUnaryReactor* RegisterRobot(grpc::CallbackServerContext* call,
                                          const v1::RegisterRobotRequest* request,
                                          v1::RegisterRobotResponse* response) override;

  grpc::ServerUnaryReactor* RemoveRobot(grpc::CallbackServerContext* call,
                                        const v1::RemoveRobotRequest* request,
                                        v1::RemoveRobotResponse* response) override;

 private:
  absl::Status Remove(const v1::RemoveRobotRequest& request, v1::RemoveRobotResponse* response,
                      grpc::ServerUnaryReactor* reactor);
  absl::Status Register(const v1::RegisterRobotRequest& request,
                        v1::RegisterRobotResponse* response, grpc::ServerUnaryReactor* reactor);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
