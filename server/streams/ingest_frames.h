// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/mission/conduct/ingest.h"
#include "plumescout/v1/ingest_service.pb.h"

namespace plumescout::server {

// `window`: observations that the robot may have in flight beyond what is applied.
v1::IngestState ToIngestState(const LogPosition& position, int window);
v1::ObservationRejected ToRejected(const RefusedObservation& refused);

// Entries that cannot be read are marked so; a batch without numbers, or with too many entries, is
// refused whole. Refusals of single entries name fields below "observation".
absl::StatusOr<std::vector<IncomingObservation>> ReadBatch(const v1::ObservationBatch& batch,
                                                           int max_observations);

}  // namespace plumescout::server
