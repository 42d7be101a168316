// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/statusor.h"
#include "client/mission_routes.h"
#include "client/operator_client.h"
#include "plumescout/v1/snapshot_service.grpc.pb.h"

namespace plumescout::client {

// The calls of OperatorClient::ExportMission and ImportMission. They end with the link, not by
// time.
absl::StatusOr<ExportedMission> ReceiveMissionFile(MissionRoutes& routes,
                                                   v1::SnapshotService::Stub& stub,
                                                   const MissionId& mission,
                                                   MissionFileFormat format,
                                                   const MissionFileSink& sink);
// `max_request_bytes`: that the server takes.
absl::StatusOr<MissionId> SendMissionFile(v1::SnapshotService::Stub& stub, const MissionId& mission,
                                          const MissionFileSource& source,
                                          std::int64_t max_request_bytes);

}  // namespace plumescout::client
