// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "client/kept_log.h"
#include "client/log_record.h"

namespace plumescout::client {

// What came of reading a segment.
struct SegmentEnd {
  std::size_t good_bytes = 0;  // up to here it was read
  // kFailedPrecondition: it is of another robot, program or version, and nothing of it was taken.
  // kOutOfRange: it breaks off. kDataLoss: it is damaged, the first time at this place.
  absl::Status status;
  std::size_t damage_bytes = 0;
  std::size_t lost_bytes = 0;             // of records that were left out
  std::vector<Renumbering> renumberings;  // of all that was read before, in order
};

// Makes a log of its segments, read in order. What cannot be read is left out: its numbers are
// missing then. Not thread-safe.
class LogReplay {
 public:
  LogReplay(MissionId mission, RobotId robot);

  SegmentEnd Read(absl::string_view segment);

  // epoch = 0: no segment has been read.
  const KeptLog& log() const { return log_; }
  KeptLog TakeLog() { return std::move(log_); }
  std::int64_t renumberings() const { return renumberings_; }

 private:
  absl::Status Take(const SegmentHead& head, SegmentEnd& end);
  absl::Status Take(Observation observation, SegmentEnd& end);
  absl::Status Take(const LogMark& mark, SegmentEnd& end);
  absl::Status Take(const NumberedRenumbering& numbered, SegmentEnd& end);

  // Takes in the record at the beginning of `rest`. Returns its size, also of a damaged one that
  // stands before a good one.
  absl::StatusOr<std::size_t> ReadRecord(absl::string_view rest, SegmentEnd& end);

  const MissionId mission_;
  const RobotId robot_;
  KeptLog log_;
  std::int64_t renumberings_ = 0;
};

}  // namespace plumescout::client
