// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/log_replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "tests/client/log_traffic.h"

namespace plumescout::client {
namespace log_replay_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const SegmentHead kHead = {.mission = "hall", .robot = "scout", .epoch = 7};

std::string SegmentOf(const std::vector<LogRecord>& records, SegmentHead head = kHead) {
  std::string bytes = absl::StrCat(SegmentPreamble(), EncodeRecord(head));
  for (const LogRecord& record : records) bytes += EncodeRecord(record);
  return bytes;
}

class LogReplayTest : public ::testing::Test {
 protected:
  std::vector<std::int64_t> Numbers() const { return NumbersOf(replay_.log().entries); }

  LogReplay replay_{"hall", "scout"};
};

TEST_F(LogReplayTest, SegmentsMakeALog) {
  EXPECT_EQ(replay_.log().epoch, 0);
  EXPECT_TRUE(replay_.Read(SegmentOf({EntryAt(1), EntryAt(2), LogMark{1, 1}})).status.ok());
  EXPECT_TRUE(replay_.Read(SegmentOf({EntryAt(3)})).status.ok());

  const KeptLog log = replay_.TakeLog();
  EXPECT_EQ(log.epoch, 7);
  EXPECT_EQ(log.last_sequence, 3);
  EXPECT_EQ(log.entries, (std::vector<Observation>{EntryAt(1), EntryAt(2), EntryAt(3)}));
}

TEST_F(LogReplayTest, AHeadSaysHowTheLogStood) {
  SegmentHead head = kHead;
  head.last_sequence = 90;
  head.applied_sequence = 80;
  head.durable_sequence = 70;

  replay_.Read(SegmentOf({EntryAt(88)}, head));

  EXPECT_EQ(replay_.log().last_sequence, 90);  // 89 and 90 were taken once
  EXPECT_EQ(replay_.log().applied_sequence, 80);
  EXPECT_EQ(replay_.log().durable_sequence, 70);
}

TEST_F(LogReplayTest, WhatIsWrittenTwiceCountsOnce) {
  replay_.Read(SegmentOf({EntryAt(1), EntryAt(2)}));
  replay_.Read(SegmentOf({EntryAt(1), EntryAt(2), EntryAt(3)}));

  EXPECT_THAT(Numbers(), ElementsAre(1, 2, 3));
}

TEST_F(LogReplayTest, NumbersMayBeMissing) {
  replay_.Read(SegmentOf({EntryAt(4), EntryAt(9)}));

  EXPECT_THAT(Numbers(), ElementsAre(4, 9));
  EXPECT_EQ(replay_.log().last_sequence, 9);
}

TEST_F(LogReplayTest, ARenumberingIsOfAllThatStandsBeforeIt) {
  const NumberedRenumbering numbered = {1, {2, 101}};
  const SegmentEnd end =
      replay_.Read(SegmentOf({EntryAt(1), EntryAt(2), EntryAt(3), numbered, EntryAt(103)}));

  EXPECT_THAT(Numbers(), ElementsAre(101, 102, 103));
  EXPECT_EQ(replay_.log().entries[0].sample_time_ns, EntryAt(2).sample_time_ns);
  EXPECT_EQ(replay_.log().applied_sequence, 100);
  EXPECT_EQ(replay_.renumberings(), 1);
  EXPECT_THAT(end.renumberings, ElementsAre(numbered.renumbering));

  replay_.Read(SegmentOf({numbered, EntryAt(104)}));  // written again after a sync that failed
  EXPECT_THAT(Numbers(), ElementsAre(101, 102, 103, 104));
}

TEST_F(LogReplayTest, ARenumberingOfNothingMovesTheLog) {
  replay_.Read(SegmentOf({NumberedRenumbering{1, {1, 42}}, EntryAt(42)}));

  EXPECT_THAT(Numbers(), ElementsAre(42));
}

TEST_F(LogReplayTest, WithoutItsRenumberingALogIsOfNoUse) {
  replay_.Read(SegmentOf({EntryAt(1), EntryAt(2)}));
  SegmentHead head = kHead;
  head.renumberings = 1;
  head.last_sequence = 60;
  replay_.Read(SegmentOf({EntryAt(61)}, head));

  EXPECT_THAT(Numbers(), ElementsAre(61));
}

TEST_F(LogReplayTest, ASegmentThatBreaksOffIsReadUpToThere) {
  const std::string whole = SegmentOf({EntryAt(1), EntryAt(2)});
  const std::size_t cut = whole.size() - 3;

  const SegmentEnd end = replay_.Read(whole.substr(0, cut));

  EXPECT_TRUE(absl::IsOutOfRange(end.status)) << end.status;
  EXPECT_EQ(end.good_bytes, SegmentOf({EntryAt(1)}).size());
  EXPECT_EQ(end.damage_bytes, end.good_bytes);
  EXPECT_EQ(end.lost_bytes, cut - end.good_bytes);
  EXPECT_THAT(Numbers(), ElementsAre(1));
}

TEST_F(LogReplayTest, ASegmentThatBreaksOffInItsHeadHoldsNothing) {
  const std::string head = SegmentOf({});
  for (std::size_t size = 0; size < head.size(); ++size) {
    const SegmentEnd end = replay_.Read(head.substr(0, size));
    EXPECT_TRUE(absl::IsOutOfRange(end.status)) << size;
    EXPECT_EQ(end.good_bytes, 0U);
  }
  EXPECT_EQ(replay_.log().epoch, 0);
}

TEST_F(LogReplayTest, ADamagedRecordIsLeftOutAlone) {
  std::string bytes = SegmentOf({EntryAt(1), EntryAt(2), EntryAt(3)});
  const std::size_t second = SegmentOf({EntryAt(1)}).size();
  bytes[second + 12] = static_cast<char>(bytes[second + 12] ^ 1);

  const SegmentEnd end = replay_.Read(bytes);

  EXPECT_TRUE(absl::IsDataLoss(end.status)) << end.status;
  EXPECT_EQ(end.good_bytes, bytes.size());
  EXPECT_EQ(end.damage_bytes, second);
  EXPECT_EQ(end.lost_bytes, EncodeRecord(EntryAt(2)).size());
  EXPECT_THAT(Numbers(), ElementsAre(1, 3));
}

TEST_F(LogReplayTest, AfterADamagedLengthNothingIsReadable) {
  std::string bytes = SegmentOf({EntryAt(1), EntryAt(2), EntryAt(3)});
  const std::size_t second = SegmentOf({EntryAt(1)}).size();
  bytes[second] = static_cast<char>(bytes[second] ^ 1);

  const SegmentEnd end = replay_.Read(bytes);

  EXPECT_TRUE(absl::IsDataLoss(end.status)) << end.status;
  EXPECT_EQ(end.good_bytes, second);
  EXPECT_THAT(Numbers(), ElementsAre(1));
}

TEST_F(LogReplayTest, OthersLogsAreRefused) {
  SegmentHead head = kHead;
  head.robot = "other";
  const SegmentEnd end = replay_.Read(SegmentOf({EntryAt(1)}, head));
  EXPECT_TRUE(absl::IsFailedPrecondition(end.status));
  EXPECT_THAT(std::string(end.status.message()), HasSubstr("\"other\" in mission \"hall\""));
  EXPECT_TRUE(absl::IsFailedPrecondition(replay_.Read("a letter to a friend").status));
  EXPECT_THAT(Numbers(), IsEmpty());
}

TEST_F(LogReplayTest, ASegmentOfAnotherEpochIsDamage) {
  replay_.Read(SegmentOf({EntryAt(1)}));
  SegmentHead head = kHead;
  head.epoch = 8;
  EXPECT_TRUE(absl::IsDataLoss(replay_.Read(SegmentOf({EntryAt(2)}, head)).status));
  EXPECT_THAT(Numbers(), ElementsAre(1));
}

TEST_F(LogReplayTest, AHeadHasItsPlace) {
  EXPECT_TRUE(absl::IsDataLoss(
      replay_.Read(absl::StrCat(SegmentPreamble(), EncodeRecord(EntryAt(1)))).status));
  EXPECT_TRUE(absl::IsDataLoss(replay_.Read(SegmentOf({kHead})).status));
}

}  // namespace log_replay_test
}  // namespace plumescout::client
