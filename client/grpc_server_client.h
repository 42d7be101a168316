// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "client/grpc_client_options.h"
#include "client/server_client.h"

namespace plumescout::client {

// The server itself, over HTTP/2.
std::unique_ptr<ServerClient> MakeGrpcServerClient(std::shared_ptr<GrpcLink> link);
// Over a connection of its own.
std::unique_ptr<ServerClient> MakeGrpcServerClient(const GrpcClientOptions& options);

}  // namespace plumescout::client
