// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "client/grpc_link.h"
#include "core/types/map_snapshot.h"
#include "plumescout/v1/map_service.grpc.pb.h"

namespace plumescout::client {

// All parts of a map, of one revision. `all_gases`: whatever the request says of species.
absl::StatusOr<MapSnapshot> FetchMap(const GrpcLink& link, v1::MapService::Stub& stub,
                                     const v1::GetMapRequest& request, bool all_gases = false);

}  // namespace plumescout::client
