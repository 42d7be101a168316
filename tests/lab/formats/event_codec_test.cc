// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/event_codec.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/types/rng.h"
#include "tests/support/random_events.h"

namespace plumescout::lab {
namespace event_codec_test {

// An event without floating-point numbers, which may be compared with ==.
Event MakeRefresh() { return {3, PosteriorRefreshed{0x0102030405060708}}; }

TEST(EventCodec, TheLayoutIsFixed) {
  EXPECT_EQ(EncodeEvent(MakeRefresh()),
            std::string("\x03\0\0\0\0\0\0\0\x02\x08\x07\x06\x05\x04\x03\x02\x01", 17));
}

TEST(EventCodec, KindsKeepTheNumbersOfRecordedLogs) {
  EXPECT_EQ(EncodeEvent({1, RobotRegistered{}})[8], 0);
  EXPECT_EQ(EncodeEvent({1, ObservationReceived{}})[8], 1);
  EXPECT_EQ(EncodeEvent({1, PosteriorRefreshed{}})[8], 2);
  EXPECT_EQ(EncodeEvent({1, PlanIssued{}})[8], 3);
  EXPECT_EQ(EncodeEvent({1, ProgressReported{}})[8], 4);
  EXPECT_EQ(EncodeEvent({1, EpochBegun{}})[8], 5);
  EXPECT_EQ(EncodeEvent({1, EpochAdopted{}})[8], 6);
  EXPECT_EQ(EncodeEvent({1, RobotRemoved{}})[8], 7);
}

TEST(EventCodec, AnObservationComesBack) {
  Event event;
  event.number = 42;
  event.body = ObservationReceived{
      "r1", {9, 1'700'000'000'000'000'000, {1.5, -2.5, 0.25}, Scan{-3.0, 0.01, 8.0, {1, 2, 3}}}};
  const auto decoded = DecodeEvent(EncodeEvent(event));
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(*decoded, event);
}

TEST(EventCodec, RandomEventsOfEveryKindComeBackBitForBit) {
  RandomEvents events(1);
  bool seen[std::variant_size_v<decltype(Event::body)>] = {};
  for (int i = 0; i < 5000; ++i) {
    const Event event = events.Next();
    const std::string bytes = EncodeEvent(event);
    const auto decoded = DecodeEvent(bytes);
    ASSERT_TRUE(decoded.ok()) << decoded.status();
    ASSERT_EQ(decoded->body.index(), event.body.index());
    ASSERT_EQ(EncodeEvent(*decoded), bytes);  // NaN != NaN, but its bytes are the same
    seen[event.body.index()] = true;
  }
  for (const bool kind : seen) EXPECT_TRUE(kind);
}

TEST(EventCodec, EveryTruncationIsDataLoss) {
  RandomEvents events(3);
  for (int i = 0; i < 50; ++i) {
    const std::string bytes = EncodeEvent(events.Next());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      ASSERT_EQ(DecodeEvent(bytes.substr(0, size)).status().code(), absl::StatusCode::kDataLoss);
    }
  }
}

TEST(EventCodec, BytesLeftOverAreDataLoss) {
  EXPECT_EQ(DecodeEvent(EncodeEvent(MakeRefresh()) + "x").status().code(),
            absl::StatusCode::kDataLoss);
}

TEST(EventCodec, UnknownKindsAndEnumeratorsAreDataLoss) {
  std::string bytes = EncodeEvent(MakeRefresh());
  bytes[8] = 7;  // seven kinds of events: 0 to 6
  EXPECT_EQ(DecodeEvent(bytes).status().code(), absl::StatusCode::kDataLoss);
  bytes = EncodeEvent({1, ProgressReported{"r", 1, ProgressOutcome::kAborted}});
  ASSERT_TRUE(DecodeEvent(bytes).ok());
  bytes.back() = 3;
  EXPECT_EQ(DecodeEvent(bytes).status().code(), absl::StatusCode::kDataLoss);
}

TEST(EventCodec, PlansToEveryKindOfGoalComeBack) {
  for (const GoalKind kind :
       {GoalKind::kOccupancyFrontier, GoalKind::kGasFrontier, GoalKind::kRandomFreeSpace,
        GoalKind::kHome, GoalKind::kInformation}) {
    Event event{1, PlanIssued{}};
    RejectedGoal rejected;
    rejected.goal.kind = kind;
    rejected.reason = RejectionReason::kGone;
    std::get<PlanIssued>(event.body).plan.rejected.push_back(rejected);
    const auto back = DecodeEvent(EncodeEvent(event));
    ASSERT_TRUE(back.ok()) << back.status();
    EXPECT_EQ(*back, event);
  }
}

TEST(EventCodec, ADamagedLengthDoesNotAllocate) {
  std::string bytes = EncodeEvent({1, ObservationReceived{"r", {1, 2, {}, Scan{}}}});
  bytes.replace(bytes.size() - 4, 4, "\xFF\xFF\xFF\xFF");  // of the ranges: four thousand million
  EXPECT_EQ(DecodeEvent(bytes).status().code(), absl::StatusCode::kDataLoss);
}

TEST(EventCodec, RandomDamageNeverDecodesToOtherBytes) {
  RandomEvents events(4);
  Rng rng(5);
  for (int i = 0; i < 5000; ++i) {
    std::string bytes = EncodeEvent(events.Next());
    bytes[rng.Below(bytes.size())] ^= static_cast<char>(1 + rng.Below(255));
    const auto decoded = DecodeEvent(bytes);
    if (decoded.ok()) {
      ASSERT_EQ(EncodeEvent(*decoded), bytes);
    }
  }
}

TEST(EventCodec, TheStartOfARecordingIsEventZero) {
  const RecordingStart start = {"1.2.3", std::string("\0options", 8)};
  const std::string bytes = EncodeStart(start);
  EXPECT_EQ(bytes.substr(0, 8), std::string(8, '\0'));
  EXPECT_EQ(*DecodeStart(bytes), start);
  EXPECT_FALSE(DecodeStart(bytes + '!').ok());
  EXPECT_FALSE(DecodeStart('\1' + bytes.substr(1)).ok());
}

}  // namespace event_codec_test
}  // namespace plumescout::lab
