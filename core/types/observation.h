// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "core/types/gas_reading.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout {

// Numbers that the robot had to drop: first_sequence .. last_sequence will never arrive. The
// observation that declares the gap carries the number first_sequence and stands for all of them.
struct SequenceGap {
  std::int64_t first_sequence = 0;
  std::int64_t last_sequence = 0;

  friend bool operator==(const SequenceGap&, const SequenceGap&) = default;
};

// Where the robot was at a sample time of its past, in its own frame, as it knows now.
struct PoseAnchor {
  std::int64_t sample_time_ns = 0;  // robot clock
  Pose2 pose;

  friend bool operator==(const PoseAnchor&, const PoseAnchor&) = default;
};

// After a loop closure or a relocalisation: poses that the robot gave before were wrong. Between
// anchors the right ones are interpolated, beyond the first and the last the way is moved rigidly.
// The entry's own pose and those after it are right already.
struct PoseCorrection {
  std::vector<PoseAnchor> anchors;  // at least one, in order of time

  friend bool operator==(const PoseCorrection&, const PoseCorrection&) = default;
};

// What a robot tells of itself.
struct RobotStatus {
  double battery_share = 0.0;  // of a full battery

  friend bool operator==(const RobotStatus&, const RobotStatus&) = default;
};

// Recorded observations know their kind by its place in this list: new kinds come last.
using ObservationPayload = std::variant<Scan, GasReading, SequenceGap, PoseCorrection, RobotStatus>;

// One numbered entry of a robot's log. Sequences run 1, 2, 3 ... without gaps.
struct Observation {
  std::int64_t sequence = 0;
  std::int64_t sample_time_ns = 0;  // robot clock, nanoseconds since the Unix epoch
  Pose2 pose;                       // of the robot in its own frame, at the sample time
  ObservationPayload payload;

  friend bool operator==(const Observation&, const Observation&) = default;
};

// The last number that this entry of the log stands for.
inline std::int64_t LastSequence(const Observation& observation) {
  const auto* gap = std::get_if<SequenceGap>(&observation.payload);
  return gap != nullptr ? gap->last_sequence : observation.sequence;
}

}  // namespace plumescout
