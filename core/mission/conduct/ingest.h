// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/status.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/observation.h"

namespace plumescout {

// Where a robot's log stands.
struct LogPosition {
  std::int64_t applied_sequence = 0;
  std::int64_t revision = 0;  // of the mission, which includes it
};

// An entry of a robot's log as it came from the robot. If it was `unreadable`, only the sequence of
// the observation is known.
struct IncomingObservation {
  Observation observation;
  absl::Status unreadable;
};

struct RefusedObservation {
  std::int64_t sequence = 0;
  absl::Status status;
};

// What became of a batch. `status` is not OK if the batch could not be applied to its end: a hole
// or a lost lease; `position` holds nevertheless.
struct IngestResult {
  absl::Status status;
  LogPosition position;
  std::vector<RefusedObservation> refused;
};

// The last number that a robot may send now. `window`: of observations beyond what is applied.
inline std::int64_t CreditSequence(const LogPosition& position, std::int64_t window) {
  return position.applied_sequence + window;
}

// CREDIT_EXCEEDED if a number of the batch is beyond the credit; then the batch is refused whole.
inline absl::Status CheckCredit(const std::vector<IncomingObservation>& batch,
                                std::int64_t credit_sequence) {
  for (const IncomingObservation& incoming : batch) {
    const std::int64_t sequence = incoming.observation.sequence;
    if (sequence > credit_sequence) return CreditExceeded(sequence, credit_sequence);
  }
  return absl::OkStatus();
}

}  // namespace plumescout
