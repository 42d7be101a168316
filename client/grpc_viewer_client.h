// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "client/grpc_client_options.h"
#include "client/viewer_client.h"

namespace plumescout::client {

// What can be seen, over HTTP/2.
std::unique_ptr<ViewerClient> MakeGrpcViewerClient(std::shared_ptr<GrpcLink> link);
// Over a connection of its own.
std::unique_ptr<ViewerClient> MakeGrpcViewerClient(const GrpcClientOptions& options);

}  // namespace plumescout::client
