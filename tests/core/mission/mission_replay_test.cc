// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Missions in which everything happens: what was recorded of them makes them again, to the byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/mission/mission.h"
#include "tests/core/mission/eventful_mission.h"
#include "tests/core/mission/mission_tally.h"
#include "tests/core/mission/mission_variants.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_replay_test {

constexpr double kWidth_m = 5.0;
constexpr double kHeight_m = 4.0;
constexpr int kEvents = 300;
// Events between states that are saved: of any, and of those with poses in doubt.
constexpr std::size_t kStates = 150;
constexpr std::size_t kRareStates = 80;

// What missions are to come to, beside accepting events of every kind.
constexpr const char* kRefusals[] = {
    "RobotRegistered INVALID_ARGUMENT",
    "RobotRegistered FAILED_PRECONDITION",
    "RobotRegistered RESOURCE_EXHAUSTED",
    "Scan NOT_FOUND",
    "Scan ALREADY_EXISTS",
    "Scan FAILED_PRECONDITION",
    "Scan INVALID_ARGUMENT",
    "GasReading INVALID_ARGUMENT",
    "SequenceGap INVALID_ARGUMENT",
    "PoseCorrection INVALID_ARGUMENT",
    "RobotStatus INVALID_ARGUMENT",
    "PosteriorRefreshed INVALID_ARGUMENT",
    "PlanIssued INVALID_ARGUMENT",
    "PlanIssued NOT_FOUND",
    "PlanIssued ABORTED",
    "ProgressReported NOT_FOUND",
    "ProgressReported ALREADY_EXISTS",
    "ProgressReported FAILED_PRECONDITION",
    "EpochBegun INVALID_ARGUMENT",
    "EpochBegun FAILED_PRECONDITION",
    "EpochAdopted FAILED_PRECONDITION",
    "RobotRemoved NOT_FOUND",
    "ClockOffsetNoted INVALID_ARGUMENT",
    "ClockOffsetNoted NOT_FOUND",
    "HomeOrdered NOT_FOUND",
    "MapRebuildBegun FAILED_PRECONDITION",
    "MapRebuilt FAILED_PRECONDITION",
    "KeepOutChanged INVALID_ARGUMENT",
    "KeepOutChanged NOT_FOUND",
    "KeepOutChanged ALREADY_EXISTS",
    "KeepOutChanged FAILED_PRECONDITION",
};
constexpr const char* kStatesOnTheWay[] = {
    "turned suspect",
    "trusted again",
    "registered in doubt",
    "registered again",
    "frame",
    "saved with a robot in doubt",
    "saved with a rebuild due",
    "rebuild under way",
    "epoch adopted during a rebuild",
    "correction during a rebuild",
    "correction while a robot is in doubt",
    "sensor with an offset",
    "sensor that lags",
    "clock offset",
    "keep-out areas",
    "ordered home",
    "assigned plan",
    "silent",
    "complete",
};

bool SameGas(const GasField& a, const GasField& b) {
  const auto same = [](const auto& left, const auto& right) {
    return left == nullptr ? right == nullptr
                           : right != nullptr && support::SameBytes(*left, *right);
  };
  return same(a.mean_ppm, b.mean_ppm) && same(a.variance_ppm2, b.variance_ppm2) &&
         same(a.error_variance_ppm2, b.error_variance_ppm2) && a.counters == b.counters &&
         a.quality == b.quality;
}

// All that can be seen of them.
void ExpectSame(const Mission& a_mission, const Mission& b_mission) {
  ASSERT_EQ(a_mission.Digest(), b_mission.Digest());
  EXPECT_EQ(a_mission.memory_bytes(), b_mission.memory_bytes());
  ASSERT_EQ(a_mission.can_be_saved(), b_mission.can_be_saved());
  if (a_mission.can_be_saved()) {
    EXPECT_EQ(a_mission.SaveState().value(), b_mission.SaveState().value());
  }
  const auto a = a_mission.Snapshot();
  const auto b = b_mission.Snapshot();
  EXPECT_EQ(a->revision, b->revision);
  EXPECT_EQ(a->posterior_time_ns, b->posterior_time_ns);
  EXPECT_TRUE(support::SameBytes(*a->occupancy, *b->occupancy));
  EXPECT_TRUE(support::SameBytes(*a->traversable, *b->traversable));
  EXPECT_TRUE(support::SameBytes(*a->sampled, *b->sampled));
  for (std::size_t i = 0; i < a_mission.species_count(); ++i) {
    EXPECT_TRUE(SameGas(a->Gas(i), b->Gas(i))) << "gas " << i;
  }
  EXPECT_EQ(a->sensor_offsets, b->sensor_offsets);
  EXPECT_EQ(a->options->keep_out, b->options->keep_out);
  EXPECT_EQ(a->objective, b->objective);
  EXPECT_EQ(a->deadline_ns, b->deadline_ns);
  ASSERT_EQ(a_mission.RobotIds(), b_mission.RobotIds());
  for (const auto& [id, record] : a->robots) EXPECT_EQ(record.state, b->robots.at(id).state);
}

// A mission as it was recorded: its events, and some of its states.
struct Recording {
  struct Saved {
    std::size_t events = 0;  // before
    std::string state;
  };
  std::unique_ptr<Mission> mission;
  std::vector<EventBody> events;
  std::vector<Saved> saved;
};

bool IsAnyInDoubt(const Mission& mission) {
  const std::vector<RobotId> robots = mission.RobotIds();
  return std::any_of(robots.begin(), robots.end(),
                     [&](const RobotId& robot) { return mission.StateOf(robot)->frame_suspect; });
}

// Now and then, and whenever poses are in doubt.
void SaveAtTimes(Recording& recording) {
  const Mission& mission = *recording.mission;
  if (mission.rebuild() != nullptr) {
    EXPECT_EQ(mission.SaveState().status().code(), absl::StatusCode::kFailedPrecondition);
  }
  if (!mission.can_be_saved()) return;
  const std::size_t events = recording.events.size();
  const std::size_t last = recording.saved.empty() ? 0 : recording.saved.back().events;
  const bool is_rare = mission.rebuild_due() || IsAnyInDoubt(mission);
  if (events - last < (is_rare ? kRareStates : kStates)) return;
  recording.saved.push_back({events, mission.SaveState().value()});
}

// What is refused changes nothing. The mission looks at itself and computes ahead now and then, as
// those of servers do.
absl::StatusOr<Applied> Try(const EventBody& body, Recording& recording) {
  Mission& mission = *recording.mission;
  const std::size_t events = recording.events.size();
  if (events % 5 == 0) mission.Snapshot();
  if (events % 2 == 0 && mission.rebuild() != nullptr) mission.rebuild()->Recompute();
  const std::uint64_t digest = mission.Digest();
  const std::int64_t bytes = mission.memory_bytes();
  // Its digest tells of nearly everything; its whole state, which takes longer, of all.
  const bool can_be_saved = mission.can_be_saved();
  const bool saves = events % 3 == 0 && can_be_saved;
  const std::string state = saves ? mission.SaveState().value() : "";
  const auto applied = mission.Apply(body);
  if (applied.ok()) {
    recording.events.push_back(body);
    SaveAtTimes(recording);
    return applied;
  }
  EXPECT_EQ(mission.Digest(), digest) << applied.status();
  EXPECT_EQ(mission.memory_bytes(), bytes) << applied.status();
  EXPECT_EQ(mission.can_be_saved(), can_be_saved) << applied.status();
  EXPECT_TRUE(!saves || mission.SaveState().value() == state) << applied.status();
  return applied;
}

Recording Record(const MissionOptions& options, std::uint64_t seed, MissionTally& tally) {
  Recording recording{Mission::Create(options).value(), {}, {}};
  EventfulMission random(seed, kWidth_m, kHeight_m);
  for (int i = 0; i < kEvents; ++i) {
    const EventBody body = random.Next(*recording.mission);
    const MissionTally::Before before = MissionTally::Of(*recording.mission);
    const auto applied = Try(body, recording);
    tally.Add(body, before, applied, *recording.mission);
    random.Learn(body, applied);
  }
  return recording;
}

void ApplyFrom(std::size_t event, const Recording& recording, Mission& mission) {
  for (std::size_t i = event; i < recording.events.size(); ++i) {
    const auto applied = mission.Apply(recording.events[i]);
    ASSERT_TRUE(applied.ok()) << applied.status();
  }
}

void ExpectReplayed(const MissionOptions& options, const Recording& recording) {
  const auto replayed = Mission::Create(options).value();
  ApplyFrom(0, recording, *replayed);
  ExpectSame(*recording.mission, *replayed);
  for (const Recording::Saved& saved : recording.saved) {
    SCOPED_TRACE(absl::StrCat("saved after ", saved.events));
    const auto restored = Mission::Restore(options, saved.state);
    ASSERT_TRUE(restored.ok()) << restored.status();
    ApplyFrom(saved.events, recording, **restored);
    ExpectSame(*recording.mission, **restored);
  }
}

TEST(MissionReplay, MakesTheSameMissionWhateverHappened) {
  MissionTally tally;
  for (const MissionVariant& variant : MissionVariants()) {
    for (int seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(absl::StrCat(variant.name, ", seed ", seed));
      const Recording recording = Record(variant.options, seed, tally);
      EXPECT_GT(recording.saved.size(), 0U);
      ExpectReplayed(variant.options, recording);
    }
  }
  for (const std::string& what : MissionTally::AllAccepted()) EXPECT_GT(tally.Of(what), 0) << what;
  for (const char* const what : kRefusals) EXPECT_GT(tally.Of(what), 0) << what;
  for (const char* const what : kStatesOnTheWay) EXPECT_GT(tally.Of(what), 0) << what;
}

}  // namespace mission_replay_test
}  // namespace plumescout
