// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// MCAP files as they come, and records in a file that is whole but for them: what is in a file is
// read to its end, or an error says where it is damaged.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "absl/strings/match.h"
#include "formats/mcap/mcap_journal.h"
#include "formats/mcap/mcap_reader.h"
#include "tests/fuzz/memory_file.h"

namespace {

using plumescout::EncodeMcap;
using plumescout::kMcapMagic;
using plumescout::McapFields;
using plumescout::McapOp;
using plumescout::fuzz::MemoryFile;

// Files of many megabytes come out of few bytes: too slow to learn from.
constexpr std::uint64_t kMaxChunkBytes = 1 << 20;

bool HasVastChunk(absl::string_view rest) {
  plumescout::McapRecord record;
  plumescout::McapChunk chunk;
  while (plumescout::TakeMcapRecord(rest, record)) {
    if (record.op == McapOp::kChunk && plumescout::DecodeMcap(record.fields, chunk) &&
        chunk.uncompressed_bytes > kMaxChunkBytes) {
      return true;
    }
  }
  return false;
}

// The bytes as data, and as a chunk's records, of a file without CRCs and summary.
std::string FileOf(const std::string& data) {
  return absl::StrCat(kMcapMagic, McapFields().Text("").Text("fuzz").Record(McapOp::kHeader), data,
                      McapFields().Number(std::uint32_t{0}).Record(McapOp::kDataEnd),
                      McapFields()
                          .Number(std::uint64_t{0})
                          .Number(std::uint64_t{0})
                          .Number(std::uint32_t{0})
                          .Record(McapOp::kFooter),
                      kMcapMagic);
}

void Read(const std::string& bytes) {
  const MemoryFile file(bytes);
  auto reader = plumescout::McapReader::Open(file.path());
  if (reader.ok()) {
    auto message = reader->Next();
    while (message.ok() && *message) message = reader->Next();
    if (!message.ok() && !absl::StrContains(message.status().message(), " at byte ")) std::abort();
  }
  auto journal = plumescout::McapJournalReader::Open(file.path());
  if (!journal.ok()) return;
  auto event = journal->Next();
  while (event.ok() && *event) event = journal->Next();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const absl::string_view behind_magic =
      absl::string_view(bytes).substr(std::min(size, kMcapMagic.size()));
  if (HasVastChunk(bytes) || HasVastChunk(behind_magic)) return 0;
  Read(bytes);
  Read(FileOf(bytes));
  Read(FileOf(EncodeMcap(plumescout::McapChunk{0, 0, bytes.size(), 0, "", bytes})));
  return 0;
}
