// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/mcap/mcap_journal.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout {

McapJournalReader::McapJournalReader(std::string path, McapReader reader)
    : path_(std::move(path)), reader_(std::move(reader)) {}

absl::StatusOr<McapJournalReader> McapJournalReader::Open(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(McapReader mcap, McapReader::Open(path));
  McapJournalReader reader(path, std::move(mcap));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<McapMessage> first, reader.NextRecord());
  if (!first) {
    return absl::DataLossError(absl::StrCat(path, ": no mission can be replayed from it, for it ",
                                            "has no messages of encoding ", kMcapJournalEncoding));
  }
  auto start = DecodeStart(first->data);
  if (!start.ok()) {
    return absl::DataLossError(absl::StrCat(path, ": event 0: ", start.status().message()));
  }
  reader.start_ = *std::move(start);
  return reader;
}

absl::StatusOr<std::optional<McapMessage>> McapJournalReader::NextRecord() {
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(std::optional<McapMessage> message, reader_.Next());
    if (!message ||
        reader_.channels().at(message->channel).message_encoding == kMcapJournalEncoding) {
      return message;
    }
  }
}

absl::StatusOr<std::optional<Event>> McapJournalReader::ReadEvent() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<McapMessage> record, NextRecord());
  if (!record) return std::optional<Event>();
  absl::StatusOr<Event> event = DecodeEvent(record->data);
  if (!event.ok()) {
    return absl::DataLossError(absl::StrCat(path_, ": message ", record->sequence, " of ",
                                            kMcapJournalTopic, ": ", event.status().message()));
  }
  return std::optional<Event>(*std::move(event));
}

absl::StatusOr<std::optional<Event>> McapJournalReader::Next() {
  if (!failed_.ok()) return failed_;
  absl::StatusOr<std::optional<Event>> event = ReadEvent();
  failed_ = event.status();
  return event;
}

}  // namespace plumescout
