// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "client/grpc_client_options.h"
#include "client/operator_client.h"

namespace plumescout::client {

// What operators do, over HTTP/2.
std::unique_ptr<OperatorClient> MakeGrpcOperatorClient(std::shared_ptr<GrpcLink> link);
// Over a connection of its own.
std::unique_ptr<OperatorClient> MakeGrpcOperatorClient(const GrpcClientOptions& options);

}  // namespace plumescout::client
