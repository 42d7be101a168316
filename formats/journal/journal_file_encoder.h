// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/strings/string_view.h"
#include "formats/journal/event_codec.h"

namespace plumescout {

// What a journal's file begins with, and the version of the format that is written.
inline constexpr absl::string_view kJournalMagic = "\x89PSEVLOG";
inline constexpr std::uint32_t kJournalFileVersion = 5;
// No record has a longer body.
inline constexpr std::uint32_t kMaxJournalBodyBytes = std::uint32_t{1} << 28;

// The bytes of a journal's file (journal_file.h), record by record, for whoever writes or sends
// them.
class JournalFileEncoder {
 public:
  // All that stands before event 1.
  std::string Begin(const JournalStart& start);
  // The next record; `body` as EncodeEvent makes it. REQUIRES: Begin was called; body.size() is at
  // most kMaxJournalBodyBytes.
  std::string Record(absl::string_view body);

 private:
  std::uint32_t crc_ = 0;  // of all bytes so far, as the chain takes them
};

}  // namespace plumescout
