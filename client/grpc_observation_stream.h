// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/mission_routes.h"
#include "client/planner_client.h"
#include "plumescout/v1/ingest_service.grpc.pb.h"

namespace plumescout::client {

struct StreamTimeouts {
  absl::Duration open;
  absl::Duration write;
};

// What servers take in one request unless they are told otherwise.
inline constexpr std::int64_t kUsualRequest_bytes = std::int64_t{256} << 10;

// Opens an ingest stream and waits for the answer of the server that has the mission. `routes` and
// `stub` must outlive the stream. `max_request_bytes`: that the server takes.
absl::StatusOr<std::unique_ptr<ObservationStream>> OpenGrpcObservationStream(
    MissionRoutes& routes, v1::IngestService::Stub& stub, const RobotSession& session,
    const StreamTimeouts& timeouts, std::int64_t max_request_bytes = kUsualRequest_bytes);

}  // namespace plumescout::client
