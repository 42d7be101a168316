// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Recordings: records and files as they come, and events of a file whose checksums are right,
// replayed.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/mission/mission.h"
#include "formats/crc32c.h"
#include "formats/journal/event_codec_v4.h"
#include "formats/journal/journal_file.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/small_mission.h"

namespace {

using plumescout::Crc32c;
using plumescout::fuzz::MemoryFile;

constexpr char kHeader[] = "\x89PSEVLOG\x05\0\0\0";  // of version 5
constexpr std::size_t kHeader_bytes = sizeof(kHeader) - 1;

std::string Number(std::uint32_t value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

// A record with checksums that go on from `crc`.
std::string Record(absl::string_view body, std::uint32_t& crc) {
  const std::string length = Number(static_cast<std::uint32_t>(body.size()));
  const std::uint32_t length_crc = Crc32c(length, crc);
  crc = Crc32c(body, length_crc);
  return length + Number(length_crc) + Number(crc) + std::string(body);
}

// Two bytes for the length of each event, then the event.
std::string File(absl::string_view bytes) {
  std::string file(kHeader, kHeader_bytes);
  std::uint32_t crc = Crc32c(file);
  plumescout::JournalStart start;
  start.code_version = "fuzz";
  file += Record(plumescout::EncodeStart(start), crc);
  while (bytes.size() > 2) {
    const std::size_t length =
        static_cast<std::uint8_t>(bytes[0]) + 256u * static_cast<std::uint8_t>(bytes[1]);
    const absl::string_view body = bytes.substr(2, length);
    file += Record(body, crc);
    bytes.remove_prefix(2 + body.size());
  }
  return file;
}

// What decodes to an event is encoded, and decoded to the same event.
void DecodeRecord(absl::string_view bytes) {
  plumescout::DecodeEventV4(bytes).status().IgnoreError();
  const auto event = plumescout::DecodeEvent(bytes);
  if (!event.ok()) return;
  const std::string encoded = plumescout::EncodeEvent(*event);
  const auto again = plumescout::DecodeEvent(encoded);
  if (!again.ok() || plumescout::EncodeEvent(*again) != encoded) std::abort();
}

void Replay(const std::string& path) {
  auto reader = plumescout::JournalFileReader::Open(path);
  if (!reader.ok()) return;
  plumescout::Mission mission(plumescout::fuzz::SmallMission());
  bool applied = true;
  for (auto event = reader->Next(); event.ok() && *event; event = reader->Next()) {
    applied = applied && mission.Apply((*event)->body).ok();
  }
  mission.Snapshot();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const absl::string_view bytes(reinterpret_cast<const char*>(data), size);
  DecodeRecord(bytes);
  Replay(MemoryFile(bytes).path());
  Replay(MemoryFile(File(bytes)).path());
  return 0;
}
