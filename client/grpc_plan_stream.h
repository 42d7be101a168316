// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "absl/time/time.h"
#include "client/mission_routes.h"
#include "client/planner_client.h"
#include "plumescout/v1/planning_service.grpc.pb.h"

namespace plumescout::client {

// Begins to plan without waiting for the server. `routes` and `stub` must
// outlive the stream.
std::unique_ptr<PlanStream> OpenGrpcPlanStream(MissionRoutes& routes,
                                               v1::PlanningService::Stub& stub,
                                               const v1::StreamNextBestTrajectoryRequest& request,
                                               absl::Duration timeout);

}  // namespace plumescout::client
