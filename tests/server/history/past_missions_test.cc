// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/past_missions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/server/history/past_run.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace past_missions_test {

class PastMissionsTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(registry_.Recover("hall").ok());
    host_ = *registry_.Find("hall");
  }
  absl::StatusOr<PastMission> Make(std::int64_t revision, PastUse use = PastUse::kMap,
                                   const StopFn& stop = NeverStop()) {
    return past_.Make(*host_, revision, "revision", use, stop);
  }
  static RegistryHooks Hooks(MissionStore* store) {
    RegistryHooks hooks;
    hooks.store = store;
    return hooks;
  }

  const std::int64_t mission_bytes_ = MissionOptions{}.memory_budget_bytes;

  MemoryStore store_{/*is_durable=*/true};
  const PastRun run_ = StoreRun(store_);
  MissionRegistry registry_{WithMemory(3 * mission_bytes_), Hooks(&store_)};
  PastMissions past_{&store_, &registry_};
  std::shared_ptr<MissionHost> host_;
};

TEST_F(PastMissionsTest, MissionIsAsItWas) {
  for (const std::int64_t revision : {std::int64_t{0}, std::int64_t{1}, run_.revision()}) {
    const auto past = Make(revision);
    ASSERT_TRUE(past.ok()) << past.status();
    EXPECT_EQ(past->mission->revision(), revision);
  }
  EXPECT_EQ(Make(run_.revision())->mission->Digest(), run_.digest);
}

TEST_F(PastMissionsTest, WhatHasNotBeenIsRefusedByName) {
  EXPECT_THAT(Make(run_.revision() + 1).status(), IsNotYet("revision"));
  EXPECT_THAT(Make(-1).status(), Blames("revision"));
}

TEST_F(PastMissionsTest, EachUseHasOneAtATime) {
  const auto first = Make(1);
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_THAT(std::string(Make(2).status().message()), testing::HasSubstr("OVERLOADED"));
  EXPECT_TRUE(Make(2, PastUse::kReplay).ok());
}

TEST_F(PastMissionsTest, MemoryIsCountedWithThatOfMissions) {
  const auto room = registry_.HoldRoom(2 * mission_bytes_);
  ASSERT_TRUE(room.ok()) << room.status();
  EXPECT_THAT(std::string(Make(1).status().message()), testing::HasSubstr("LIMIT_REACHED"));
}

TEST_F(PastMissionsTest, RoomIsFreeAfterwards) {
  ASSERT_TRUE(Make(1).ok());
  EXPECT_TRUE(registry_.HoldRoom(2 * mission_bytes_).ok());
  EXPECT_TRUE(absl::IsCancelled(Make(5, PastUse::kMap, [] { return true; }).status()));
  EXPECT_TRUE(registry_.HoldRoom(2 * mission_bytes_).ok());
}

}  // namespace past_missions_test
}  // namespace plumescout::server
