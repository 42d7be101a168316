// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/robot_service.grpc.pb.h"
#include "server/calls/service_context.h"
#include "server/calls/unary_call.h"

namespace plumescout::server {

class RobotService final : public v1::RobotService::CallbackService {
 public:
  explicit RobotService(const ServiceContext* context) : context_(*context) {}

  grpc::ServerUnaryReactor* RegisterRobot(grpc::CallbackServerContext* context,
                                          const v1::RegisterRobotRequest* request,
                                          v1::RegisterRobotResponse* response) override;

  grpc::ServerUnaryReactor* RemoveRobot(grpc::CallbackServerContext* context,
                                        const v1::RemoveRobotRequest* request,
                                        v1::RemoveRobotResponse* response) override;
  grpc::ServerUnaryReactor* GetRobot(grpc::CallbackServerContext* context,
                                     const v1::GetRobotRequest* request,
                                     v1::GetRobotResponse* response) override;
  grpc::ServerUnaryReactor* ListRobots(grpc::CallbackServerContext* context,
                                       const v1::ListRobotsRequest* request,
                                       v1::ListRobotsResponse* response) override;
  grpc::ServerUnaryReactor* ReleaseLease(grpc::CallbackServerContext* context,
                                         const v1::ReleaseLeaseRequest* request,
                                         v1::ReleaseLeaseResponse* response) override;
  grpc::ServerUnaryReactor* OrderHome(grpc::CallbackServerContext* context,
                                      const v1::OrderHomeRequest* request,
                                      v1::OrderHomeResponse* response) override;
  grpc::ServerWriteReactor<v1::WatchRobotResponse>* WatchRobot(
      grpc::CallbackServerContext* context, const v1::WatchRobotRequest* request) override;

 private:
  absl::Status Order(const v1::OrderHomeRequest& request, v1::OrderHomeResponse* response,
                     const std::shared_ptr<UnaryCall>& call);
  absl::Status Remove(const v1::RemoveRobotRequest& request, v1::RemoveRobotResponse* response,
                      const std::shared_ptr<UnaryCall>& call);
  absl::Status Register(const v1::RegisterRobotRequest& request,
                        v1::RegisterRobotResponse* response,
                        const std::shared_ptr<UnaryCall>& call);
  absl::Status Join(const std::shared_ptr<MissionHost>& host, const Registration& wish,
                    v1::RegisterRobotResponse* response, const std::shared_ptr<UnaryCall>& call);
  absl::Status Get(const v1::GetRobotRequest& request, v1::GetRobotResponse* response,
                   const std::shared_ptr<UnaryCall>& call);
  absl::Status List(const v1::ListRobotsRequest& request, v1::ListRobotsResponse* response,
                    const std::shared_ptr<UnaryCall>& call);
  absl::Status Release(const v1::ReleaseLeaseRequest& request,
                       const std::shared_ptr<UnaryCall>& call);

  const ServiceContext& context_;
};

}  // namespace plumescout::server
