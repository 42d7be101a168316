// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/mcap/mcap_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/formats/mcap/mcap_files.h"
#include "tests/support/random_events.h"

namespace plumescout {
namespace mcap_journal_test {

using testing::HasSubstr;

class McapJournalTest : public testing::Test {
 protected:
  // Writes these records, with messages of another channel between them.
  void Write(const std::vector<std::string>& records) {
    McapEncoder encoder("a test");
    const std::uint16_t other = encoder.AddChannel("/other", "text", 0);
    const std::uint16_t journal = encoder.AddChannel(kMcapJournalTopic, kMcapJournalEncoding, 0);
    std::uint32_t number = 0;
    for (const std::string& record : records) {
      ASSERT_TRUE(encoder.Add({other, number, 1, 1, "other"}).ok());
      ASSERT_TRUE(encoder.Add({journal, number++, 1, 1, record}).ok());
    }
    ASSERT_TRUE(encoder.Finish().ok());
    ASSERT_TRUE(WriteFile(path_, encoder.Take()).ok());
  }

  const TempFolder folder_;
  const std::string path_ = folder_.File("mission.mcap");
  const JournalStart start_{.code_version = "1.2.3", .mission_options = "any"};
};

TEST_F(McapJournalTest, EventsComeBackBitForBit) {
  RandomEvents events(6);
  std::vector<std::string> records = {EncodeStart(start_)};
  for (int i = 0; i < 100; ++i) records.push_back(EncodeEvent(events.Next()));
  Write(records);
  auto reader = McapJournalReader::Open(path_);
  ASSERT_TRUE(reader.ok()) << reader.status();
  EXPECT_EQ(reader->start(), start_);
  std::vector<std::string> read = {EncodeStart(*reader->start())};
  auto event = reader->Next();
  for (; event.ok() && *event; event = reader->Next()) read.push_back(EncodeEvent(**event));
  EXPECT_TRUE(event.ok()) << event.status();
  EXPECT_EQ(read, records);
  EXPECT_EQ(reader->share_read(), 1.0);
  EXPECT_EQ(reader->torn_end(), "");
}

TEST_F(McapJournalTest, AFileWithoutAJournalSaysSo) {
  ASSERT_TRUE(WriteFile(path_, MakeSmallMcap(McapCompression::kZstd).bytes).ok());
  const absl::Status status = McapJournalReader::Open(path_).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(std::string(status.message()), HasSubstr("plumescout.journal"));
}

TEST_F(McapJournalTest, WhatIsNoEventIsDamage) {
  Write({"no start"});
  EXPECT_THAT(std::string(McapJournalReader::Open(path_).status().message()), HasSubstr("event 0"));
  Write({EncodeStart(start_), "no event"});
  auto reader = McapJournalReader::Open(path_);
  ASSERT_TRUE(reader.ok()) << reader.status();
  const absl::Status status = reader->Next().status();
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(std::string(status.message()), HasSubstr("message 1 of /journal"));
  EXPECT_EQ(reader->Next().status(), status);
}

}  // namespace mcap_journal_test
}  // namespace plumescout
