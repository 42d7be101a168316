// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/mcap/mcap_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/formats/mcap/mcap_files.h"
#include "tests/support/lz4_frame.h"

namespace plumescout {
namespace mcap_reader_test {

using testing::HasSubstr;

// A file around these records of its data, without CRCs and summary.
std::string PlainFile(const std::string& data) {
  return absl::StrCat(kMcapMagic, McapFields().Text("").Text("a test").Record(McapOp::kHeader),
                      data, McapFields().Number(std::uint32_t{0}).Record(McapOp::kDataEnd),
                      McapFields()
                          .Number(std::uint64_t{0})
                          .Number(std::uint64_t{0})
                          .Number(std::uint32_t{0})
                          .Record(McapOp::kFooter),
                      kMcapMagic);
}

std::string Chunk(absl::string_view compression, const std::string& records) {
  return EncodeMcap(McapChunk{1, 1, records.size(), 0, compression, records});
}

constexpr int kFewMessages = 8;  // of two chunks
const std::string kChannel = EncodeMcap(McapChannel{1, 0, "/a", "text"});
const McapMessage kMessage{1, 2, 3, 4, "five"};

void ExpectDamage(const std::string& bytes, const std::string& why) {
  const McapReading reading = ReadMcap(bytes);
  ASSERT_TRUE(reading.open.ok()) << reading.open;
  EXPECT_EQ(reading.end.code(), absl::StatusCode::kDataLoss) << reading.end;
  EXPECT_THAT(std::string(reading.end.message()), HasSubstr(why));
  EXPECT_THAT(std::string(reading.end.message()), HasSubstr("at byte "));
}

TEST(McapReaderTest, MessagesComeBackInOrder) {
  for (const McapCompression compression : {McapCompression::kNone, McapCompression::kZstd}) {
    const SmallMcap file = MakeSmallMcap(compression);
    const McapReading reading = ReadMcap(file.bytes);
    EXPECT_TRUE(reading.end.ok()) << reading.end;
    EXPECT_EQ(reading.torn_end, "");
    EXPECT_EQ(reading.messages, file.messages);
  }
}

TEST(McapReaderTest, ChannelsAndSchemasAreKnownWithTheFirstMessage) {
  const TempFolder folder;
  const std::string path = folder.File("f.mcap");
  ASSERT_TRUE(WriteFile(path, MakeSmallMcap(McapCompression::kZstd).bytes).ok());
  EXPECT_TRUE(McapReader::IsMcap(path));
  auto reader = McapReader::Open(path);
  ASSERT_TRUE(reader.ok()) << reader.status();
  EXPECT_EQ(reader->library(), "a test");
  ASSERT_TRUE(reader->Next().ok());
  EXPECT_EQ(reader->schemas().at(1), (McapSchema{1, "a.B", "protobuf", "schema"}));
  EXPECT_EQ(reader->channels().at(1), (McapChannel{1, 1, "/typed", "protobuf"}));
  EXPECT_EQ(reader->channels().at(2), (McapChannel{2, 0, "/plain", "text"}));
  EXPECT_GT(reader->share_read(), 0.0);
  EXPECT_LT(reader->share_read(), 1.0);
}

TEST(McapReaderTest, WhatIsNoMcapFileIsRefused) {
  const TempFolder folder;
  EXPECT_EQ(McapReader::Open(folder.File("none")).status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(McapReader::Open(folder.path()).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_FALSE(McapReader::IsMcap(folder.File("none")));
  const std::string whole = MakeSmallMcap(McapCompression::kZstd).bytes;
  const std::size_t first = FindMcapRecord(whole, McapOp::kChunk);
  for (std::size_t size = 0; size < first; ++size) {
    EXPECT_EQ(ReadMcap(whole.substr(0, size)).open.code(), absl::StatusCode::kDataLoss) << size;
  }
  EXPECT_EQ(ReadMcap("\x89MCAP1\r\n" + whole.substr(8)).open.code(), absl::StatusCode::kDataLoss);
}

// However a file is cut off, the messages of its whole chunks are read, and no error is made of it.
TEST(McapReaderTest, AFileThatIsCutOffIsReadUpToTheCut) {
  const SmallMcap file = MakeSmallMcap(McapCompression::kZstd, kFewMessages);
  const std::size_t first = FindMcapRecord(file.bytes, McapOp::kChunk);
  const std::size_t data_end = FindMcapRecord(file.bytes, McapOp::kDataEnd);
  std::size_t most = 0;
  for (std::size_t size = first; size < file.bytes.size(); ++size) {
    const McapReading reading = ReadMcap(file.bytes.substr(0, size));
    ASSERT_TRUE(reading.open.ok() && reading.end.ok()) << size << reading.end;
    ASSERT_THAT(reading.torn_end, HasSubstr("cut off at byte ")) << size;
    ASSERT_TRUE(
        std::equal(reading.messages.begin(), reading.messages.end(), file.messages.begin()));
    ASSERT_GE(reading.messages.size(), most);  // a longer file has no fewer
    most = reading.messages.size();
    if (size >= data_end) {
      ASSERT_EQ(most, file.messages.size());
    }
  }
}

// CRCs cover all but themselves.
TEST(McapReaderTest, EveryFlippedByteIsNoticed) {
  const SmallMcap file = MakeSmallMcap(McapCompression::kZstd, kFewMessages);
  for (std::size_t at = 0; at < file.bytes.size(); ++at) {
    std::string bytes = file.bytes;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    const McapReading reading = ReadMcap(bytes);
    const bool noticed = !reading.open.ok() || !reading.end.ok() || !reading.torn_end.empty();
    EXPECT_TRUE(noticed) << at;
  }
}

TEST(McapReaderTest, ChecksumsAreNamed) {
  const std::string whole = MakeSmallMcap(McapCompression::kNone).bytes;
  const auto flip = [&](std::size_t at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    return bytes;
  };
  // The last byte of a chunk is one of its records.
  ExpectDamage(flip(FindMcapRecord(whole, McapOp::kMessageIndex) - 1), "mismatch of a chunk");
  ExpectDamage(flip(FindMcapRecord(whole, McapOp::kMessageIndex) + 20), "mismatch of the data");
  // The first time of all messages, which readers cannot but believe.
  const std::size_t statistics = FindMcapRecord(whole, McapOp::kStatistics);
  ExpectDamage(flip(statistics + kMcapHeadBytes + 30), "mismatch of the summary");
}

TEST(McapReaderTest, MessagesBeforeADamagedChunkAreRead) {
  const SmallMcap file = MakeSmallMcap(McapCompression::kZstd);
  std::string bytes = file.bytes;
  bytes[FindMcapRecord(bytes, McapOp::kChunk, 1) + kMcapHeadBytes + 60] ^= 1;
  const McapReading reading = ReadMcap(bytes);
  EXPECT_EQ(reading.end.code(), absl::StatusCode::kDataLoss);
  EXPECT_FALSE(reading.messages.empty());
  EXPECT_LT(reading.messages.size(), file.messages.size());
}

TEST(McapReaderTest, MessagesMayStandOutsideOfChunks) {
  const McapReading reading = ReadMcap(PlainFile(kChannel + EncodeMcap(kMessage)));
  EXPECT_TRUE(reading.end.ok()) << reading.end;
  EXPECT_EQ(reading.messages, std::vector<McapMessage>{kMessage});
}

TEST(McapReaderTest, WhatIsOfNoInterestIsPassedOver) {
  const auto other = [](int code) {
    return McapFields().Text("anything").Record(static_cast<McapOp>(code));
  };
  // An attachment, metadata, a record of a later version and one of somebody's own.
  const std::string others = other(0x09) + other(0x0C) + other(0x42) + other(0x80);
  const McapReading reading =
      ReadMcap(PlainFile(others + kChannel + Chunk("", others + EncodeMcap(kMessage)) + others));
  EXPECT_TRUE(reading.end.ok()) << reading.end;
  EXPECT_EQ(reading.messages, std::vector<McapMessage>{kMessage});
}

TEST(McapReaderTest, ACompressionThatIsNotKnownIsNamed) {
  const McapReading reading = ReadMcap(PlainFile(Chunk("brotli", "packed")));
  EXPECT_EQ(reading.end.code(), absl::StatusCode::kUnimplemented);
  EXPECT_THAT(std::string(reading.end.message()), HasSubstr("\"brotli\""));
}

TEST(McapReaderTest, ChunksOfLz4AreRead) {
  const std::string records = kChannel + EncodeMcap(kMessage);
  const std::string packed = support::PackLz4(records);
  const McapReading reading =
      ReadMcap(PlainFile(EncodeMcap(McapChunk{1, 1, records.size(), 0, "lz4", packed})));
  EXPECT_TRUE(reading.end.ok()) << reading.end;
  EXPECT_EQ(reading.messages, std::vector<McapMessage>{kMessage});
  ExpectDamage(PlainFile(EncodeMcap(McapChunk{1, 1, records.size() - 1, 0, "lz4", packed})),
               "the lz4 frame holds more than");
}

TEST(McapReaderTest, DamageIsNamedWithItsPlace) {
  const std::string message = EncodeMcap(kMessage);
  ExpectDamage(PlainFile(message), "channel 1, which did not come up");
  ExpectDamage(PlainFile(EncodeMcap(McapChannel{1, 5, "/a", "text"})), "has schema 5");
  ExpectDamage(PlainFile(kChannel + EncodeMcap(McapChannel{1, 0, "/b", "text"})),
               "another channel 1");
  ExpectDamage(PlainFile(EncodeMcap(McapSchema{1, "a", "b", "c"}) +
                         EncodeMcap(McapSchema{1, "a", "b", "d"})),
               "another schema 1");
  ExpectDamage(PlainFile(McapFields().Record(McapOp::kChannel)), "a channel ends too early");
  ExpectDamage(PlainFile(McapFields().Record(McapOp::kSchema)), "a schema ends too early");
  ExpectDamage(PlainFile(McapFields().Record(McapOp::kMessage)), "a message ends too early");
  ExpectDamage(PlainFile(McapFields().Record(McapOp::kChunk)), "a chunk ends too early");
  ExpectDamage(PlainFile(McapFields().Record(McapOp::kDataEnd)), "data's end is cut short");
  ExpectDamage(PlainFile(McapFields().Record(McapOp::kStatistics)), "does not belong");
  ExpectDamage(PlainFile(McapFields().Record(static_cast<McapOp>(0))), "kind 0");
  ExpectDamage(PlainFile(Chunk("zstd", "no frame")), "in the record at byte");
  ExpectDamage(PlainFile(Chunk("lz4", "no frame")), "lz4: ERROR_frameType_unknown");
  ExpectDamage(PlainFile(kChannel + Chunk("", message + "torn")), "beyond its chunk");
  ExpectDamage(PlainFile(EncodeMcap(McapChunk{1, 1, kMcapMaxRecordBytes + 1, 0, "", ""})),
               "a chunk of 536870913 bytes");
  ExpectDamage(PlainFile(EncodeMcap(McapChunk{1, 1, 7, 0, "", "four"})), "has 4 bytes, and says 7");
}

TEST(McapReaderTest, ARecordBeyondTheEndOfAWholeFileIsDamage) {
  std::string bytes = PlainFile(kChannel);
  bytes[FindMcapRecord(bytes, McapOp::kChannel) + 4] = 1;  // 2^24 bytes more
  ExpectDamage(bytes, "beyond the end of the file");
}

TEST(McapReaderTest, WhatFollowsTheFileIsDamage) {
  const std::string whole = PlainFile(kChannel);
  ExpectDamage(absl::StrCat(whole, kMcapMagic), "follows the footer");
}

TEST(McapReaderTest, TheSummaryIsThatOfTheFile) {
  const std::string whole = MakeSmallMcap(McapCompression::kNone).bytes;
  const auto change = [&](McapOp op, std::size_t field) {
    std::string bytes = whole;
    bytes[FindMcapRecord(bytes, op) + kMcapHeadBytes + field] ^= 1;
    return bytes;
  };
  ExpectDamage(change(McapOp::kStatistics, 0), "statistics tell of 21 messages");
  ExpectDamage(change(McapOp::kChunkIndex, 16), "no chunk of");
  ExpectDamage(change(McapOp::kFooter, 0), "the footer has the summary at byte");
}

}  // namespace mcap_reader_test
}  // namespace plumescout
