// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Recordings: files as they come, and events of a file whose checksums are right, replayed.

#include <cstdint>
#include <string>

#include "core/mission/mission.h"
#include "lab/formats/crc32c.h"
#include "lab/formats/event_log.h"
#include "tests/fuzz/memory_file.h"

namespace {

using plumescout::fuzz::MemoryFile;
using plumescout::lab::Crc32c;

constexpr char kHeader[] = "\x89PSEVLOG\x04\0\0\0";  // of version 4
constexpr std::size_t kHeader_bytes = sizeof(kHeader) - 1;

std::string Number(std::uint32_t value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

std::string Record(absl::string_view body) {
  const std::string length = Number(static_cast<std::uint32_t>(body.size()));
  return length + Number(Crc32c(body, Crc32c(length))) + std::string(body);
}

// Two bytes for the length of each event, then the event.
std::string File(absl::string_view bytes) {
  std::string file(kHeader, kHeader_bytes);
  file += Record(plumescout::lab::EncodeStart({"fuzz", ""}));
  while (bytes.size() > 2) {
    const std::size_t length =
        static_cast<std::uint8_t>(bytes[0]) + 256u * static_cast<std::uint8_t>(bytes[1]);
    const absl::string_view body = bytes.substr(2, length);
    file += Record(body);
    bytes.remove_prefix(2 + body.size());
  }
  return file;
}

plumescout::MissionOptions SmallOptions() {
  plumescout::MissionOptions options;
  options.occupancy.resolution_m = 0.5;
  options.occupancy.max_extent_m = 30.0;
  options.occupancy.max_cell_count = 16'384;
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const absl::string_view bytes(reinterpret_cast<const char*>(data), size);
  plumescout::lab::ReadEventLog(MemoryFile(bytes).path()).status().IgnoreError();
  const auto log = plumescout::lab::ReadEventLog(MemoryFile(File(bytes)).path());
  if (!log.ok()) return 0;
  plumescout::Mission mission(SmallOptions());
  for (const plumescout::Event& event : log->events) {
    if (!mission.Apply(event.body).ok()) break;
  }
  mission.Snapshot();
  return 0;
}
