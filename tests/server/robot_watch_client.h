// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "tests/server/service_clients.h"

namespace plumescout::server {

// A watcher of a robot.
class RobotWatchClient {
 public:
  RobotWatchClient(v1::RobotService::Stub& stub, const std::string& robot,
                   std::int64_t lease_token) {
    SetPatience(context_);
    v1::WatchRobotRequest request;
    request.set_robot(robot);
    request.set_lease_token(lease_token);
    stream_ = stub.WatchRobot(&context_, request);
  }

  // A notice of nothing once the stream has ended.
  v1::WatchRobotResponse Read() {
    v1::WatchRobotResponse notice;
    stream_->Read(&notice);
    return notice;
  }
  void Cancel() { context_.TryCancel(); }
  absl::Status Finish() {
    v1::WatchRobotResponse notice;
    while (stream_->Read(&notice)) {
    }
    return ToAbsl(stream_->Finish());
  }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<v1::WatchRobotResponse>> stream_;
};

}  // namespace plumescout::server
