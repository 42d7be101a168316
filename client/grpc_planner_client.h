// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "client/grpc_client_options.h"
#include "client/planner_client.h"

namespace plumescout::client {

// The planning service over one HTTP/2 connection, opened at the first call and again whenever it
// breaks.
std::unique_ptr<PlannerClient> MakeGrpcPlannerClient(const GrpcClientOptions& options);

}  // namespace plumescout::client
