// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "client/grpc_client_options.h"
#include "client/operator_client.h"

namespace plumescout::client {

// As MakeGrpcPlannerClient, with a connection of its own.
std::unique_ptr<OperatorClient> MakeGrpcOperatorClient(const GrpcClientOptions& options);

}  // namespace plumescout::client
