// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_recovery.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "absl/synchronization/notification.h"
#include "server/missions/mission_snapshot.h"
#include "tests/server/store/store_work.h"
#include "tests/server/stored_run.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace mission_recovery_test {

constexpr std::int64_t kNow = std::numeric_limits<std::int64_t>::max();
constexpr char kKey[] = "acme/hall";

std::unique_ptr<Mission> AfterEvents(const MissionOptions& options,
                                     const std::vector<Event>& events, std::size_t count) {
  auto mission = std::make_unique<Mission>(options);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_TRUE(mission->Apply(events[i].body).ok());
  }
  return mission;
}

TEST(MissionRecoveryTest, TheOptionsAreThoseThatTheMissionHad) {
  MissionOptions options = support::FastAgeing();
  options.seed = 77;
  options.planning.strategy = "xit_gff";
  options.keep_out = {Polygon{{{0.1, 0.2}, {1.0, 0.0}, {1.0, 1.0}}}};
  const auto start = DecodeStart(EncodeMissionStart({"", "", "hall", "ann"}, options));
  ASSERT_TRUE(start.ok()) << start.status();
  EXPECT_EQ(start->owner, "ann");
  const auto back = OptionsOf(*start);
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->seed, 77U);
  EXPECT_EQ(back->gas.ageing_half_life_s, 60.0);
  EXPECT_EQ(back->planning.strategy, "xit_gff");
  EXPECT_EQ(EncodeMissionStart({}, *back), EncodeMissionStart({}, options));
  EXPECT_TRUE(absl::IsDataLoss(OptionsOf({"", "\xff"}).status()));
}

TEST(MissionRecoveryTest, TheMissionStandsWhereItsEventsLeftIt) {
  const MissionOptions options = support::FastAgeing();
  const std::vector<Event> events = RoomRunEvents(options);
  MemoryStore store(/*is_durable=*/true);
  PutMission(store, kKey, options, events);
  const auto recovered = RecoverMission(store, kKey, NeverStop());
  ASSERT_TRUE(recovered.ok()) << recovered.status();
  EXPECT_EQ(recovered->epoch, 2);
  EXPECT_EQ(recovered->head, static_cast<std::int64_t>(events.size()));
  EXPECT_EQ(recovered->standing, StandingRecord{});
  const auto straight = AfterEvents(options, events, events.size());
  ExpectSameMission(*recovered->mission->Snapshot(), *straight->Snapshot());
  EXPECT_EQ(recovered->mission->LeaseToken("r1").value(), 7);
}

TEST(MissionRecoveryTest, AnyRevisionCanBeLookedAtWhileOthersWrite) {
  const MissionOptions options = support::FastAgeing();
  const std::vector<Event> events = RoomRunEvents(options);
  MemoryStore store(/*is_durable=*/true);
  PutMission(store, kKey, options, events);
  for (const std::size_t revision : {std::size_t{0}, std::size_t{1}, events.size() / 2}) {
    const auto mission = MissionAt(store, kKey, static_cast<std::int64_t>(revision), NeverStop());
    ASSERT_TRUE(mission.ok()) << mission.status();
    ExpectSameMission(*(*mission)->Snapshot(), *AfterEvents(options, events, revision)->Snapshot());
  }
  EXPECT_EQ(MissionAt(store, kKey, kNow, NeverStop()).value()->revision(),
            static_cast<std::int64_t>(events.size()));
  EXPECT_EQ(store.Peek(kKey)->epoch, 1) << "nothing was taken over";
  EXPECT_TRUE(absl::IsOutOfRange(
      MissionAt(store, kKey, static_cast<std::int64_t>(events.size()) + 1, NeverStop()).status()));
  EXPECT_TRUE(absl::IsNotFound(MissionAt(store, "attic", kNow, NeverStop()).status()));
}

TEST(MissionRecoveryTest, ARecordThatCannotBeReadOrAppliedIsNamed) {
  MemoryStore store(/*is_durable=*/true);
  const std::vector<Event> events = {{1, RobotRegistered{"r1", 0.2, 7}},
                                     {2, RobotRemoved{"r2"}},  // whom nobody knows
                                     {3, RobotRegistered{"r3", 0.2, 8}}};
  PutMission(store, "unknown", {}, events);
  const absl::Status refused = RecoverMission(store, "unknown", NeverStop()).status();
  EXPECT_TRUE(absl::IsDataLoss(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("mission unknown, event 2: "));

  absl::Notification durable;
  ASSERT_TRUE(store.Create("spoilt", EncodeMissionStart({}, {})).ok());
  store.Append("spoilt", 1, 1, {"rubbish"}, [&](const absl::Status&) { durable.Notify(); });
  durable.WaitForNotification();
  EXPECT_TRUE(absl::IsDataLoss(RecoverMission(store, "spoilt", NeverStop()).status()));
  ASSERT_TRUE(store.Create("headless", "rubbish").ok());
  EXPECT_TRUE(absl::IsDataLoss(RecoverMission(store, "headless", NeverStop()).status()));
}

TEST(MissionRecoveryTest, AnImportThatDidNotEndIsNoMission) {
  MemoryStore store(/*is_durable=*/true);
  JournalStart start{"", "", "hall", "ann"};
  start.last_number = 7;
  ASSERT_TRUE(store.Create(kKey, EncodeMissionStart(start, {})).ok());
  ASSERT_TRUE(IsUnfinishedImport(*store.Peek(kKey)));
  const absl::Status refused = RecoverMission(store, kKey, NeverStop()).status();
  EXPECT_TRUE(absl::IsDataLoss(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("import that did not end"));
}

TEST(MissionRecoveryTest, StopsWhenTold) {
  MemoryStore store(/*is_durable=*/true);
  PutMission(store, kKey, {}, {{1, RobotRegistered{"r1", 0.2, 7}}});
  EXPECT_TRUE(absl::IsCancelled(RecoverMission(store, kKey, [] { return true; }).status()));
}

TEST(MissionRecoveryTest, TheMissionStandsThereAlsoIfEventsWereTrimmed) {
  const MissionOptions options = support::FastAgeing();
  const std::vector<Event> events = RoomRunEvents(options);
  MemoryStore store(/*is_durable=*/true);
  PutMission(store, kKey, options, events);
  Mission straight(options);
  std::vector<std::int64_t> saved;
  for (const Event& event : events) {
    ASSERT_TRUE(straight.Apply(event.body).ok());
    if (!std::holds_alternative<EpochAdopted>(event.body) || !straight.can_be_saved()) continue;
    saved.push_back(straight.revision());
    const auto state = straight.SaveState();
    ASSERT_TRUE(state.ok()) << state.status();
    ASSERT_TRUE(
        PutSnapshotNow(store, kKey, 1, PackSnapshot(straight.revision(), straight.Digest(), *state))
            .ok());
  }
  ASSERT_GE(saved.size(), 2U);
  ASSERT_TRUE(TrimNow(store, kKey, 1).ok());
  const std::int64_t older = saved[saved.size() - 2];
  ASSERT_EQ(store.Peek(kKey)->first, older + 1);

  EXPECT_EQ(MissionAt(store, kKey, older, NeverStop()).value()->revision(), older);
  EXPECT_TRUE(absl::IsOutOfRange(MissionAt(store, kKey, older - 1, NeverStop()).status()));
  const auto recovered = RecoverMission(store, kKey, NeverStop());
  ASSERT_TRUE(recovered.ok()) << recovered.status();
  EXPECT_EQ(recovered->mission->Digest(), straight.Digest());

  // Without a snapshot that serves there is no way back.
  const std::int64_t epoch = recovered->epoch;
  for (const std::int64_t revision : {saved.back(), saved.back() + 1}) {
    ASSERT_TRUE(PutSnapshotNow(store, kKey, epoch, {revision, 0, "rubbish"}).ok());
  }
  EXPECT_TRUE(absl::IsDataLoss(RecoverMission(store, kKey, NeverStop()).status()));
}

}  // namespace mission_recovery_test
}  // namespace plumescout::server
