// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "formats/file_io.h"
#include "formats/mcap/mcap_encoder.h"
#include "formats/mcap/mcap_reader.h"
#include "tests/support/temp_folder.h"

namespace plumescout {

// Two channels, one with a schema, of small messages in chunks of some 200 bytes.
struct SmallMcap {
  std::vector<McapMessage> messages;
  std::string bytes;
};

inline SmallMcap MakeSmallMcap(McapCompression compression, int count = 20) {
  constexpr std::size_t kChunkBytes = 200;
  SmallMcap file;
  McapEncoder encoder("a test", compression, kChunkBytes);
  const std::uint16_t typed =
      encoder.AddChannel("/typed", "protobuf", encoder.AddSchema("a.B", "protobuf", "schema"));
  const std::uint16_t plain = encoder.AddChannel("/plain", "text", 0);
  for (int i = 0; i < count; ++i) {
    const auto number = static_cast<std::uint32_t>(i);
    file.messages.push_back({i % 3 == 0 ? plain : typed, number, 1000u + 10u * number,
                             995u + 10u * number, std::string(number % 40, 'x')});
    EXPECT_TRUE(encoder.Add(file.messages.back()).ok());
    file.bytes += encoder.Take();
  }
  EXPECT_TRUE(encoder.Finish().ok());
  file.bytes += encoder.Take();
  return file;
}

// All that a reader says until it ends.
struct McapReading {
  absl::Status open;
  std::vector<McapMessage> messages;
  absl::Status end;
  std::string torn_end;
};

inline McapReading ReadMcap(const std::string& bytes) {
  static const TempFolder folder;  // one for all: making them takes longer than reading
  const std::string path = folder.File("f.mcap");
  McapReading reading;
  std::ofstream(path, std::ios::binary) << bytes;
  auto reader = McapReader::Open(path);
  reading.open = reader.status();
  if (!reader.ok()) return reading;
  auto message = reader->Next();
  for (; message.ok() && *message; message = reader->Next()) {
    reading.messages.push_back(**message);
  }
  reading.end = message.status();
  reading.torn_end = reader->torn_end();
  EXPECT_EQ(reader->Next().status(), reading.end);  // and says so again
  return reading;
}

// Where the record of this kind begins that comes up as number `nth` in the file, from 0.
inline std::size_t FindMcapRecord(const std::string& bytes, McapOp op, int nth = 0) {
  absl::string_view rest = absl::string_view(bytes).substr(kMcapMagic.size());
  McapRecord record;
  for (std::size_t at = kMcapMagic.size(); TakeMcapRecord(rest, record);
       at = bytes.size() - rest.size()) {
    if (record.op == op && nth-- == 0) return at;
  }
  ADD_FAILURE() << "no such record";
  return 0;
}

}  // namespace plumescout
