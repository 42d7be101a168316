// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/event.h"
#include "formats/journal/event_codec.h"
#include "formats/mcap/mcap_reader.h"

namespace plumescout {

// The channel of an MCAP file that a mission can be replayed from. Its messages are the records of
// a journal as of event_codec.h, byte by byte: the start, then the events in their order, which is
// that of the file, for robots that were without a link bring events of the past.
inline constexpr absl::string_view kMcapJournalTopic = "/journal";
inline constexpr absl::string_view kMcapJournalEncoding = "plumescout.journal";

// Reads that channel and passes over all others, as JournalFileReader reads a file. Not
// thread-safe.
class McapJournalReader {
 public:
  // Reads what stands before event 1. Errors, naming the file: those of McapReader; kDataLoss if
  // there is no such channel, or its event 0 is not whole.
  static absl::StatusOr<McapJournalReader> Open(const std::string& path);

  const std::optional<JournalStart>& start() const { return start_; }  // there is one
  // As of McapReader; kDataLoss for a message that is no event, now and whenever asked again.
  absl::StatusOr<std::optional<Event>> Next();
  const std::string& torn_end() const { return reader_.torn_end(); }
  double share_read() const { return reader_.share_read(); }

 private:
  McapJournalReader(std::string path, McapReader reader);
  absl::StatusOr<std::optional<McapMessage>> NextRecord();
  absl::StatusOr<std::optional<Event>> ReadEvent();

  std::string path_;
  McapReader reader_;
  std::optional<JournalStart> start_;
  absl::Status failed_;
};

}  // namespace plumescout
