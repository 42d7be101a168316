// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_robot_watch.h"

#include "client/grpc_reader.h"
#include "core/types/status_macros.h"
#include "proto/convert/names.h"
#include "proto/convert/robot_notice.h"

namespace plumescout::client {
namespace {

v1::WatchRobotRequest RequestFor(const RobotSession& session) {
  v1::WatchRobotRequest request;
  request.set_robot(RobotResource({session.mission, session.robot}));
  request.set_lease_token(session.lease_token);
  return request;
}

// What is not read yet waits at the server, which keeps the newest of each kind.
class GrpcRobotWatch final : public RobotWatch {
 public:
  GrpcRobotWatch(MissionRoutes& routes, v1::RobotService::Stub& stub, const RobotSession& session)
      : reader_(routes, stub, &v1::RobotService::Stub::PrepareAsyncWatchRobot,
                RequestFor(session)) {}

  absl::StatusOr<RobotNotice> Read(absl::Duration timeout) override {
    PLUMESCOUT_ASSIGN_OR_RETURN(const v1::WatchRobotResponse message,
                                ReadEndless(reader_, timeout));
    return FromServer(FromProto(message));
  }
  void Cancel() override { reader_.Cancel(); }

 private:
  GrpcReader<v1::WatchRobotResponse> reader_;
};

}  // namespace

std::unique_ptr<RobotWatch> OpenGrpcRobotWatch(MissionRoutes& routes, v1::RobotService::Stub& stub,
                                               const RobotSession& session) {
  return std::make_unique<GrpcRobotWatch>(routes, stub, session);
}

}  // namespace plumescout::client
