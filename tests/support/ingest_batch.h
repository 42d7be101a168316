// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/mission/conduct/ingest.h"
#include "tests/support/room_run.h"

namespace plumescout::support {

// Entries first .. last of a robot's log: gas readings at one place.
inline std::vector<IncomingObservation> GasBatch(std::int64_t first, std::int64_t last,
                                                 const Pose2& pose = {0.5, 0.5, 0.0}) {
  std::vector<IncomingObservation> batch;
  for (std::int64_t sequence = first; sequence <= last; ++sequence) {
    batch.push_back(
        {{sequence, sequence * 1'000'000, pose, GasReading{1.0, 0.0}}, absl::OkStatus()});
  }
  return batch;
}

inline std::vector<IncomingObservation> RoomRunBatch() {
  std::vector<IncomingObservation> batch;
  for (Observation& observation : RoomRun()) {
    batch.push_back({std::move(observation), absl::OkStatus()});
  }
  return batch;
}

}  // namespace plumescout::support
