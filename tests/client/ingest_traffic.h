// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Observations for tests to send, and ways to wait for what becomes of them.
#pragma once

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/planner_client.h"
#include "core/types/status_macros.h"
#include "tests/client/fake_driver.h"

namespace plumescout::client {

// Long enough for a loaded machine; never waited out by a passing test.
inline constexpr absl::Duration kPatience = absl::Seconds(20);

// A reading of 1 ppm.
inline Observation GasAt(std::int64_t sequence, double x_m = 0.0) {
  return {.sequence = sequence,
          .sample_time_ns = 1'000'000'000'000 + sequence * 100'000'000,
          .pose = {.x_m = x_m},
          .payload = GasReading{.concentration_ppm = 1.0}};
}

inline std::vector<Observation> GasRange(std::int64_t first, std::int64_t last) {
  std::vector<Observation> batch;
  for (std::int64_t sequence = first; sequence <= last; ++sequence) {
    batch.push_back(GasAt(sequence));
  }
  return batch;
}

// What a robot sees that stands in the middle of a room of 10 x 10 m.
inline std::vector<Observation> LookAround(int scans) {
  FakeDriver driver(5.0);
  std::vector<Observation> batch;
  for (int i = 1; i <= scans; ++i) {
    Observation observation = GasAt(i);
    observation.pose = {.yaw_rad = 0.01 * i};
    driver.set_pose(observation.pose);
    observation.payload = *driver.TakeScan();
    batch.push_back(std::move(observation));
  }
  return batch;
}

// What the server has said of a log.
struct LogReplies {
  IngestState state;
  std::vector<ObservationRejected> refused;
};

// Reads replies until everything up to `sequence` is applied.
inline absl::StatusOr<LogReplies> ReadUntilApplied(ObservationStream& stream,
                                                   std::int64_t sequence) {
  LogReplies replies{.state = stream.opened(), .refused = {}};
  while (replies.state.applied_sequence < sequence) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const IngestReply reply, stream.Read(kPatience));
    if (const auto* refused = std::get_if<ObservationRejected>(&reply)) {
      replies.refused.push_back(*refused);
    } else {
      replies.state = std::get<IngestState>(reply);
    }
  }
  return replies;
}

inline absl::StatusOr<LogReplies> SendAll(ObservationStream& stream,
                                          const std::vector<Observation>& batch) {
  PLUMESCOUT_RETURN_IF_ERROR(stream.Write(batch));
  return ReadUntilApplied(stream, LastSequence(batch.back()));
}

// The error that ends a stream, whichever call meets it.
inline absl::Status ReadUntilError(ObservationStream& stream) {
  while (true) {
    const absl::StatusOr<IngestReply> reply = stream.Read(kPatience);
    if (!reply.ok()) return reply.status();
  }
}

}  // namespace plumescout::client
