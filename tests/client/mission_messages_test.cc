// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/mission_messages.h"

#include <gtest/gtest.h>

#include <optional>

#include "proto/convert/options.h"
#include "proto/convert/status.h"

namespace plumescout::client {
namespace mission_messages_test {

v1::Mission House() {
  v1::Mission proto;
  proto.set_name("missions/house");
  proto.set_state(v1::MISSION_STATE_PAUSED);
  proto.set_phase(v1::MISSION_PHASE_GAS_PROBING);
  *proto.mutable_options() = ToProto(MissionOptions());
  return proto;
}

TEST(MissionMessagesTest, AMissionIsReadWhole) {
  v1::Mission proto = House();
  proto.set_revision(12);
  proto.set_robot_count(3);
  proto.set_next_map_update_ns(99);
  proto.set_owner("lab");
  proto.mutable_options()->set_seed(17);
  proto.mutable_idle_time_to_live()->set_seconds(90);
  proto.mutable_idle_time_to_live()->set_nanos(500'000'000);
  proto.mutable_memory()->set_used_bytes(10);
  proto.mutable_memory()->set_budget_bytes(20);
  proto.set_event_retention(v1::EVENT_RETENTION_SINCE_SNAPSHOT);
  proto.mutable_gas_timings()->mutable_update()->set_sample_count(4);
  proto.mutable_gas_timings()->mutable_staleness()->set_p99_s(0.25);
  proto.mutable_objective()->set_state(v1::ObjectiveStatus::STATE_MET);
  proto.mutable_objective()->set_confidence(0.96);
  proto.mutable_objective()->set_explanation("Clean.");
  const auto mission = DetailsFromProto(proto);
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_EQ(mission->id, "house");
  EXPECT_EQ(mission->state, MissionState::kPaused);
  EXPECT_EQ(mission->phase, MissionPhase::kGasProbing);
  EXPECT_EQ(mission->revision, 12);
  EXPECT_EQ(mission->robot_count, 3);
  EXPECT_EQ(mission->next_map_update_ns, 99);
  EXPECT_EQ(mission->owner, "lab");
  EXPECT_EQ(mission->options.seed, 17U);
  EXPECT_EQ(mission->idle_time_to_live, absl::Milliseconds(90'500));
  EXPECT_EQ(mission->memory_used_bytes, 10);
  EXPECT_EQ(mission->memory_budget_bytes, 20);
  EXPECT_EQ(mission->event_retention, EventRetention::kSinceSnapshot);
  EXPECT_EQ(mission->gas_update.samples, 4);
  EXPECT_EQ(mission->gas_staleness.p99_s, 0.25);
  ASSERT_TRUE(mission->objective.has_value());
  EXPECT_EQ(mission->objective->state, ObjectiveState::kMet);
  EXPECT_EQ(mission->objective->confidence, 0.96);
  EXPECT_EQ(mission->objective_explanation, "Clean.");
}

TEST(MissionMessagesTest, WhatIsNotSaidIsNever) {
  const auto mission = DetailsFromProto(House());
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_EQ(mission->idle_time_to_live, absl::InfiniteDuration());
  EXPECT_EQ(mission->next_map_update_ns, std::nullopt);
  EXPECT_EQ(mission->objective, std::nullopt);
  EXPECT_EQ(mission->event_retention, EventRetention::kAll);
}

TEST(MissionMessagesTest, OfOneThatIsNotInMemoryThereIsNameAndState) {
  v1::Mission proto;
  proto.set_name("missions/house");
  proto.set_state(v1::MISSION_STATE_RECOVERING);
  const auto mission = DetailsFromProto(proto);
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_EQ(mission->id, "house");
  EXPECT_EQ(mission->state, MissionState::kRecovering);
  proto.set_state(v1::MISSION_STATE_SLEEPING);
  EXPECT_EQ(DetailsFromProto(proto)->state, MissionState::kSleeping);
  proto.set_state(v1::MISSION_STATE_ELSEWHERE);
  proto.set_node("n2");
  EXPECT_EQ(DetailsFromProto(proto)->state, MissionState::kElsewhere);
  EXPECT_EQ(DetailsFromProto(proto)->node, "n2");
}

TEST(MissionMessagesTest, AFieldThatCannotBeReadIsNamed) {
  v1::Mission proto = House();
  proto.set_name("house");
  EXPECT_EQ(FieldViolations(DetailsFromProto(proto).status()).at(0).field, "mission.name");
  proto = House();
  proto.clear_phase();
  EXPECT_EQ(FieldViolations(DetailsFromProto(proto).status()).at(0).field, "mission.phase");
}

TEST(MissionMessagesTest, EveryKindOfEventIsKnown) {
  const auto* kinds = v1::MissionEventKind_descriptor();
  for (int i = 1; i < kinds->value_count(); ++i) {
    v1::MissionEvent proto;
    proto.set_kind(static_cast<v1::MissionEventKind>(kinds->value(i)->number()));
    const auto event = EventFromProto(proto);
    ASSERT_TRUE(event.ok()) << event.status();
    EXPECT_NE(event->kind, MissionEventKind::kUnknown) << kinds->value(i)->name();
    EXPECT_EQ(ToProto(event->kind), proto.kind());
  }
}

TEST(MissionMessagesTest, AnEventIsReadWhole) {
  v1::MissionEvent proto;
  proto.set_number(4);
  proto.set_robot("missions/house/robots/scout");
  proto.set_sample_time_ns(123);
  proto.set_summary("scan 1");
  constexpr int kOfAnotherDay = 99;
  proto.set_kind(static_cast<v1::MissionEventKind>(kOfAnotherDay));
  EXPECT_EQ(*EventFromProto(proto),
            (MissionEvent{4, MissionEventKind::kUnknown, "scout", 123, "scan 1"}));
  EXPECT_EQ(*EventFromProto(v1::MissionEvent()), MissionEvent());
}

TEST(MissionMessagesTest, RetentionsHaveTheirNames) {
  EXPECT_EQ(ToProto(EventRetention::kAll), v1::EVENT_RETENTION_ALL);
  EXPECT_EQ(ToProto(EventRetention::kSinceSnapshot), v1::EVENT_RETENTION_SINCE_SNAPSHOT);
}

}  // namespace mission_messages_test
}  // namespace plumescout::client
