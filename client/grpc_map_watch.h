// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "client/mission_routes.h"
#include "client/viewer_client.h"
#include "plumescout/v1/map_service.grpc.pb.h"

namespace plumescout::client {

// Opens a stream of maps without waiting for the server. `routes` and `stub` must
// outlive the watch.
std::unique_ptr<MapWatch> OpenGrpcMapWatch(MissionRoutes& routes, v1::MapService::Stub& stub,
                                           const v1::WatchMapRequest& request);

}  // namespace plumescout::client
