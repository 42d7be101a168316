// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "core/types/options.h"
#include "lab/formats/event_log.h"

namespace plumescout::lab {

// A mission on disk: a log of its events, the first of which holds its options
// (lab/formats/event_log.h). Of older recordings, the options are in FILE.options.json.

// Writes a new recording, event by event. Not thread-safe.
class Recorder {
 public:
  // Replaces a recording of this name. kInvalidArgument if the options are invalid; else as
  // WriteFile and EventLogWriter::Create.
  static absl::StatusOr<Recorder> Create(const std::string& path, const MissionOptions& options);

  // After an error nothing more is written; see status().
  void Record(const Event& event);
  const absl::Status& status() const { return status_; }

 private:
  explicit Recorder(EventLogWriter writer) : writer_(std::move(writer)) {}

  EventLogWriter writer_;
  absl::Status status_;
};

struct Recording {
  std::string code_version;  // of the program that wrote it; empty: of an older recording
  MissionOptions options;
  std::vector<Event> events;
  absl::Status end;  // see EventLog::end
};

// Errors, naming the file: those of ReadFile and ReadEventLog; kInvalidArgument for options that
// are none.
absl::StatusOr<Recording> ReadRecording(const std::string& path);

// What its reader should know, a sentence a line: that its end is damaged, that another version of
// the program wrote it. Empty if there is nothing.
std::string Remarks(const Recording& recording);

// The mission as it was after event number `revision`; 0: after the last. kOutOfRange if there is
// no such event; kDataLoss if an event cannot be applied, so that it is not that mission's.
// `progress` is told the share that is done, and may be empty.
absl::StatusOr<std::unique_ptr<Mission>> Replay(const Recording& recording, std::int64_t revision,
                                                const std::function<void(double)>& progress = {});

}  // namespace plumescout::lab
