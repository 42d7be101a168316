// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/journal_file_encoder.h"

#include "absl/strings/str_cat.h"
#include "formats/crc32c.h"

namespace plumescout {
namespace {

absl::string_view AsBytes(const std::uint32_t& value) {
  return absl::string_view(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace

std::string JournalFileEncoder::Begin(const JournalStart& start) {
  const std::string header = absl::StrCat(kJournalMagic, AsBytes(kJournalFileVersion));
  crc_ = Crc32c(header);
  return absl::StrCat(header, Record(EncodeStart(start)));
}

std::string JournalFileEncoder::Record(absl::string_view body) {
  const auto length = static_cast<std::uint32_t>(body.size());
  const std::uint32_t length_crc = Crc32c(AsBytes(length), crc_);
  crc_ = Crc32c(body, length_crc);
  return absl::StrCat(AsBytes(length), AsBytes(length_crc), AsBytes(crc_), body);
}

}  // namespace plumescout
