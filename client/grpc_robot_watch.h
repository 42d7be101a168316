// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "client/mission_routes.h"
#include "client/planner_client.h"
#include "plumescout/v1/robot_service.grpc.pb.h"

namespace plumescout::client {

// Opens a stream of notices without waiting for the server. `routes` and `stub` must
// outlive the watch.
std::unique_ptr<RobotWatch> OpenGrpcRobotWatch(MissionRoutes& routes, v1::RobotService::Stub& stub,
                                               const RobotSession& session);

}  // namespace plumescout::client
