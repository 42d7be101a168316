// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/recovery_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "core/types/error_reason.h"

namespace plumescout::server {
namespace recovery_list_test {

StoredMission Stored(const std::string& key, std::int64_t head) {
  return {.key = key, .epoch = 1, .head = head, .bytes = 0};
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
  const auto after = list.After("acme/hall");
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(after[0].key, "acme/yard");
  EXPECT_EQ(ErrorReason(after[0].status), reason::kRecovering);
  EXPECT_EQ(list.After("").size(), 2U);
}

TEST(RecoveryListTest, AKeyNamesMissionAndTenant) {
  EXPECT_EQ(MissionIdOf("acme/hall"), "hall");
  EXPECT_EQ(TenantOf("acme/hall"), "acme");
  EXPECT_EQ(MissionIdOf("hall"), "hall");
  EXPECT_EQ(TenantOf("hall"), "");
}

}  // namespace recovery_list_test
}  // namespace plumescout::server
