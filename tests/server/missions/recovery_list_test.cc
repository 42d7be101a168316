// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/recovery_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>

#include "core/types/error_reason.h"

namespace plumescout::server {
namespace recovery_list_test {

StoredMission Stored(const std::string& key, std::int64_t head) {
  return {.key = key, .epoch = 1, .head = head, .bytes = 0};
}

std::vector<AbsentMission> After(const RecoveryList& list, const std::string& key, int limit = 9) {
  return list.After(key, limit, [](const std::string&) { return true; });
}

TEST(RecoveryListTest, BusyMissionsComeFirstButThoseThatAreCalledForBeforeThem) {
  RecoveryList list;
  for (const auto& [key, head] : {std::pair("a", 5), {"b", 50}, {"c", 7}, {"d", 6}}) {
    list.Add(Stored(key, head));
  }
  EXPECT_EQ(list.Next(), "b");
  EXPECT_EQ(ErrorReason(list.CallFor("a")), reason::kRecovering);
  EXPECT_EQ(list.Next(), "a");
  EXPECT_EQ(list.Next(), "c");
  EXPECT_EQ(list.Next(), "d");
  EXPECT_EQ(list.Next(), std::nullopt);
  EXPECT_EQ(list.waiting(), 4) << "until they run";
  list.Erase("a");
  EXPECT_TRUE(list.CallFor("a").ok());
  EXPECT_FALSE(list.Contains("a"));
  EXPECT_EQ(list.waiting(), 3);
}

TEST(RecoveryListTest, WhatCannotBeRecoveredStaysAndSaysWhy) {
  RecoveryList list;
  list.Add(Stored("acme/hall", 5));
  list.Add(Stored("acme/yard", 5));
  list.Hold("acme/hall", absl::DataLossError("event 3"));
  EXPECT_EQ(list.CallFor("acme/hall"), absl::DataLossError("event 3"));
  EXPECT_EQ(list.held(), 1);
  EXPECT_EQ(list.waiting(), 1);
  EXPECT_EQ(list.Next(), "acme/yard");
  EXPECT_EQ(list.Next(), std::nullopt);
  const auto after = After(list, "acme/hall");
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(after[0].key, "acme/yard");
  EXPECT_EQ(ErrorReason(after[0].status), reason::kRecovering);
  EXPECT_EQ(After(list, "").size(), 2U);
}

TEST(RecoveryListTest, WhoSleepsIsLeftInPeaceUntilSomebodyCalls) {
  constexpr SteadyTime kLater = SteadyTime() + std::chrono::hours(1);
  RecoveryList list;
  list.AddAsleep({.key = "a", .epoch = 3, .head = 5, .memory_bytes = 100});
  list.AddAsleep({.key = "b", .memory_bytes = 10, .forget_at = kLater});
  EXPECT_EQ(list.asleep(), 2);
  EXPECT_EQ(list.waiting(), 0);
  EXPECT_EQ(list.Next(), std::nullopt);
  EXPECT_TRUE(After(list, "")[0].is_asleep);
  EXPECT_EQ(list.FindAsleep("a")->memory_bytes, 100);
  EXPECT_EQ(ErrorReason(list.CallFor("a")), reason::kRecovering);
  EXPECT_EQ(list.FindAsleep("a"), nullptr);
  EXPECT_FALSE(After(list, "")[0].is_asleep);
  EXPECT_EQ(list.woken(), 1);
  EXPECT_EQ(list.woken_memory_bytes(), 100);
  EXPECT_EQ(list.waiting(), 1);
  EXPECT_EQ(list.Next(), "a");
  EXPECT_TRUE(list.SleepOn("a", 4));
  EXPECT_FALSE(list.SleepOn("a", 5)) << "it sleeps";
  EXPECT_EQ(list.FindAsleep("a")->epoch, 4);
  EXPECT_EQ(list.Next(), std::nullopt) << "until somebody calls again";
  EXPECT_TRUE(list.TakeForgotten(kLater - std::chrono::nanoseconds(1)).empty());
  EXPECT_EQ(list.TakeForgotten(kLater).at(0).key, "b");
  EXPECT_EQ(list.asleep(), 1);
}

TEST(RecoveryListTest, WhatCouldNotBeRecoveredNowSleeps) {
  RecoveryList list;
  list.Add({.key = "hall", .epoch = 3, .head = 7});
  list.Add({.key = "yard"});
  list.Hold("yard", absl::DataLossError("event 3"));
  ASSERT_EQ(list.Next(), "hall");
  EXPECT_TRUE(list.SleepOn("hall", 0));
  EXPECT_FALSE(list.SleepOn("yard", 0)) << "it never can be";
  EXPECT_FALSE(list.SleepOn("attic", 0));
  EXPECT_EQ(list.Next(), std::nullopt);
  ASSERT_NE(list.FindAsleep("hall"), nullptr);
  EXPECT_EQ(list.FindAsleep("hall")->epoch, 3);
  EXPECT_EQ(list.waiting(), 0);
  EXPECT_EQ(ErrorReason(list.CallFor("hall")), reason::kRecovering);
  EXPECT_EQ(list.Next(), "hall");
  EXPECT_TRUE(list.SleepOn("hall", 4));
  EXPECT_EQ(list.FindAsleep("hall")->epoch, 4);
}

TEST(RecoveryListTest, NoMoreIsListedThanIsWanted) {
  RecoveryList list;
  for (const char* key : {"a", "b", "c", "d"}) list.Add({.key = key});
  EXPECT_EQ(After(list, "", 2).back().key, "b");
  const auto even = list.After("", 1, [](const std::string& key) { return key > "b"; });
  ASSERT_EQ(even.size(), 1U);
  EXPECT_EQ(even[0].key, "c");
}

TEST(RecoveryListTest, WhatThereIsNoRoomForSleepsAndKnowsWhy) {
  RecoveryList list;
  list.Add({.key = "hall", .epoch = 3, .head = 7});
  ASSERT_EQ(list.Next(), "hall");
  list.PutToSleep("hall", 100);
  EXPECT_EQ(list.waiting(), 0);
  EXPECT_EQ(list.Next(), std::nullopt);
  ASSERT_NE(list.FindAsleep("hall"), nullptr);
  EXPECT_EQ(list.FindAsleep("hall")->memory_bytes, 100);
  EXPECT_EQ(list.FindAsleep("hall")->epoch, 3);
  EXPECT_EQ(list.FindAsleep("hall")->head, 7);
  EXPECT_FALSE(list.CallFor("hall").ok());
  EXPECT_EQ(list.woken_memory_bytes(), 100);
  list.ForgetMemory("hall");
  EXPECT_EQ(list.woken_memory_bytes(), 0);
  EXPECT_EQ(list.Next(), "hall");
}

TEST(RecoveryListTest, AKeyNamesMissionAndTenant) {
  EXPECT_EQ(MissionIdOf("acme/hall"), "hall");
  EXPECT_EQ(TenantOf("acme/hall"), "acme");
  EXPECT_EQ(MissionIdOf("hall"), "hall");
  EXPECT_EQ(TenantOf("hall"), "");
}

}  // namespace recovery_list_test
}  // namespace plumescout::server
