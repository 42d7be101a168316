// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission registry: missions that sleep are forgotten in time, whatever happened to them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"
#include "server/missions/mission_registry.h"
#include "server/missions/standing_record.h"
#include "tests/server/held_store.h"
#include "tests/server/store/store_work.h"
#include "tests/server/stored_run.h"

namespace plumescout::server {
namespace mission_registry_sleep_test {

class MissionRegistrySleepTest : public testing::Test {
 protected:
  MissionRegistrySleepTest() { Start(); }

  // Another registry on the same store.
  void Start() {
    RegistryHooks hooks;
    hooks.store = &store_;
    hooks.clock = [this] { return now_; };
    RegistryOptions options;
    options.max_missions = 2;
    options.sleep_after = absl::Seconds(60);
    registry_ = std::make_unique<MissionRegistry>(options, hooks);
    const absl::Status found = registry_->FindStored();
    EXPECT_TRUE(found.ok()) << found;
  }
  void RecoverAll() {
    while (registry_->RecoverNext()) {
    }
  }
  // A mission of the store with so many events, which goes when nobody uses it for an hour.
  void Put(const std::string& key, std::int64_t events) {
    std::vector<Event> registered;
    for (std::int64_t number = 1; number <= events; ++number) {
      const std::string robot = absl::StrCat("r", number);
      registered.push_back({number, RobotRegistered{robot, 0.2, number}});
    }
    PutMission(store_, key, {}, registered);
    const std::string standing = EncodeStanding({.idle_time_to_live = absl::Hours(1)});
    EXPECT_TRUE(PutStandingNow(store_, key, 1, standing).ok());
  }
  // Keys of the missions that the store has once it has done what it was told so far.
  std::vector<std::string> StoredKeys() {
    EXPECT_TRUE(absl::IsNotFound(RemoveNow(store_, "last", 1)));  // its turn is after all that
    std::vector<std::string> keys;
    const auto stored = store_.List();
    for (const StoredMission& mission : *stored) keys.push_back(mission.key);
    return keys;
  }

  SteadyTime now_ = SteadyTime() + std::chrono::hours(1);
  HeldStore store_;
  std::unique_ptr<MissionRegistry> registry_;
};

TEST_F(MissionRegistrySleepTest, AMissionThatCouldNotBeWokenIsForgottenInTime) {
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  registry_->Find("hall").value()->standing().set_idle_time_to_live(absl::Hours(1));
  now_ += std::chrono::seconds(60);
  while (registry_->SleepIdle().empty()) {
  }
  ASSERT_TRUE(registry_->AwaitStopped(SteadyTime::max()));
  store_.RefuseReads(1);
  EXPECT_EQ(ErrorReason(registry_->Find("hall").status()), reason::kRecovering);
  RecoverAll();
  EXPECT_EQ(store_.Peek("hall")->epoch, 2) << "it was taken over";
  EXPECT_EQ(registry_->absent().sleeping, 1);
  now_ += std::chrono::hours(1);
  EXPECT_THAT(registry_->DeleteIdle(), testing::ElementsAre("hall"));
  EXPECT_THAT(StoredKeys(), testing::IsEmpty());
}

TEST_F(MissionRegistrySleepTest, WhatARestartLeavesAsleepIsForgottenInTime) {
  Put("busy", 3);
  Put("hall", 2);
  Put("attic", 1);
  Put("yard", 1);
  Start();
  RecoverAll();
  EXPECT_EQ(registry_->absent().sleeping, 2);
  const auto busy = registry_->Find("busy").value();
  const auto hall = registry_->Find("hall").value();
  now_ += std::chrono::hours(1) - std::chrono::nanoseconds(1);
  EXPECT_THAT(registry_->DeleteIdle(), testing::IsEmpty());
  now_ += std::chrono::nanoseconds(1);
  EXPECT_THAT(registry_->DeleteIdle(), testing::UnorderedElementsAre("attic", "yard"));
  EXPECT_THAT(StoredKeys(), testing::ElementsAre("busy", "hall"));
}

TEST_F(MissionRegistrySleepTest, WhatCannotBeRecoveredAtAStartIsForgottenInTime) {
  Put("hall", 1);
  store_.RefuseAcquisitions(1);
  Start();
  RecoverAll();
  EXPECT_EQ(registry_->absent().sleeping, 1);
  now_ += std::chrono::hours(1);
  EXPECT_THAT(registry_->DeleteIdle(), testing::ElementsAre("hall"));
  EXPECT_THAT(StoredKeys(), testing::IsEmpty());
}

TEST_F(MissionRegistrySleepTest, CallsThatWaitDoNotHaveTheStoreAskedAgainAndAgain) {
  Put("hall", 1);
  store_.RefuseAcquisitions(1);
  Start();
  int looks = 0;
  ASSERT_NE(registry_->AwaitAnswer("hall", [&] { ++looks; }), 0);
  RecoverAll();
  EXPECT_EQ(registry_->absent().sleeping, 1);
  EXPECT_EQ(looks, 0);
  EXPECT_EQ(ErrorReason(registry_->Find("hall").status()), reason::kRecovering);
  RecoverAll();
  EXPECT_EQ(looks, 1);
  EXPECT_TRUE(registry_->Find("hall").ok());
}

TEST_F(MissionRegistrySleepTest, AMissionWhoseStandingCannotBeReadIsNotForgotten) {
  PutMission(store_, "hall", {}, {{1, RobotRegistered{"r1", 0.2, 7}}});
  ASSERT_TRUE(PutStandingNow(store_, "hall", 1, "rubbish").ok());
  Put("busy", 3);
  Put("mill", 2);
  Start();
  EXPECT_EQ(registry_->absent().sleeping, 1);
  now_ += std::chrono::hours(1);
  EXPECT_THAT(registry_->DeleteIdle(), testing::IsEmpty());
  EXPECT_THAT(StoredKeys(), testing::ElementsAre("busy", "hall", "mill"));
}

}  // namespace mission_registry_sleep_test
}  // namespace plumescout::server
