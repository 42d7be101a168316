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

// A mission on disk: FILE is the log of its events (lab/formats/event_log.h), FILE.options.json its
// options, as JSON of plumescout.v1.MissionOptions.

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
  MissionOptions options;
  std::vector<Event> events;
  absl::Status end;  // see EventLog::end
};

// Errors, naming the file: those of ReadFile and ReadEventLog; kInvalidArgument for options that
// are none.
absl::StatusOr<Recording> ReadRecording(const std::string& path);

// The mission as it was after event number `revision`; 0: after the last. kOutOfRange if there is
// no such event; kDataLoss if an event cannot be applied, so that it is not that mission's.
// `progress` is told the share that is done, and may be empty.
absl::StatusOr<std::unique_ptr<Mission>> Replay(const Recording& recording, std::int64_t revision,
                                                const std::function<void(double)>& progress = {});

}  // namespace plumescout::lab
