// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "client/kept_log.h"
#include "core/types/ids.h"
#include "core/types/observation.h"

namespace plumescout::client {

// What a robot's log on disk is made of: segments, each a preamble and then records, a head first.
//
// Preamble: eight bytes that tell the kind of file, and its version. Record: length and CRC-32C of
// its body (of the length too), then the body, of which the first byte tells its kind. All numbers
// are little-endian.

// Whose log this is, and how it stood when the segment began.
struct SegmentHead {
  MissionId mission;
  RobotId robot;
  std::int64_t epoch = 0;
  std::int64_t last_sequence = 0;
  std::int64_t applied_sequence = 0;
  std::int64_t durable_sequence = 0;
  std::int64_t renumberings = 0;  // how often the log was renumbered before

  friend bool operator==(const SegmentHead&, const SegmentHead&) = default;
};

// What the server had said by then.
struct LogMark {
  std::int64_t applied_sequence = 0;
  std::int64_t durable_sequence = 0;

  friend bool operator==(const LogMark&, const LogMark&) = default;
};

// A renumbering of all that stands before it. Written again, its number tells that it is known.
struct NumberedRenumbering {
  std::int64_t number = 0;  // from 1
  Renumbering renumbering;

  friend bool operator==(const NumberedRenumbering&, const NumberedRenumbering&) = default;
};

using LogRecord = std::variant<SegmentHead, Observation, LogMark, NumberedRenumbering>;

inline constexpr std::uint32_t kSegmentVersion = 1;

// The preamble of a segment.
std::string SegmentPreamble();
// The preamble's length. kFailedPrecondition if `bytes` are of another program, or of a version
// that this one does not know (which is named); kOutOfRange if they end too early.
absl::StatusOr<std::size_t> CheckPreamble(absl::string_view bytes);

// Observations travel as on the wire: ranges in steps of 5 mm. One that no server takes comes back
// as a gap of its number.
std::string EncodeRecord(const LogRecord& record);

struct DecodedRecord {
  LogRecord record;
  std::size_t size_bytes = 0;
};

// The record at the beginning of `bytes`. kOutOfRange if they end before it does, kDataLoss if its
// checksum is wrong or it makes no sense.
absl::StatusOr<DecodedRecord> DecodeRecord(absl::string_view bytes);

// Where the record at the beginning of `bytes` ends if its length, which nothing vouches for, is
// right; 0 if it cannot be.
std::size_t RecordSize_bytes(absl::string_view bytes);

}  // namespace plumescout::client
