// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Missions in which everything happens, made again from events that went through a journal, and
// from events that went over the wire once more.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "core/mission/mission.h"
#include "formats/journal/event_codec.h"
#include "plumescout/v1/robot_service.pb.h"
#include "proto/convert/enums.h"
#include "proto/convert/keep_out.h"
#include "proto/convert/observation.h"
#include "proto/convert/plan.h"
#include "proto/convert/robot.h"
#include "proto/convert/robot_frame.h"
#include "tests/core/mission/eventful_mission.h"
#include "tests/core/mission/mission_tally.h"
#include "tests/core/mission/mission_variants.h"

namespace plumescout {
namespace journal_replay_test {

constexpr int kEvents = 400;

absl::StatusOr<EventBody> OverWire(const ObservationReceived& received) {
  auto observation = FromProto(ToProto(received.observation), "observation");
  if (!observation.ok()) return observation.status();
  return ObservationReceived{received.robot, *std::move(observation)};
}
absl::StatusOr<EventBody> OverWire(const RobotRegistered& registered) {
  v1::RegisterRobotRequest request;
  ToProto(registered.sensors, request);
  auto frame = FromProto(ToProto(registered.frame), "frame");
  if (!frame.ok()) return frame.status();
  RobotRegistered received = registered;
  received.sensors = SensorsFromProto(request);
  received.frame = *frame;
  return received;
}
absl::StatusOr<EventBody> OverWire(const PlanIssued& issued) {
  // Nobody who could send it has such a plan.
  if (issued.plan.chosen >= static_cast<int>(issued.plan.candidates.size())) {
    return absl::InvalidArgumentError("chosen");
  }
  auto plan = FromProto(ToProto(issued.plan, "mission"), "plan");
  if (!plan.ok()) return plan.status();
  return PlanIssued{*std::move(plan), issued.assigned};
}
absl::StatusOr<EventBody> OverWire(const ProgressReported& report) {
  auto outcome = FromProto(ToProto(report.outcome), "outcome");
  if (!outcome.ok()) return outcome.status();
  return ProgressReported{report.robot, report.plan_id, *outcome};
}
absl::StatusOr<EventBody> OverWire(const KeepOutChanged& change) {
  auto received = FromProto(ToProto(change));
  if (!received.ok()) return received.status();
  return EventBody(*std::move(received));
}
template <typename Body>
absl::StatusOr<EventBody> OverWire(const Body& body) {  // says nothing that is converted
  return EventBody(body);
}
absl::StatusOr<EventBody> SentAgain(const EventBody& body) {
  return std::visit([](const auto& of_kind) { return OverWire(of_kind); }, body);
}

// Random events as they come over the wire, which refuses some that no mission would take.
std::vector<Event> Record(std::uint64_t seed, Mission& mission, MissionTally& tally) {
  std::vector<Event> events;
  EventfulMission random(seed, 5.0, 4.0);
  for (int i = 0; i < kEvents; ++i) {
    const auto body = SentAgain(random.Next(mission));
    if (!body.ok()) continue;
    const MissionTally::Before before = MissionTally::Of(mission);
    const auto applied = mission.Apply(*body);
    tally.Add(*body, before, applied, mission);
    random.Learn(*body, applied);
    if (applied.ok()) events.push_back({applied->revision, *body});
  }
  return events;
}

// Of what a journal keeps for replays.
void ExpectReplayed(const MissionOptions& options, const std::vector<Event>& events,
                    const Mission& expected) {
  const auto mission = Mission::Create(options).value();
  for (const Event& event : events) {
    const auto kept = DecodeEvent(EncodeEvent(event, PlanDetail::kForReplay));
    ASSERT_TRUE(kept.ok()) << kept.status();
    const auto applied = mission->Apply(kept->body);
    ASSERT_TRUE(applied.ok()) << applied.status();
    ASSERT_EQ(applied->revision, kept->number);
  }
  EXPECT_EQ(mission->Digest(), expected.Digest());
  ASSERT_EQ(mission->can_be_saved(), expected.can_be_saved());
  if (expected.can_be_saved()) {
    EXPECT_EQ(mission->SaveState().value(), expected.SaveState().value());
  }
}

// Bytes are compared, for a range may be no number.
void ExpectUnchanged(const Event& event) {
  const std::string bytes = EncodeEvent(event);
  const auto decoded = DecodeEvent(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(decoded->number, event.number);
  EXPECT_EQ(EncodeEvent(*decoded), bytes);
  const auto sent = SentAgain(event.body);
  ASSERT_TRUE(sent.ok()) << sent.status();
  EXPECT_EQ(EncodeEvent({event.number, *sent}), bytes) << "of kind " << event.body.index();
}

TEST(JournalReplay, EventsOfEveryKindMakeTheSameMission) {
  MissionTally tally;
  for (const MissionVariant& variant : MissionVariants()) {
    SCOPED_TRACE(variant.name);
    const auto mission = Mission::Create(variant.options).value();
    const std::vector<Event> events = Record(11, *mission, tally);
    ExpectReplayed(variant.options, events, *mission);
    for (const Event& event : events) ExpectUnchanged(event);
  }
  for (const std::string& what : MissionTally::AllAccepted()) EXPECT_GT(tally.Of(what), 0) << what;
}

}  // namespace journal_replay_test
}  // namespace plumescout
