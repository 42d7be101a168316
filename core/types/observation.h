// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>

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

// One numbered entry of a robot's log. Sequences run 1, 2, 3 ... without gaps.
struct Observation {
  std::int64_t sequence = 0;
  std::int64_t sample_time_ns = 0;  // robot clock, nanoseconds since the Unix epoch
  Pose2 pose;                       // of the robot in frame map, at the sample time
  std::variant<Scan, GasReading, SequenceGap> payload;

  friend bool operator==(const Observation&, const Observation&) = default;
};

// The last number that this entry of the log stands for.
inline std::int64_t LastSequence(const Observation& observation) {
  const auto* gap = std::get_if<SequenceGap>(&observation.payload);
  return gap != nullptr ? gap->last_sequence : observation.sequence;
}

}  // namespace plumescout
