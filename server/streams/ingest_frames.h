// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/mission/conduct/ingest.h"
#include "plumescout/v1/ingest_service.pb.h"
#include "server/missions/mission_journal.h"
#include "server/observe/mission_metrics.h"

namespace plumescout::server {

// Where the robot's log stands. `window`: observations that it may have in flight beyond what is
// applied, while the disk keeps up.
v1::IngestState ToIngestState(const LogPosition& position, const RobotId& robot,
                              const MissionJournal& journal, int window);
// STORE_ROLLED_BACK if the robot was told that more is durable than is applied; counted and logged.
absl::Status CheckNotRolledBack(const v1::OpenIngest& open, const LogPosition& position,
                                MissionMetrics& metrics);
v1::ObservationRejected ToRejected(const RefusedObservation& refused);

// Entries that cannot be read are marked so; a batch without numbers, or with too many entries, is
// refused whole. Refusals of single entries name fields below "observation".
absl::StatusOr<std::vector<IncomingObservation>> ReadBatch(const v1::ObservationBatch& batch,
                                                           int max_observations);

}  // namespace plumescout::server
