// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/log_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"

namespace plumescout::client {
namespace log_record_test {

using ::testing::HasSubstr;

const SegmentHead kHead = {.mission = "hall",
                           .robot = "scout",
                           .epoch = 0x1234567890ABC,
                           .last_sequence = 900,
                           .applied_sequence = 800,
                           .durable_sequence = 700,
                           .renumberings = 2};

Observation Reading(double concentration_ppm) {
  return {.sequence = 5,
          .sample_time_ns = 1'700'000'000'000'000'000,
          .pose = {1.0, -2.0, 0.5},
          .payload = GasReading{.concentration_ppm = concentration_ppm}};
}

std::vector<LogRecord> OneOfEach() {
  Observation scan = Reading(0.0);
  scan.payload = Scan{-1.0, 0.5, 8.0, {1.0F, 2.5F, std::numeric_limits<float>::infinity()}};
  Observation gap = Reading(0.0);
  gap.payload = SequenceGap{5, 9};
  return {kHead, scan, Reading(3.25), gap, LogMark{4, 3}, NumberedRenumbering{3, {10, 4}}};
}

TEST(LogRecord, ComesBackAsItWas) {
  for (const LogRecord& record : OneOfEach()) {
    const std::string bytes = EncodeRecord(record);
    const auto decoded = DecodeRecord(bytes + "what follows");
    ASSERT_TRUE(decoded.ok()) << decoded.status();
    EXPECT_EQ(decoded->size_bytes, bytes.size());
    EXPECT_EQ(RecordSize_bytes(bytes), bytes.size());
    EXPECT_TRUE(decoded->record == record);
  }
}

TEST(LogRecord, EveryBitCounts) {
  for (const LogRecord& record : OneOfEach()) {
    const std::string bytes = EncodeRecord(record);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      std::string flipped = bytes;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
      EXPECT_FALSE(DecodeRecord(flipped).ok()) << bit;
    }
  }
}

TEST(LogRecord, ThatEndsTooEarlySaysSo) {
  for (const LogRecord& record : OneOfEach()) {
    const std::string bytes = EncodeRecord(record);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_TRUE(absl::IsOutOfRange(DecodeRecord(bytes.substr(0, size)).status())) << size;
    }
  }
}

TEST(LogRecord, ZerosAreDamage) {
  EXPECT_TRUE(absl::IsDataLoss(DecodeRecord(std::string(64, '\0')).status()));
}

TEST(LogRecord, AnObservationThatNoServerTakesIsAGap) {
  for (const double ppm : {-5.0, std::numeric_limits<double>::quiet_NaN()}) {
    const auto decoded = DecodeRecord(EncodeRecord(Reading(ppm)));
    ASSERT_TRUE(decoded.ok()) << decoded.status();
    const auto& gap = std::get<Observation>(decoded->record);
    EXPECT_EQ(gap.sequence, 5);
    EXPECT_EQ(std::get<SequenceGap>(gap.payload), (SequenceGap{5, 5}));
  }
}

TEST(SegmentPreambleTest, TellsOurFilesFromOthers) {
  const std::string bytes = SegmentPreamble();
  EXPECT_EQ(*CheckPreamble(bytes + "more"), bytes.size());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_TRUE(absl::IsOutOfRange(CheckPreamble(bytes.substr(0, size)).status())) << size;
  }
  EXPECT_TRUE(absl::IsFailedPrecondition(CheckPreamble("SQLite format 3").status()));
}

TEST(SegmentPreambleTest, NamesAVersionThatIsNotKnown) {
  std::string bytes = SegmentPreamble();
  bytes[bytes.size() - 4] = static_cast<char>(kSegmentVersion + 1);
  const absl::Status status = CheckPreamble(bytes).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(status));
  EXPECT_THAT(std::string(status.message()), HasSubstr(absl::StrCat(kSegmentVersion + 1)));
}

}  // namespace log_record_test
}  // namespace plumescout::client
