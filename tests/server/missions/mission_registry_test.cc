// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace mission_registry_test {

using ::testing::ElementsAre;

std::vector<MissionId> Names(const std::vector<std::shared_ptr<MissionHost>>& hosts) {
  std::vector<MissionId> names;
  for (const auto& host : hosts) names.push_back(host->id());
  return names;
}

TEST(MissionRegistryTest, MissionsAreFoundByNameUntilRemoved) {
  MissionRegistry registry({}, {});
  ASSERT_TRUE(registry.Create("hall", {}).ok());
  EXPECT_EQ(registry.Find("hall").value()->id(), "hall");
  EXPECT_TRUE(absl::IsAlreadyExists(registry.Create("hall", {}).status()));
  ASSERT_TRUE(registry.Remove("hall").ok());
  EXPECT_TRUE(absl::IsNotFound(registry.Find("hall").status()));
  EXPECT_TRUE(absl::IsNotFound(registry.Remove("hall").status()));
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

TEST(MissionRegistryTest, CellsOfAllMissionsTogetherAreBounded) {
  RegistryOptions options;
  options.max_total_cells = 25'000;
  MissionRegistry registry(options, {});
  MissionOptions mission;
  mission.occupancy.max_cell_count = 10'000;
  ASSERT_TRUE(registry.Create("a", mission).ok());
  ASSERT_TRUE(registry.Create("b", mission).ok());
  const absl::Status refused = registry.Create("c", mission).status();
  EXPECT_TRUE(absl::IsResourceExhausted(refused));
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("10000 cells, of 5000 left"));
  ASSERT_TRUE(registry.Remove("a").ok());
  EXPECT_TRUE(registry.Create("c", mission).ok());
}

TEST(MissionRegistryTest, ExtentBoundsCellsToo) {
  OccupancyOptions options;
  options.max_cell_count = 4'000'000;
  options.resolution_m = 0.1;
  options.max_extent_m = 10.0;
  EXPECT_EQ(CellBound(options), 10'000);
  options.max_extent_m = 2000.0;
  EXPECT_EQ(CellBound(options), 4'000'000);
}

TEST(MissionRegistryTest, InvalidOptionsMakeNoMission) {
  MissionRegistry registry({}, {});
  MissionOptions options;
  options.planning.strategy = "teleport";
  EXPECT_TRUE(absl::IsInvalidArgument(registry.Create("hall", options).status()));
  EXPECT_TRUE(absl::IsNotFound(registry.Find("hall").status()));
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
  registry.StopAll(absl::UnavailableError("over"));
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
  registry.StopAll(absl::UnavailableError("over"));
  EXPECT_TRUE(absl::IsResourceExhausted(pool.Submit([] {}))) << "an epoch waits in the queue";
  release.Notify();
}

}  // namespace mission_registry_test
}  // namespace plumescout::server
