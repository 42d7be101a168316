// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "core/types/options.h"
#include "formats/journal/journal_file.h"
#include "formats/mcap/mcap_journal.h"

namespace plumescout::lab {

// A mission on disk: the journal of its events, the first of which holds its options, as a file of
// its own (formats/journal/journal_file.h) or in one of MCAP (formats/mcap/mcap_journal.h). Of
// older recordings, the options are in FILE.options.json.

// Writes a new recording, event by event. Not thread-safe.
class Recorder {
 public:
  // Replaces a recording of this name. kInvalidArgument if the options are invalid; else as
  // WriteFile and JournalFileWriter::Create.
  static absl::StatusOr<Recorder> Create(const std::string& path, const MissionOptions& options);

  // After an error nothing more is written; see status().
  void Record(const Event& event);
  const absl::Status& status() const { return status_; }

 private:
  explicit Recorder(JournalFileWriter writer) : writer_(std::move(writer)) {}

  JournalFileWriter writer_;
  absl::Status status_;
};

// Reads a recording, event by event: one that is longer takes no more memory. Not thread-safe.
class Recording {
 public:
  // Errors, naming the file: those of ReadFile, and of the Open of JournalFileReader or
  // McapJournalReader; kInvalidArgument for options that are none.
  static absl::StatusOr<Recording> Open(const std::string& path);

  const MissionOptions& options() const { return options_; }
  // Of an older recording it has the options alone.
  const JournalStart& start() const { return start_; }
  // Of the program that wrote it; empty: of an older recording.
  const std::string& code_version() const { return start_.code_version; }

  // As of JournalFileReader or McapJournalReader.
  absl::StatusOr<std::optional<Event>> Next();
  const std::string& torn_end() const;
  double share_read() const;

 private:
  using Reader = std::variant<JournalFileReader, McapJournalReader>;

  Recording(Reader reader, MissionOptions options);
  static absl::StatusOr<Reader> OpenReader(const std::string& path);

  Reader reader_;
  MissionOptions options_;
  JournalStart start_;
};

// What its reader should know, a line each; empty if there is nothing: that another version of the
// program wrote it; once it is read, that it ends in a torn record.
std::string VersionRemark(const std::string& code_version);
std::string EndRemark(const Recording& recording);

// The mission as it was after event number `revision`; 0: after the last. Reads no further, so what
// stands behind may be damaged. kOutOfRange if there is no such event; kDataLoss if an event cannot
// be read, or cannot be applied, so that it is not that mission's. `progress` is told the share
// that is done, and may be empty. REQUIRES: no event was read yet.
absl::StatusOr<std::unique_ptr<Mission>> Replay(Recording& recording, std::int64_t revision,
                                                const std::function<void(double)>& progress = {});

}  // namespace plumescout::lab
