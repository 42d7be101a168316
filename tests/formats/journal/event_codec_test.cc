// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/event_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "core/types/rng.h"
#include "formats/journal/varint.h"
#include "tests/support/box_room.h"
#include "tests/support/random_events.h"

namespace plumescout {
namespace event_codec_test {

using testing::HasSubstr;

// An event without floating-point numbers, which may be compared with ==.
Event MakeRefresh() { return {3, PosteriorRefreshed{0x0102030405060708}}; }

TEST(EventCodec, TheLayoutIsFixed) {
  std::string bytes("\x01\x03\x06", 3);  // version 1 of kind 3, zigzagged number
  AppendVarint(ZigZag(0x0102030405060708), bytes);
  EXPECT_EQ(EncodeEvent(MakeRefresh()), bytes);
}

TEST(EventCodec, KindsKeepTheirNumbers) {
  EXPECT_EQ(EncodeStart({})[1], 0);
  EXPECT_EQ(EncodeEvent({1, RobotRegistered{}})[1], 1);
  EXPECT_EQ(EncodeEvent({1, ObservationReceived{}})[1], 2);
  EXPECT_EQ(EncodeEvent({1, PosteriorRefreshed{}})[1], 3);
  EXPECT_EQ(EncodeEvent({1, PlanIssued{}})[1], 4);
  EXPECT_EQ(EncodeEvent({1, ProgressReported{}})[1], 5);
  EXPECT_EQ(EncodeEvent({1, EpochBegun{}})[1], 6);
  EXPECT_EQ(EncodeEvent({1, EpochAdopted{}})[1], 7);
  EXPECT_EQ(EncodeEvent({1, RobotRemoved{}})[1], 8);
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

TEST(EventCodec, UnknownEnumeratorsAreDataLoss) {
  std::string bytes = EncodeEvent({1, ProgressReported{"r", 1, ProgressOutcome::kAborted}});
  ASSERT_TRUE(DecodeEvent(bytes).ok());
  bytes.back() = 3;
  EXPECT_EQ(DecodeEvent(bytes).status().code(), absl::StatusCode::kDataLoss);
}

TEST(EventCodec, UnknownKindsAndVersionsAreNamed) {
  std::string bytes = EncodeEvent(MakeRefresh());
  bytes[1] = 14;  // thirteen kinds of events: 1 to 13
  absl::Status status = DecodeEvent(bytes).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(std::string(status.message()), HasSubstr("kind 14"));
  bytes = EncodeEvent(MakeRefresh());
  bytes[0] = 2;
  status = DecodeEvent(bytes).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(std::string(status.message()), HasSubstr("PosteriorRefreshed of version 2"));
}

TEST(EventCodec, ANumberThatDoesNotFitIsDataLoss) {
  Plan plan;
  plan.effort.batches = 5;
  std::string bytes = EncodeEvent({1, PlanIssued{plan}});
  // From the end: cpu_s, no explanation, three flags, then the batches.
  const std::size_t at = bytes.size() - 8 - 1 - 3 - 1;
  ASSERT_EQ(bytes[at], 10);  // 5, zigzagged
  std::string far;
  AppendVarint(ZigZag(std::int64_t{1} << 31), far);
  EXPECT_FALSE(DecodeEvent(bytes.replace(at, 1, far)).ok());
}

TEST(EventCodec, PlansToEveryKindOfGoalComeBack) {
  for (const GoalKind kind :
       {GoalKind::kOccupancyFrontier, GoalKind::kGasFrontier, GoalKind::kRandomFreeSpace,
        GoalKind::kHome, GoalKind::kInformation, GoalKind::kSite, GoalKind::kMakeWay}) {
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
  std::string huge;
  AppendVarint(std::uint64_t{1} << 60, huge);
  std::string bytes = EncodeEvent({1, PlanIssued{Plan{}}});
  const std::size_t strategy = 2 + 1 + 1 + 1;  // behind head, number, id and the robot's length
  ASSERT_EQ(bytes[strategy], 0);
  EXPECT_FALSE(DecodeEvent(bytes.replace(strategy, 1, huge)).ok());
  const std::size_t candidates = strategy + 1 + 1 + 1 + 1 + 1 + 1;  // revision to chosen
  bytes = EncodeEvent({1, PlanIssued{Plan{}}});
  ASSERT_EQ(bytes[candidates], 0);
  EXPECT_EQ(DecodeEvent(bytes.replace(candidates, 1, huge)).status().code(),
            absl::StatusCode::kDataLoss);
}

TEST(EventCodec, RandomDamageDecodesToAnEventOrNotAtAll) {
  RandomEvents events(4);
  Rng rng(5);
  for (int i = 0; i < 5000; ++i) {
    std::string bytes = EncodeEvent(events.Next());
    bytes[rng.Below(bytes.size())] ^= static_cast<char>(1 + rng.Below(255));
    const auto decoded = DecodeEvent(bytes);
    if (!decoded.ok()) continue;
    const std::string again = EncodeEvent(*decoded);  // ranges may have found a better unit
    ASSERT_EQ(EncodeEvent(*DecodeEvent(again)), again);
  }
}

TEST(EventCodec, AScanOf360BeamsTakesLessThan500Bytes) {
  const Pose2 pose{2.345, 3.456, -2.5};
  Scan scan = support::ScanInBox(pose, 8.0, 6.0, {{{4.0, 2.0}, 0.5}, {{6.0, 5.0}, 0.3}});
  for (float& range_m : scan.ranges_m) {
    if (!std::isfinite(range_m)) continue;
    const double steps = std::round(static_cast<double>(range_m) / 0.01);
    range_m = static_cast<float>(steps * 0.01);
  }
  const Event event{
      227'000, ObservationReceived{"warehouse-3", {36'000, 1'700'000'000'123'456'789, pose, scan}}};
  EXPECT_LE(EncodeEvent(event).size(), 500U);
  EXPECT_EQ(*DecodeEvent(EncodeEvent(event)), event);
}

TEST(EventCodec, TheStartOfAJournalIsEventZero) {
  JournalStart start;
  start.code_version = "1.2.3";
  start.mission_options = std::string("\0options", 8);
  start.mission = "hall";
  start.owner = "operator";
  start.tenant = "plant";
  start.created_ns = 1'700'000'000'123'456'789;
  const std::string bytes = EncodeStart(start);
  EXPECT_EQ(bytes.substr(0, 3), std::string("\x01\x00\x00", 3));
  EXPECT_EQ(*DecodeStart(bytes), start);
  EXPECT_EQ(DecodeStart(bytes + '!').status().code(), absl::StatusCode::kDataLoss);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(DecodeStart(bytes.substr(0, size)).status().code(), absl::StatusCode::kDataLoss);
  }
  std::string other = bytes;
  other[2] = 2;  // event 1
  EXPECT_FALSE(DecodeStart(other).ok());
}

TEST(EventCodec, AStartIsNoEventAndNoEventAStart) {
  EXPECT_EQ(DecodeEvent(EncodeStart({})).status().code(), absl::StatusCode::kDataLoss);
  EXPECT_EQ(DecodeStart(EncodeEvent({0, EpochAdopted{}})).status().code(),
            absl::StatusCode::kDataLoss);
}

Plan DecodedForReplay(const Plan& plan) {
  const auto event = DecodeEvent(EncodeEvent({7, PlanIssued{plan}}, PlanDetail::kForReplay));
  EXPECT_TRUE(event.ok()) << event.status();
  EXPECT_EQ(event->number, 7);
  return std::get<PlanIssued>(event->body).plan;
}

TEST(EventCodec, ForReplayAPlanKeepsItsChoiceOnly) {
  Plan plan;
  plan.robot = "r1";
  plan.chosen = 2;
  plan.candidates.resize(4);
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    plan.candidates[i].goal.cell = {static_cast<int>(i), 0};
    plan.candidates[i].stops = {{1.0, static_cast<double>(i)}};
  }
  plan.rejected.resize(3);
  plan.trajectory.waypoints.resize(2);
  plan.trajectory.duration_s = 12.5;
  plan.explanation = "why";
  Plan expected = plan;
  expected.chosen = 0;
  expected.candidates = {plan.candidates[2]};
  expected.rejected.clear();
  EXPECT_EQ(DecodedForReplay(plan), expected);
  EXPECT_EQ(DecodedForReplay(expected), expected);
}

TEST(EventCodec, ForReplayAPlanWithoutAChoiceHasNoCandidates) {
  Plan plan;
  plan.candidates.resize(2);
  for (const int chosen : {-1, -2, 2}) {
    plan.chosen = chosen;
    const Plan back = DecodedForReplay(plan);
    EXPECT_EQ(back.chosen, chosen);
    EXPECT_TRUE(back.candidates.empty());
  }
}

TEST(EventCodec, ForReplayAPlanKeepsTheFirstGoalThatOthersAreInTheWayOf) {
  Plan plan;
  plan.rejected.resize(4);
  plan.rejected[1] = {{GoalKind::kHome, {1, 0}, {}, {}, 0}, RejectionReason::kTraffic, "first"};
  plan.rejected[2] = {{GoalKind::kHome, {2, 0}, {}, {}, 0}, RejectionReason::kTraffic, "second"};
  Plan expected = plan;
  expected.rejected = {plan.rejected[1]};
  EXPECT_EQ(DecodedForReplay(plan), expected);
  EXPECT_EQ(DecodedForReplay(expected), expected);
}

TEST(EventCodec, AnAssignedPlanIsOfTheSecondVersionAndOthersAreAsBefore) {
  Plan plan;
  plan.robot = "r1";
  const Event asked{3, PlanIssued{plan}};
  const Event assigned{3, PlanIssued{plan, true}};
  EXPECT_EQ(EncodeEvent(asked)[0], 1);
  EXPECT_EQ(EncodeEvent(assigned)[0], 2);
  EXPECT_EQ(EncodeEvent(assigned).size(), EncodeEvent(asked).size() + 1);
  for (const PlanDetail detail : {PlanDetail::kWhole, PlanDetail::kForReplay}) {
    EXPECT_EQ(DecodeEvent(EncodeEvent(asked, detail)).value(), asked);
    EXPECT_EQ(DecodeEvent(EncodeEvent(assigned, detail)).value(), assigned);
  }
}

TEST(EventCodec, ForReplayOtherEventsAreWhole) {
  EXPECT_EQ(EncodeEvent(MakeRefresh(), PlanDetail::kForReplay), EncodeEvent(MakeRefresh()));
}

TEST(EventCodec, ARobotOfTheMissionsFrameIsWrittenAsBefore) {
  RobotRegistered registered{"r1", 0.25, 7, 9};
  const std::string before = EncodeEvent({5, registered});
  EXPECT_EQ(before[0], 1);
  registered.frame = {{1.5, -2.0, 0.75}, 0.1, 0.02};
  const std::string framed = EncodeEvent({5, registered});
  EXPECT_EQ(framed[0], 2);
  EXPECT_EQ(framed.substr(1, before.size() - 1), before.substr(1)) << "the frame comes last";
  const auto decoded = DecodeEvent(framed);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(*decoded, (Event{5, registered}));
  EXPECT_EQ(DecodeEvent(before)->body, EventBody(RobotRegistered{"r1", 0.25, 7, 9}));
}

TEST(EventCodec, WhatASensorReadsComesBack) {
  RobotRegistered registered{"r1", 0.25, 7, 9};
  registered.sensors = {{"pid", {0.1, 0.0}, 0.5, 0.0}, {"ec", {}, 0.0, 0.0, "hydrogen-sulfide"}};
  const auto decoded = DecodeEvent(EncodeEvent({5, registered}));
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(*decoded, (Event{5, registered}));
}

TEST(EventCodec, ACorrectionComesBack) {
  const Event event = {
      8, ObservationReceived{"r1",
                             {3,
                              40,
                              {1.0, 2.0, 0.5},
                              PoseCorrection{{{10, {1.0, 2.0, 3.0}}, {20, {-1.0, 0.5, 0.0}}}}}}};
  const std::string bytes = EncodeEvent(event);
  EXPECT_EQ(bytes[0], 2);
  const auto decoded = DecodeEvent(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(*decoded, event);
  const Event reading = {8, ObservationReceived{"r1", {3, 40, {}, GasReading{1.0, 0.0}}}};
  EXPECT_EQ(EncodeEvent(reading)[0], 1);
}

TEST(EventCodec, RebuildsOfTheMapComeBack) {
  for (const EventBody& body : {EventBody(MapRebuildBegun{}), EventBody(MapRebuilt{})}) {
    const auto decoded = DecodeEvent(EncodeEvent({4, body}));
    ASSERT_TRUE(decoded.ok()) << decoded.status();
    EXPECT_EQ(*decoded, (Event{4, body}));
  }
  EXPECT_EQ(EncodeEvent({1, MapRebuildBegun{}})[1], 11);
  EXPECT_EQ(EncodeEvent({1, MapRebuilt{}})[1], 12);
}

TEST(EventCodec, ChangesOfKeepOutAreasComeBack) {
  const Event event = {5,
                       KeepOutChanged{{"ramp", "spill"}, {{{{0, 0}, {1, 0.5}, {0, 1}}, "spill"}}}};
  const std::string bytes = EncodeEvent(event);
  EXPECT_EQ(bytes[0], 1);
  EXPECT_EQ(bytes[1], 13);
  const auto decoded = DecodeEvent(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(*decoded, event);
}

}  // namespace event_codec_test
}  // namespace plumescout
