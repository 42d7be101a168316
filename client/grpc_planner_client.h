// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "client/grpc_client_options.h"
#include "client/planner_client.h"

namespace plumescout::client {

// The planning service over HTTP/2.
std::unique_ptr<PlannerClient> MakeGrpcPlannerClient(std::shared_ptr<GrpcLink> link);
// Over a connection of its own.
std::unique_ptr<PlannerClient> MakeGrpcPlannerClient(const GrpcClientOptions& options);

}  // namespace plumescout::client
