// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <variant>
#include <vector>

#include "client/kept_log.h"
#include "core/types/gas_reading.h"
#include "core/types/observation.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout::client {

struct RobotLogOptions {
  std::size_t max_observations = 200'000;        // 4.6 h of 10 Hz scans and 2 Hz gas, >= 1
  std::size_t max_bytes = std::size_t{1} << 28;  // in memory, as counted by MemoryBytes()
  // Of these, for entries that are durable already: a server that is set back to an older copy of
  // its data is told them again. 18 min of 10 Hz scans of 360 beams.
  std::size_t max_durable_bytes = std::size_t{1} << 24;
};

// What one Read may return at most.
struct ReadLimits {
  std::int64_t through_sequence = 0;  // nothing beyond this number, e.g. the server's credit
  std::size_t max_observations = 0;
  std::size_t max_bytes = 0;  // at least one observation is returned, however long
};

// A robot's numbered observations, kept in memory until the server holds them durably, and the
// newest of them a while longer, so that a server that lost its state can be told everything again.
// Bounded: when full, the oldest entries go first. Those are the applied ones, if any are: applied
// is always a prefix of the log. Numbers that went are declared as a SequenceGap if the server ever
// asks for them. Not thread-safe.
class RobotLog {
 public:
  // The first entry gets the number `last_sequence` + 1: a robot that comes back to a mission goes
  // on where the server's log of it ends.
  explicit RobotLog(const RobotLogOptions& options, std::int64_t last_sequence = 0);

  // Goes on with a log that was kept; what does not fit into memory goes. REQUIRES: nothing was
  // appended.
  void Restore(KeptLog kept);

  // Numbers and stores one observation. Cost: O(1) amortised.
  std::int64_t Append(std::int64_t sample_time_ns, const Pose2& pose, ObservationPayload payload);

  // What the server says. Durable entries may be forgotten; both numbers fall when a server was
  // restarted or set back.
  void Acknowledge(std::int64_t applied_sequence, std::int64_t durable_sequence);

  // Numbers up to this one were of this log, although it does not know them: they are passed over.
  void SkipTo(std::int64_t sequence);

  // Numbers up to `sequence` are those of another log: what is not applied of this one follows
  // them, what is applied is forgotten. O(entries).
  Renumbering RebaseAfter(std::int64_t sequence);

  // Entries from `first_sequence` on, in order, beginning with a gap if that number is gone. A gap
  // stands for everything missing; it may reach beyond limits.through_sequence.
  std::vector<Observation> Read(std::int64_t first_sequence, const ReadLimits& limits) const;

  std::int64_t last_sequence() const { return last_sequence_; }
  std::int64_t applied_sequence() const { return applied_sequence_; }
  std::int64_t durable_sequence() const { return durable_sequence_; }
  // Lowest number still held; last_sequence() + 1 if the log is empty.
  std::int64_t first_held_sequence() const {
    return entries_.empty() ? last_sequence_ + 1 : entries_.front().sequence;
  }
  // Observations that went before any server had applied them: lost for good.
  std::int64_t lost_observations() const { return lost_observations_; }
  std::size_t size() const { return entries_.size(); }
  std::size_t MemoryBytes() const { return bytes_; }

 private:
  void Push(Observation entry);
  // Numbers up to `last_sequence` are missing.
  void PushGap(std::int64_t last_sequence);
  void CountDurable();
  bool Full() const;
  void DropOldest();

  RobotLogOptions options_;
  // Every number from the first one's to last_sequence_ is in exactly one of them; some are gaps.
  std::deque<Observation> entries_;
  std::size_t durable_count_ = 0;  // of the entries, from the first on
  std::size_t durable_bytes_ = 0;
  std::size_t bytes_ = 0;
  std::optional<Observation> latest_;  // where and when the robot was, without what it saw
  std::int64_t last_sequence_;
  std::int64_t applied_sequence_;
  std::int64_t durable_sequence_ = 0;
  std::int64_t lost_observations_ = 0;
};

}  // namespace plumescout::client
