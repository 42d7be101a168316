// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/map_call.h"

#include "client/grpc_status.h"
#include "core/types/status_macros.h"
#include "proto/convert/map.h"

namespace plumescout::client {
namespace {

constexpr int kAttempts = 5;

absl::StatusOr<MapSnapshot> FetchParts(const GrpcLink& link, v1::MapService::Stub& stub,
                                       v1::GetMapRequest request, bool all_gases) {
  v1::GetMapResponse part;
  PLUMESCOUT_RETURN_IF_ERROR(link.Ask(stub, &v1::MapService::Stub::GetMap, request, &part));
  if (all_gases && part.status().gases_size() > 1) {  // it has the layers of the first
    for (const v1::GasStatus& gas : part.status().gases()) request.add_species(gas.species());
    PLUMESCOUT_RETURN_IF_ERROR(link.Ask(stub, &v1::MapService::Stub::GetMap, request, &part));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(MapSnapshot map, FromServer(FromProto(part)));
  while (!part.next_part_token().empty()) {
    request.set_part_token(part.next_part_token());
    PLUMESCOUT_RETURN_IF_ERROR(link.Ask(stub, &v1::MapService::Stub::GetMap, request, &part));
    if (const absl::Status added = AddTiles(part, map); !added.ok()) {
      return absl::InternalError(added.message());
    }
  }
  return map;
}

}  // namespace

absl::StatusOr<MapSnapshot> FetchMap(const GrpcLink& link, v1::MapService::Stub& stub,
                                     const v1::GetMapRequest& request, bool all_gases) {
  absl::StatusOr<MapSnapshot> map;
  // The revision of the first part may go while the others are fetched.
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    map = FetchParts(link, stub, request, all_gases);
    if (!absl::IsAborted(map.status())) break;
  }
  return map;
}

}  // namespace plumescout::client
