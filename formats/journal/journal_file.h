// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/event.h"
#include "formats/journal/event_codec.h"
#include "formats/journal/journal_file_encoder.h"

namespace plumescout {

// A journal as one file, such as a recorded mission: a magic number and the version of the format,
// then a record for each event, the first of which, event 0, is the start:
//
//   uint32 length of the body | uint32 CRC of the length | uint32 CRC of the body | body
//
// The body is that of event_codec.h. Each CRC is a CRC-32C that goes on from the one before it, the
// first from that of the file's header: it vouches for all that stands before it, so no record can
// be missing, be of another file or have another place.
//
// Versions 3 and 4 are still read. Their bodies are those of event_codec_v4.h, each record has one
// CRC of its length and body alone, and version 3 has no event 0.

// Writes one new file. Not thread-safe.
class JournalFileWriter {
 public:
  // Writes event 0. kAlreadyExists if there is such a file; kUnavailable if it cannot be made; else
  // as Append.
  static absl::StatusOr<JournalFileWriter> Create(const std::string& path,
                                                  const JournalStart& start);

  // Hands the event to the operating system: it survives the process, not a loss of power.
  // kInvalidArgument if the body exceeds 2^28 bytes; kUnavailable if the system refuses (disk
  // full), after which the file ends in a torn record and must not be continued.
  absl::Status Append(const Event& event, PlanDetail detail = PlanDetail::kWhole);

 private:
  JournalFileWriter(std::string path, std::ofstream file);
  absl::Status Write(absl::string_view bytes);

  std::string path_;
  std::ofstream file_;
  JournalFileEncoder encoder_;
};

// Reads a file from its beginning to its end, and holds one record at a time. Not thread-safe.
class JournalFileReader {
 public:
  // Reads what stands before event 1. Errors, naming the file: kNotFound; kDataLoss if it is no
  // journal, or its event 0 is not whole; kInvalidArgument for another version, which is named, or
  // what is no regular file.
  static absl::StatusOr<JournalFileReader> Open(const std::string& path);

  const std::optional<JournalStart>& start() const { return start_; }  // none: of version 3

  // The next event; nothing once the file ends. A crash while a record was being written leaves the
  // front of it: that is an end too, see torn_end(). Any other damage is kDataLoss, naming file,
  // byte and reason, now and whenever asked again. (Of versions 3 and 4 a damaged length that leads
  // beyond the end of the file cannot be told from a torn record.)
  absl::StatusOr<std::optional<Event>> Next();

  // What is left of a torn record behind the last event, and where, as a sentence without a full
  // stop. Empty: nothing, or Next has not come to it.
  const std::string& torn_end() const { return torn_end_; }
  // How much of the file, as long as it was when it was opened, has been read. [0, 1]
  double share_read() const;

 private:
  JournalFileReader(std::string path, std::ifstream file, std::uint64_t size_bytes);
  absl::Status ReadHeader();
  absl::Status ReadStart();
  std::size_t Fill(std::size_t count);
  absl::StatusOr<bool> ReadBody();
  absl::StatusOr<std::optional<Event>> ReadEvent();
  absl::Status Damage(absl::string_view why) const;

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_bytes_;
  std::uint32_t version_ = 0;
  std::uint32_t crc_ = 0;
  std::uint64_t record_at_ = 0;  // where the record that is being read begins
  std::uint64_t next_at_ = 0;    // where it ends
  std::string buffer_;
  std::optional<JournalStart> start_;
  bool ended_ = false;
  absl::Status failed_;
  std::string torn_end_;
};

}  // namespace plumescout
