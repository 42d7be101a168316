// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/mcap/mcap_encoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "formats/little_endian.h"
#include "tests/formats/mcap/mcap_files.h"

namespace plumescout {
namespace mcap_encoder_test {

using testing::ElementsAre;
using testing::Pair;

// The records between the first and the last bytes of a file, with where they stand.
struct Placed {
  std::size_t at = 0;
  McapRecord record;
};
std::vector<Placed> RecordsOf(const std::string& bytes) {
  absl::string_view rest =
      absl::string_view(bytes).substr(kMcapMagic.size(), bytes.size() - 2 * kMcapMagic.size());
  std::vector<Placed> records;
  Placed placed;
  while (true) {
    placed.at = bytes.size() - kMcapMagic.size() - rest.size();
    if (!TakeMcapRecord(rest, placed.record)) break;
    records.push_back(placed);
  }
  EXPECT_TRUE(rest.empty());
  return records;
}

TEST(McapEncoderTest, AFileWithoutMessagesIsWhole) {
  McapEncoder encoder("nobody");
  ASSERT_TRUE(encoder.Finish().ok());
  const std::string bytes = encoder.Take();
  const McapReading reading = ReadMcap(bytes);
  EXPECT_TRUE(reading.open.ok()) << reading.open;
  EXPECT_TRUE(reading.end.ok()) << reading.end;
  EXPECT_EQ(reading.torn_end, "");
  std::vector<McapOp> ops;
  for (const Placed& placed : RecordsOf(bytes)) ops.push_back(placed.record.op);
  EXPECT_THAT(ops, ElementsAre(McapOp::kHeader, McapOp::kDataEnd, McapOp::kStatistics,
                               McapOp::kSummaryOffset, McapOp::kFooter));
}

TEST(McapEncoderTest, TheSameCallsGiveTheSameBytes) {
  EXPECT_EQ(MakeSmallMcap(McapCompression::kZstd).bytes,
            MakeSmallMcap(McapCompression::kZstd).bytes);
}

TEST(McapEncoderTest, ChunksCloseWhenTheyAreFull) {
  McapEncoder encoder("nobody", McapCompression::kNone, 100);
  const std::uint16_t channel = encoder.AddChannel("/a", "text", 0);
  encoder.Take();
  // 9 + 22 bytes and those of the message; the channel has 9 + 18.
  ASSERT_TRUE(encoder.Add({channel, 1, 1, 1, std::string(20, 'x')}).ok());
  EXPECT_EQ(encoder.ready_bytes(), 0u);
  ASSERT_TRUE(encoder.Add({channel, 2, 2, 2, std::string(20, 'x')}).ok());
  EXPECT_GT(encoder.ready_bytes(), 100u);
}

// Every place and number that the summary tells is that of the file.
TEST(McapEncoderTest, IndexesLeadToEachMessage) {
  const SmallMcap file = MakeSmallMcap(McapCompression::kNone);
  const std::vector<Placed> records = RecordsOf(file.bytes);
  std::map<std::uint64_t, std::uint32_t> found;  // sequence by log time
  int chunks = 0;
  for (const Placed& placed : records) {
    if (placed.record.op != McapOp::kChunkIndex) continue;
    ++chunks;
    McapChunkIndex index;
    ASSERT_TRUE(DecodeMcap(placed.record.fields, index));
    absl::string_view rest = absl::string_view(file.bytes).substr(index.chunk_at);
    McapRecord record;
    ASSERT_TRUE(TakeMcapRecord(rest, record));
    EXPECT_EQ(record.op, McapOp::kChunk);
    EXPECT_EQ(index.chunk_bytes, record.fields.size() + kMcapHeadBytes);
    McapChunk chunk;
    ASSERT_TRUE(DecodeMcap(record.fields, chunk));
    for (const auto& [channel, at] : index.indexes_at) {
      rest = absl::string_view(file.bytes).substr(at);
      ASSERT_TRUE(TakeMcapRecord(rest, record));
      EXPECT_EQ(record.op, McapOp::kMessageIndex);
      EXPECT_EQ(LoadLittleEndian<std::uint16_t>(record.fields.data()), channel);
      const auto bytes = LoadLittleEndian<std::uint32_t>(record.fields.data() + 2);
      ASSERT_EQ(record.fields.size(), 6u + bytes);
      for (std::size_t i = 6; i < record.fields.size(); i += 16) {
        const auto time_ns = LoadLittleEndian<std::uint64_t>(record.fields.data() + i);
        const auto offset = LoadLittleEndian<std::uint64_t>(record.fields.data() + i + 8);
        absl::string_view inside = chunk.records.substr(offset);
        McapRecord inner;
        McapMessage message;
        ASSERT_TRUE(TakeMcapRecord(inside, inner) && inner.op == McapOp::kMessage);
        ASSERT_TRUE(DecodeMcap(inner.fields, message));
        EXPECT_EQ(message.log_time_ns, time_ns);
        EXPECT_EQ(message.channel, channel);
        EXPECT_GE(time_ns, index.start_time_ns);
        EXPECT_LE(time_ns, index.end_time_ns);
        found[time_ns] = message.sequence;
      }
    }
  }
  EXPECT_GT(chunks, 2);
  ASSERT_EQ(found.size(), file.messages.size());
  for (const McapMessage& message : file.messages) {
    EXPECT_EQ(found.at(message.log_time_ns), message.sequence);
  }
}

TEST(McapEncoderTest, StatisticsAndOffsetsTellWhatThereIs) {
  const SmallMcap file = MakeSmallMcap(McapCompression::kZstd, 20);
  std::map<McapOp, int> counts;
  McapStatistics statistics;
  for (const Placed& placed : RecordsOf(file.bytes)) {
    ++counts[placed.record.op];
    if (placed.record.op == McapOp::kStatistics) {
      ASSERT_TRUE(DecodeMcap(placed.record.fields, statistics));
    }
    if (placed.record.op != McapOp::kSummaryOffset) continue;
    const auto at = LoadLittleEndian<std::uint64_t>(placed.record.fields.data() + 1);
    EXPECT_EQ(file.bytes[at], placed.record.fields[0]);  // a group begins with its code
  }
  EXPECT_EQ(statistics.messages, 20u);
  EXPECT_EQ(statistics.schemas, 1u);
  EXPECT_EQ(statistics.channels, 2u);
  EXPECT_EQ(static_cast<int>(statistics.chunks), counts[McapOp::kChunk]);
  EXPECT_EQ(counts[McapOp::kChunkIndex], counts[McapOp::kChunk]);
  EXPECT_EQ(statistics.start_time_ns, 1000u);
  EXPECT_EQ(statistics.end_time_ns, 1190u);
  // 0, 3 ... 18 are of the second channel.
  EXPECT_THAT(statistics.messages_of, ElementsAre(Pair(1, 13), Pair(2, 7)));
  EXPECT_EQ(counts[McapOp::kSummaryOffset], 4);
}

}  // namespace mcap_encoder_test
}  // namespace plumescout
