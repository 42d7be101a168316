// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/mcap/mcap_records.h"

#include <gtest/gtest.h>

#include <string>

namespace plumescout {
namespace mcap_records_test {

// The fields of the one record that `bytes` are.
absl::string_view FieldsOf(absl::string_view bytes, McapOp op) {
  McapRecord record;
  EXPECT_TRUE(TakeMcapRecord(bytes, record));
  EXPECT_EQ(record.op, op);
  EXPECT_TRUE(bytes.empty());
  return record.fields;
}

// A record that lacks bytes is none.
template <typename Record>
void ExpectEveryCutIsNoticed(absl::string_view fields) {
  for (std::size_t size = 0; size < fields.size(); ++size) {
    Record record;
    EXPECT_FALSE(DecodeMcap(fields.substr(0, size), record)) << size;
  }
  Record record;
  EXPECT_TRUE(DecodeMcap(std::string(fields) + "of a later version", record));
}

TEST(McapRecordsTest, BytesAreThoseOfTheSpecification) {
  // Code 5, 25 bytes: channel 3, sequence 4, two times, three bytes.
  EXPECT_EQ(EncodeMcap(McapMessage{3, 4, 5, 6, "abc"}),
            std::string("\x05\x19\0\0\0\0\0\0\0"
                        "\x03\0\x04\0\0\0\x05\0\0\0\0\0\0\0\x06\0\0\0\0\0\0\0abc",
                        34));
  // Code 4, 20 bytes: channel 1 of schema 2, two texts, no metadata.
  EXPECT_EQ(EncodeMcap(McapChannel{1, 2, "/t", "xyz"}),
            std::string("\x04\x15\0\0\0\0\0\0\0"
                        "\x01\0\x02\0\x02\0\0\0/t\x03\0\0\0xyz\0\0\0\0",
                        30));
}

TEST(McapRecordsTest, RecordsComeBack) {
  const McapSchema schema{7, "a.B", "protobuf", std::string("\0\xFF", 2)};
  McapSchema schema_back;
  ASSERT_TRUE(DecodeMcap(FieldsOf(EncodeMcap(schema), McapOp::kSchema), schema_back));
  EXPECT_EQ(schema_back, schema);
  const McapChannel channel{1, 7, "/topic", "protobuf"};
  McapChannel channel_back;
  ASSERT_TRUE(DecodeMcap(FieldsOf(EncodeMcap(channel), McapOp::kChannel), channel_back));
  EXPECT_EQ(channel_back, channel);
  const McapMessage message{1, 2, ~std::uint64_t{0}, 3, ""};
  McapMessage message_back;
  ASSERT_TRUE(DecodeMcap(FieldsOf(EncodeMcap(message), McapOp::kMessage), message_back));
  EXPECT_EQ(message_back, message);
}

TEST(McapRecordsTest, RecordsOfTheSummaryComeBack) {
  McapChunkIndex index{1, 2, 3, 4, {{5, 6}, {7, 8}}, 9, "zstd", 10, 11};
  McapChunkIndex index_back;
  const std::string index_bytes = EncodeMcap(index);
  ASSERT_TRUE(DecodeMcap(FieldsOf(index_bytes, McapOp::kChunkIndex), index_back));
  EXPECT_EQ(EncodeMcap(index_back), index_bytes);
  EXPECT_EQ(index_back.indexes_at, index.indexes_at);
  EXPECT_EQ(index_back.uncompressed_bytes, 11u);
  McapStatistics statistics{1, 2, 3, 4, 5, 6, 7, 8, {{9, 10}}};
  McapStatistics statistics_back;
  const std::string statistics_bytes = EncodeMcap(statistics);
  ASSERT_TRUE(DecodeMcap(FieldsOf(statistics_bytes, McapOp::kStatistics), statistics_back));
  EXPECT_EQ(EncodeMcap(statistics_back), statistics_bytes);
  EXPECT_EQ(statistics_back.messages_of.at(9), 10u);
}

TEST(McapRecordsTest, FieldsThatEndTooEarlyAreNone) {
  const std::string schema = EncodeMcap(McapSchema{7, "a.B", "protobuf", "data"});
  ExpectEveryCutIsNoticed<McapSchema>(FieldsOf(schema, McapOp::kSchema));
  const std::string channel = EncodeMcap(McapChannel{1, 7, "/topic", "protobuf"});
  ExpectEveryCutIsNoticed<McapChannel>(FieldsOf(channel, McapOp::kChannel));
  const std::string chunk = EncodeMcap(McapChunk{1, 2, 3, 4, "zstd", "packed"});
  ExpectEveryCutIsNoticed<McapChunk>(FieldsOf(chunk, McapOp::kChunk));
  const std::string index = EncodeMcap(McapChunkIndex{1, 2, 3, 4, {{5, 6}}, 9, "zstd", 10, 11});
  ExpectEveryCutIsNoticed<McapChunkIndex>(FieldsOf(index, McapOp::kChunkIndex));
  const std::string statistics = EncodeMcap(McapStatistics{1, 2, 3, 4, 5, 6, 7, 8, {{9, 10}}});
  ExpectEveryCutIsNoticed<McapStatistics>(FieldsOf(statistics, McapOp::kStatistics));
}

TEST(McapRecordsTest, AMapOfHalfAnEntryIsNone) {
  McapFields fields;
  for (int i = 0; i < 4; ++i) fields.Number(std::uint64_t{0});
  fields.Text("half");
  McapChunkIndex index;
  EXPECT_FALSE(DecodeMcap(fields.bytes(), index));
}

TEST(McapRecordsTest, ALengthBeyondTheEndIsNoRecord) {
  const std::string bytes = EncodeMcap(McapMessage{3, 4, 5, 6, "abc"});
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    absl::string_view rest = absl::string_view(bytes).substr(0, size);
    McapRecord record;
    EXPECT_FALSE(TakeMcapRecord(rest, record));
    EXPECT_EQ(rest.size(), size);
  }
  const std::string endless = "\x05" + std::string(8, '\xFF') + "abc";
  absl::string_view rest = endless;
  McapRecord record;
  EXPECT_FALSE(TakeMcapRecord(rest, record));
}

TEST(McapRecordsTest, CrcIsThatOfZlib) {
  EXPECT_EQ(McapCrc("123456789"), 0xCBF43926u);  // the check value of CRC-32
  EXPECT_EQ(McapCrc("6789", McapCrc("12345")), 0xCBF43926u);
}

}  // namespace mcap_records_test
}  // namespace plumescout
