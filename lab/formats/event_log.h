// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/types/event.h"
#include "lab/formats/event_codec.h"

namespace plumescout::lab {

// Recorded mission: a header of magic number and version of the format, then one record per event,
// the first of which, event 0, holds the mission's options:
//
//   uint32 length of the body | uint32 CRC-32C of length and body | body (see event_codec.h)
//
// Version 3 had no event 0; it is still read. A recording that ended in a crash has a torn last
// record; its reader gets every event before it.

// Writes one new recording. Not thread-safe.
class EventLogWriter {
 public:
  // Writes event 0. kAlreadyExists if there is such a file; kUnavailable if it cannot be made; else
  // as Append.
  static absl::StatusOr<EventLogWriter> Create(const std::string& path,
                                               const RecordingStart& start);

  // Hands the event to the operating system: it survives the process, not a loss of power.
  // kInvalidArgument if the body exceeds 2^28 bytes; kUnavailable if the system refuses (disk
  // full), after which the recording ends in a torn record and must not be continued.
  absl::Status Append(const Event& event);

 private:
  EventLogWriter(std::string path, std::ofstream file);
  absl::Status AppendBody(const std::string& body);

  std::string path_;
  std::ofstream file_;
};

struct EventLog {
  std::optional<RecordingStart> start;  // none: of version 3
  std::vector<Event> events;            // from number 1 up to the first damage
  // OK if the file ends with the last event; otherwise kDataLoss: where reading stopped, why, and
  // how many bytes were left.
  absl::Status end;
};

// Errors, naming the file: kNotFound; kDataLoss if it does not begin as a recording, or its
// event 0 is damaged; kInvalidArgument for another version or more than 2^32 bytes. Damage further
// on is no error: see EventLog::end.
absl::StatusOr<EventLog> ReadEventLog(const std::string& path);

}  // namespace plumescout::lab
