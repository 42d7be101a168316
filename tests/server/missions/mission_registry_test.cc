// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "core/types/error_reason.h"
#include "tests/server/host_parts.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace mission_registry_test {

using ::testing::ElementsAre;

std::vector<MissionId> Names(const std::vector<std::shared_ptr<MissionHost>>& hosts) {
  std::vector<MissionId> names;
  for (const auto& host : hosts) names.push_back(host->id());
  return names;
}

// Returns once every command posted before has run.
void Settle(MissionHost& host) {
  absl::Notification done;
  ASSERT_TRUE(host.Post([&](MissionWriter&) { done.Notify(); }).ok());
  done.WaitForNotification();
}

TEST(MissionRegistryTest, MissionsAreFoundByNameUntilDeleted) {
  MissionRegistry registry({}, {});
  ASSERT_TRUE(registry.Create("hall", {}).ok());
  EXPECT_EQ(registry.Find("hall").value()->id(), "hall");
  EXPECT_TRUE(absl::IsAlreadyExists(registry.Create("hall", {}).status()));
  ASSERT_TRUE(registry.Delete("hall").ok());
  EXPECT_TRUE(absl::IsNotFound(registry.Find("hall").status()));
  EXPECT_TRUE(absl::IsNotFound(registry.Delete("hall")));
}

TEST(MissionRegistryTest, EachTenantHasNamesOfItsOwn) {
  MissionRegistry registry({}, {});
  ASSERT_TRUE(registry.Create("hall", {}, {"alice", "acme"}).ok());
  EXPECT_TRUE(absl::IsAlreadyExists(registry.Create("hall", {}, {"ann", "acme"}).status()));
  EXPECT_TRUE(absl::IsNotFound(registry.Find("hall", "other").status()));
  ASSERT_TRUE(registry.Create("hall", {}, {"bob", "other"}).ok());
  EXPECT_EQ(registry.Find("hall", "acme").value()->owner(), "alice");
  EXPECT_EQ(registry.Find("hall", "other").value()->owner(), "bob");
  EXPECT_TRUE(absl::IsNotFound(registry.Find("hall").status()));
  EXPECT_TRUE(absl::IsFailedPrecondition(registry.FindOfAnyTenant("hall").status()));
  EXPECT_TRUE(absl::IsNotFound(registry.Delete("hall")));
  ASSERT_TRUE(registry.Delete("hall", "acme").ok());
  EXPECT_EQ(registry.FindOfAnyTenant("hall").value()->owner(), "bob");
  EXPECT_TRUE(absl::IsNotFound(registry.FindOfAnyTenant("attic").status()));
}

TEST(MissionRegistryTest, ANameThatIsHeldIsNobodyElses) {
  MemoryStore store(/*is_durable=*/true);
  RegistryHooks hooks;
  hooks.store = &store;
  MissionRegistry registry({}, hooks);
  const std::string key = MissionKey("", "hall");
  auto name = registry.HoldName(key);
  ASSERT_TRUE(name.ok()) << name.status();
  EXPECT_EQ(ErrorReason(registry.Create("hall", {}).status()), reason::kMissionExists);
  EXPECT_EQ(ErrorReason(registry.Recover(key)), reason::kMissionExists);
  EXPECT_EQ(ErrorReason(registry.HoldName(key).status()), reason::kMissionExists);
  EXPECT_TRUE(absl::IsNotFound(registry.Recover(key, /*holds_name=*/true)));
  *name = nullptr;
  EXPECT_TRUE(registry.Create("hall", {}).ok());
}

TEST(MissionRegistryTest, ListGoesOnAfterAName) {
  MissionRegistry registry({}, {});
  for (const char* id : {"c", "a", "b"}) ASSERT_TRUE(registry.Create(id, {}).ok());
  EXPECT_THAT(Names(registry.List("", 2)), ElementsAre("a", "b"));
  EXPECT_THAT(Names(registry.List("b", 2)), ElementsAre("c"));
  EXPECT_THAT(Names(registry.List("bb", 2)), ElementsAre("c"));
}

TEST(MissionRegistryTest, NumberOfMissionsIsBounded) {
  RegistryOptions options;
  options.max_missions = 2;
  MissionRegistry registry(options, {});
  ASSERT_TRUE(registry.Create("a", {}).ok());
  ASSERT_TRUE(registry.Create("b", {}).ok());
  EXPECT_TRUE(absl::IsResourceExhausted(registry.Create("c", {}).status()));
}

constexpr std::int64_t kMegabyte = 1'000'000;

TEST(MissionRegistryTest, MissionsChooseNothingBeyondTheServersLimits) {
  RegistryOptions options;
  options.mission_memory_budget_bytes = 50 * kMegabyte;
  options.max_map_cell_count = 5000;
  options.max_beam_count = 100;
  options.max_range_m = 20.0;
  MissionRegistry registry(options, {});
  MissionOptions least;
  least.memory_budget_bytes = 50 * kMegabyte;
  least.occupancy.max_cell_count = 5000;
  least.max_beam_count = 100;
  least.max_range_m = 20.0;
  EXPECT_TRUE(registry.Create("least", least).ok());
  const auto refusal = [&](const auto& change) {
    MissionOptions mission = least;
    change(mission);
    const absl::Status status = registry.Create("more", mission).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    return std::string(status.message());
  };
  EXPECT_THAT(refusal([](MissionOptions& m) { ++m.memory_budget_bytes; }),
              testing::StartsWith("memory_budget_bytes = "));
  EXPECT_THAT(refusal([](MissionOptions& m) { ++m.occupancy.max_cell_count; }),
              testing::StartsWith("occupancy.max_cell_count = 5001 must be at most"));
  EXPECT_THAT(refusal([](MissionOptions& m) { ++m.max_beam_count; }),
              testing::StartsWith("max_beam_count = 101 must be at most"));
  EXPECT_THAT(refusal([](MissionOptions& m) { m.max_range_m = 20.5; }),
              testing::StartsWith("max_range_m = 20.5 must be at most"));
}

TEST(MissionRegistryTest, InvalidOptionsMakeNoMission) {
  MissionRegistry registry({}, {});
  MissionOptions options;
  options.planning.strategy = "teleport";
  EXPECT_TRUE(absl::IsInvalidArgument(registry.Create("hall", options).status()));
  EXPECT_TRUE(absl::IsNotFound(registry.Find("hall").status()));
}

// While one mission is being made, others are found and made, and its name is taken.
TEST(MissionRegistryTest, MakingAMissionHoldsUpNobodyElse) {
  absl::Notification begun;
  absl::Notification go_on;
  RegistryHooks hooks;
  hooks.make_event_sink = [&](const MissionId& id, const MissionOptions&) -> EventSink {
    if (id == "slow") {
      begun.Notify();
      go_on.WaitForNotification();
    }
    return nullptr;
  };
  RegistryOptions options;
  options.max_missions = 3;
  MissionRegistry registry(options, hooks);
  ASSERT_TRUE(registry.Create("hall", {}).ok());
  absl::Status slow;
  std::thread maker([&] { slow = registry.Create("slow", {}).status(); });
  begun.WaitForNotification();
  EXPECT_TRUE(registry.Find("hall").ok());
  EXPECT_TRUE(absl::IsNotFound(registry.Find("slow").status()));
  EXPECT_TRUE(absl::IsAlreadyExists(registry.Create("slow", {}).status()));
  EXPECT_TRUE(registry.Create("attic", {}).ok());
  EXPECT_TRUE(absl::IsResourceExhausted(registry.Create("yard", {}).status()));
  go_on.Notify();
  maker.join();
  EXPECT_TRUE(slow.ok()) << slow;
  EXPECT_TRUE(registry.Find("slow").ok());
}

TEST(MissionRegistryTest, MissionThatIsMadeWhileAllAreStoppedIsStoppedToo) {
  absl::Notification begun;
  absl::Notification go_on;
  RegistryHooks hooks;
  hooks.make_event_sink = [&](const MissionId&, const MissionOptions&) -> EventSink {
    begun.Notify();
    go_on.WaitForNotification();
    return nullptr;
  };
  MissionRegistry registry({}, hooks);
  absl::Status late;
  std::thread maker([&] { late = registry.Create("hall", {}).status(); });
  begun.WaitForNotification();
  registry.StopAll(absl::UnavailableError("over"));
  go_on.Notify();
  maker.join();
  EXPECT_TRUE(absl::IsUnavailable(late)) << late;
  EXPECT_TRUE(absl::IsNotFound(registry.Find("hall").status()));
  EXPECT_TRUE(absl::IsUnavailable(registry.Create("attic", {}).status()));
}

TEST(MissionRegistryTest, MissionThatCannotBeMadeLeavesItsRoom) {
  RegistryOptions options;
  options.max_missions = 1;
  MissionRegistry registry(options, {});
  MissionOptions wrong;
  wrong.planning.strategy = "teleport";
  EXPECT_FALSE(registry.Create("hall", wrong).ok());
  EXPECT_TRUE(registry.Create("hall", {}).ok());
}

TEST(MissionRegistryTest, SinkHearsTheEventsOfItsMission) {
  std::vector<std::string> heard;
  RegistryHooks hooks;
  hooks.make_event_sink = [&](const MissionId& id, const MissionOptions&) {
    return [&heard, id](const Event& event) { heard.push_back(absl::StrCat(id, event.number)); };
  };
  MissionRegistry registry({}, hooks);
  const auto host = registry.Create("hall", {}).value();
  ASSERT_TRUE(host->Post([](MissionWriter& writer) {
                    EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, 1}).ok());
                  })
                  .ok());
  Settle(*host);
  registry.StopAll(absl::UnavailableError("over"));
  EXPECT_TRUE(registry.AwaitStopped(SteadyTime::max()));
  EXPECT_THAT(heard, ElementsAre("hall1"));
}

TEST(MissionRegistryTest, MissionsRecomputeOnThePoolGiven) {
  absl::Notification occupied;
  absl::Notification release;
  WorkerPool pool({"epoch", 1, 1});
  ASSERT_TRUE(pool.Submit([&] {
                    occupied.Notify();
                    release.WaitForNotification();
                  })
                  .ok());
  occupied.WaitForNotification();
  RegistryHooks hooks;
  hooks.epoch_pool = &pool;
  MissionRegistry registry({}, hooks);
  const auto host = registry.Create("hall", support::FastAgeing()).value();
  ASSERT_TRUE(host->Post([&](MissionWriter& writer) {
                    EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, 1}).ok());
                    EXPECT_TRUE(writer.conduct().Ingest("r1", 1, RoomRunBatch()).status.ok());
                  })
                  .ok());
  Settle(*host);
  registry.StopAll(absl::UnavailableError("over"));
  EXPECT_TRUE(registry.AwaitStopped(SteadyTime::max()));
  EXPECT_TRUE(absl::IsResourceExhausted(pool.Submit([] {}))) << "an epoch waits in the queue";
  release.Notify();
}

TEST(MissionRegistryTest, DeleteWaitsForNobodyAndItsRoomIsFreeWhenTheMissionHasStopped) {
  absl::Notification busy;
  absl::Notification release;
  absl::Notification dropped;
  absl::Notification stopped;
  RegistryOptions options;
  options.max_missions = 1;
  MissionRegistry registry(options, {});
  {
    const auto host = registry.Create("hall", {}).value();
    ASSERT_TRUE(host->Post([&](MissionWriter&) {
                      busy.Notify();
                      release.WaitForNotification();
                    })
                    .ok());
    busy.WaitForNotification();
    ASSERT_TRUE(host->Post([](MissionWriter&) { ADD_FAILURE() << "it was to be dropped"; },
                           [&](const absl::Status& status) {
                             EXPECT_TRUE(absl::IsNotFound(status));
                             dropped.Notify();
                           })
                    .ok());
  }
  ASSERT_TRUE(registry.Delete("hall", "", [&](const absl::Status&) { stopped.Notify(); }).ok());
  dropped.WaitForNotification();
  EXPECT_TRUE(absl::IsNotFound(registry.Find("hall").status()));
  EXPECT_TRUE(absl::IsResourceExhausted(registry.Create("attic", {}).status()));
  EXPECT_FALSE(stopped.HasBeenNotified());
  release.Notify();
  stopped.WaitForNotification();
  EXPECT_TRUE(registry.Create("attic", {}).ok());
}

TEST(MissionRegistryTest, NoMissionIsMadeOnceWaitsHaveEnded) {
  MissionRegistry registry({}, {});
  const auto host = registry.Create("hall", {}).value();
  absl::Status heard;
  host->end_listeners().Add([&](const absl::Status& status) { heard = status; });
  registry.EndWaits(absl::UnavailableError("draining"));
  EXPECT_TRUE(absl::IsUnavailable(heard));
  EXPECT_TRUE(absl::IsUnavailable(registry.Create("attic", {}).status()));
}

TEST(MissionRegistryTest, MissionsThatNobodyUsesAreRemovedInTime) {
  SteadyTime now = SteadyTime() + std::chrono::hours(1);
  RegistryOptions options;
  options.host.clock = [&] { return now; };
  MissionRegistry registry(options, {});
  for (const char* id : {"a", "b", "c"}) {
    registry.Create(id, {}).value()->standing().set_idle_time_to_live(absl::Seconds(10));
  }
  ASSERT_TRUE(registry.Create("d", {}).ok());
  auto held = registry.Find("b").value();
  now += std::chrono::seconds(9);
  registry.Find("c").value()->standing().Touch();
  EXPECT_TRUE(registry.DeleteIdle().empty());
  now += std::chrono::seconds(1);
  EXPECT_THAT(registry.DeleteIdle(), ElementsAre("a"));
  EXPECT_THAT(Names(registry.List("", 9)), ElementsAre("b", "c", "d"));
  held.reset();  // it was in use until now
  now += std::chrono::seconds(9);
  EXPECT_THAT(registry.DeleteIdle(), ElementsAre("c"));
  now += std::chrono::seconds(1);
  EXPECT_THAT(registry.DeleteIdle(), ElementsAre("b"));
  EXPECT_THAT(Names(registry.List("", 9)), ElementsAre("d"));
}

}  // namespace mission_registry_test
}  // namespace plumescout::server
