// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission registry: missions that outlive it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "absl/synchronization/notification.h"
#include "core/types/error_reason.h"
#include "server/missions/mission_registry.h"
#include "tests/server/held_store.h"
#include "tests/server/host_parts.h"
#include "tests/server/stored_run.h"

namespace plumescout::server {
namespace mission_registry_recovery_test {

class MissionRegistryRecoveryTest : public testing::Test {
 protected:
  MissionRegistryRecoveryTest() { Restart(); }

  // Another registry on the same store, which knows its missions.
  void Restart() {
    if (registry_ != nullptr) {
      registry_->StopAll(absl::UnavailableError("over"));
      EXPECT_TRUE(registry_->AwaitStopped(SteadyTime::max()));
      EXPECT_TRUE(registry_->AwaitStored(SteadyTime::max()));
    }
    RegistryHooks hooks;
    hooks.store = &store_;
    hooks.clock = [this] { return now_; };
    hooks.snapshot_pool = &snapshot_pool_;
    RegistryOptions options;
    options.max_missions = 2;
    options.memory_budget_bytes = budget_bytes_;
    options.max_missions_per_tenant = max_per_tenant_;
    options.sleep_after = absl::Seconds(60);
    registry_ = std::make_unique<MissionRegistry>(options, hooks);
    const absl::Status found = registry_->FindStored();
    EXPECT_TRUE(found.ok()) << found;
  }
  void RecoverAll() {
    while (registry_->RecoverNext()) {
    }
  }
  // Runs on the writer's thread; returns when what it did is durable.
  absl::Status Do(MissionHost& host, const std::function<void(MissionWriter&)>& work) {
    absl::Notification durable;
    absl::Status result;
    EXPECT_TRUE(host.Post([&](MissionWriter& writer) {
                      work(writer);
                      host.WhenDurable([&](const absl::Status& status) {
                        result = status;
                        durable.Notify();
                      });
                    })
                    .ok());
    durable.WaitForNotification();
    return result;
  }

  // Has the missions that are idle sleep; returns how many.
  int SleepAll() {
    std::size_t slept = registry_->SleepIdle().size();
    // What the writers have to see to first, they do soon.
    while (!registry_->List("", 1).empty()) slept += registry_->SleepIdle().size();
    EXPECT_TRUE(registry_->AwaitStopped(SteadyTime::max()));
    return static_cast<int>(slept);
  }

  SteadyTime now_ = SteadyTime() + std::chrono::hours(1);
  std::int64_t budget_bytes_ = RegistryOptions().memory_budget_bytes;
  int max_per_tenant_ = 0;
  HeldStore store_;
  WorkerPool snapshot_pool_{{"snapshot", 1, 4}};
  std::unique_ptr<MissionRegistry> registry_;
};

TEST_F(MissionRegistryRecoveryTest, MissionsComeBackAsTheyWere) {
  std::shared_ptr<const Belief> before;
  std::int64_t token = 0;
  PlanId plan = 0;
  {
    const auto host = registry_->Create("hall", support::FastAgeing(), {"ann", "acme"}).value();
    EXPECT_TRUE(Do(*host, [&](MissionWriter& writer) {
                  token = writer.conduct().Register({"r1", 0.2}, host->leases())->lease_token;
                  EXPECT_TRUE(writer.conduct().Ingest("r1", token, RoomRunBatch()).status.ok());
                  plan = *writer.conduct().Commit(PlanTo(*writer.conduct().Snapshot(), "r1", 1.0),
                                                  token);
                  before = writer.conduct().Snapshot();
                }).ok());
    ASSERT_TRUE(host->standing().Pause().ok());
    host->standing().set_idle_time_to_live(absl::Hours(1));
    host->KeepStanding();
    EXPECT_EQ(host->journal().durable_revision(), before->revision);
  }
  EXPECT_EQ(plan, 1);
  Restart();
  EXPECT_EQ(ErrorReason(registry_->Find("hall", "acme").status()), reason::kRecovering);
  EXPECT_EQ(ErrorReason(registry_->FindOfAnyTenant("hall").status()), reason::kRecovering);
  EXPECT_TRUE(
      absl::IsAlreadyExists(registry_->Create("hall", MissionOptions{}, {"ann", "acme"}).status()));
  EXPECT_EQ(registry_->absent().recovering, 1);
  RecoverAll();
  EXPECT_EQ(registry_->absent().recovering, 0);
  const auto host = registry_->Find("hall", "acme");
  ASSERT_TRUE(host.ok()) << host.status();
  EXPECT_EQ((*host)->owner(), "ann");
  EXPECT_EQ((*host)->standing().state(), MissionState::kPaused);
  EXPECT_EQ((*host)->standing().idle_time_to_live(), absl::Hours(1));
  EXPECT_TRUE((*host)->leases().Use("r1", token).ok()) << "the robot goes on as before";
  EXPECT_EQ((*host)->leases().Standing("r1"), (LeaseStanding{true, false}));
  EXPECT_TRUE(
      Do(**host, [&](MissionWriter& writer) {
        ExpectSameMission(*writer.conduct().Snapshot(), *before);
        EXPECT_EQ(*writer.conduct().Commit(PlanTo(*writer.conduct().Snapshot(), "r1", 1.0), token),
                  plan + 1);
        const auto newer = writer.conduct().Register({"r1", 0.2, true}, (*host)->leases());
        EXPECT_GT(newer->lease_token, token);
        EXPECT_LT(newer->lease_token, kLeaseTokenEnd);
      }).ok());
}

TEST_F(MissionRegistryRecoveryTest, ALeaseThatWasGivenUpStaysSo) {
  std::int64_t token = 0;
  {
    const auto host = registry_->Create("hall", {}).value();
    EXPECT_TRUE(Do(*host, [&](MissionWriter& writer) {
                  token = writer.conduct().Register({"r1", 0.2}, host->leases())->lease_token;
                }).ok());
    ASSERT_TRUE(host->leases().Release("r1", token).ok());
    host->KeepStanding();
  }
  Restart();
  RecoverAll();
  const auto host = registry_->Find("hall").value();
  EXPECT_EQ(ErrorReason(host->leases().Use("r1", token)), reason::kLeaseSuperseded);
  EXPECT_EQ(host->leases().Standing("r1"), LeaseStanding{});
}

TEST_F(MissionRegistryRecoveryTest, ADamagedMissionIsHeldAndOthersGoOn) {
  PutMission(store_, "acme/bad", {}, {{1, RobotRemoved{"r1"}}});  // who was never there
  ASSERT_TRUE(registry_->Create("good", {}).ok());
  Restart();
  RecoverAll();
  EXPECT_TRUE(registry_->Find("good").ok());
  const absl::Status held = registry_->Find("bad", "acme").status();
  EXPECT_TRUE(absl::IsDataLoss(held));
  EXPECT_EQ(ErrorReason(held), reason::kStoreDamaged);
  EXPECT_THAT(std::string(held.message()), testing::HasSubstr("event 1"));
  EXPECT_EQ(registry_->absent().damaged, 1);
  ASSERT_EQ(registry_->ListAbsent("").size(), 1U);
  EXPECT_EQ(registry_->ListAbsent("")[0].status, held);
  EXPECT_TRUE(registry_->ListAbsent("acme/bad").empty());
}

TEST_F(MissionRegistryRecoveryTest, WhatTheStoreRefusesForAWhileIsTriedAgainWhenItIsCalledFor) {
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  Restart();
  store_.RefuseAcquisitions(2);
  RecoverAll();
  EXPECT_EQ(registry_->absent().damaged, 0);
  EXPECT_EQ(registry_->absent().sleeping, 1);
  for (int calls = 0; calls < 2; ++calls) {
    EXPECT_EQ(ErrorReason(registry_->Find("hall").status()), reason::kRecovering);
    RecoverAll();
  }
  EXPECT_TRUE(registry_->Find("hall").ok());
  EXPECT_EQ(registry_->absent().sleeping, 0);
  EXPECT_EQ(registry_->reserved_bytes(), MissionOptions().memory_budget_bytes);
}

TEST_F(MissionRegistryRecoveryTest, WhatIsPutIntoTheStoreCanBeRecoveredByName) {
  PutMission(store_, "hall", {}, {{1, RobotRegistered{"r1", 0.2, 7}}});
  EXPECT_TRUE(absl::IsNotFound(registry_->Find("hall").status()));
  ASSERT_TRUE(registry_->Recover("hall").ok());
  EXPECT_EQ(registry_->Find("hall").value()->summary().revision, 1);
  EXPECT_TRUE(absl::IsAlreadyExists(registry_->Recover("hall")));
  EXPECT_TRUE(absl::IsNotFound(registry_->Recover("attic")));
  EXPECT_TRUE(absl::IsNotFound(registry_->Find("attic").status()));
}

TEST_F(MissionRegistryRecoveryTest, DeletedMissionsDoNotComeBack) {
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  absl::Notification removed;
  ASSERT_TRUE(registry_
                  ->Delete("hall", "",
                           [&](const absl::Status& status) {
                             EXPECT_TRUE(status.ok()) << status;
                             removed.Notify();
                           })
                  .ok());
  removed.WaitForNotification();
  Restart();
  EXPECT_EQ(registry_->absent().recovering, 0);
  EXPECT_TRUE(registry_->Create("hall", {}).ok());
}

TEST_F(MissionRegistryRecoveryTest, AMissionThatAnotherServerHasEndsAsFenced) {
  const auto host = registry_->Create("hall", {}).value();
  ASSERT_TRUE(store_.Acquire("hall").ok());
  const absl::Status fenced = Do(*host, [](MissionWriter& writer) {
    EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, 1}).ok());
  });
  EXPECT_EQ(ErrorReason(fenced), reason::kFenced);
  EXPECT_EQ(ErrorReason(host->CheckMayWrite()), reason::kFenced);
  absl::Notification ended;
  host->end_listeners().Add([&](const absl::Status& status) {
    EXPECT_EQ(ErrorReason(status), reason::kFenced);
    ended.Notify();
  });
  ended.WaitForNotification();
  EXPECT_EQ(ErrorReason(host->Post([](MissionWriter&) {})), reason::kFenced);
}

TEST_F(MissionRegistryRecoveryTest, NobodyIsRecoveredOnceAllAreStopped) {
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  Restart();
  registry_->EndWaits(absl::UnavailableError("over"));
  EXPECT_FALSE(registry_->RecoverNext());
  EXPECT_TRUE(absl::IsUnavailable(registry_->Recover("hall")));
}

TEST_F(MissionRegistryRecoveryTest, MissionsThatNobodyUsesSleepUntilSomebodyCalls) {
  std::shared_ptr<const Belief> before;
  std::int64_t token = 0;
  int called = 0;
  registry_->SetOnCalledFor([&] { ++called; });
  {
    const auto host = registry_->Create("hall", support::FastAgeing()).value();
    EXPECT_TRUE(Do(*host, [&](MissionWriter& writer) {
                  token = writer.conduct().Register({"r1", 0.2}, host->leases())->lease_token;
                  EXPECT_TRUE(writer.conduct().Ingest("r1", token, RoomRunBatch()).status.ok());
                  before = writer.conduct().Snapshot();
                }).ok());
    now_ += std::chrono::seconds(60);
    EXPECT_TRUE(registry_->SleepIdle().empty()) << "somebody holds it";
  }
  now_ -= std::chrono::seconds(1);
  EXPECT_TRUE(registry_->SleepIdle().empty()) << "not for long enough";
  now_ += std::chrono::seconds(1);
  EXPECT_EQ(SleepAll(), 1);
  EXPECT_EQ(registry_->absent().sleeping, 1);
  EXPECT_EQ(registry_->absent().recovering, 0);
  ASSERT_EQ(registry_->ListAbsent("").size(), 1U);
  EXPECT_TRUE(registry_->ListAbsent("")[0].is_asleep);
  EXPECT_TRUE(absl::IsAlreadyExists(registry_->Create("hall", {}).status()));
  EXPECT_FALSE(registry_->RecoverNext()) << "nobody has called";
  EXPECT_EQ(called, 0);
  EXPECT_EQ(ErrorReason(registry_->Find("hall").status()), reason::kRecovering);
  EXPECT_EQ(called, 1);
  EXPECT_EQ(registry_->absent().waking, 1);
  EXPECT_EQ(registry_->absent().recovering, 0) << "the server stays ready";
  RecoverAll();
  const auto host = registry_->Find("hall").value();
  EXPECT_TRUE(host->leases().Use("r1", token).ok()) << "the robot goes on as before";
  EXPECT_TRUE(Do(*host, [&](MissionWriter& writer) {
                ExpectSameMission(*writer.conduct().Snapshot(), *before);
              }).ok());
}

TEST_F(MissionRegistryRecoveryTest, ARestartKeepsWithinTheBudgetOfMemory) {
  const std::int64_t each_bytes = MissionOptions().memory_budget_bytes;
  PutMission(store_, "busy", {}, {{1, RobotRegistered{"r1", 0.2, 7}}});
  ASSERT_TRUE(registry_->Create("quiet", {}).ok());
  budget_bytes_ = each_bytes * 3 / 2;  // of a machine that has less
  Restart();
  RecoverAll();
  EXPECT_TRUE(registry_->Find("busy").ok());
  EXPECT_EQ(registry_->reserved_bytes(), each_bytes);
  EXPECT_EQ(registry_->absent().sleeping, 1);
  EXPECT_EQ(registry_->absent().damaged, 0);
  EXPECT_EQ(ErrorReason(registry_->Find("quiet").status()), reason::kLimitReached);
  EXPECT_FALSE(registry_->RecoverNext());
  ASSERT_TRUE(registry_->Delete("busy").ok());
  ASSERT_TRUE(registry_->AwaitStopped(SteadyTime::max()));
  EXPECT_EQ(ErrorReason(registry_->Find("quiet").status()), reason::kRecovering);
  EXPECT_EQ(registry_->reserved_bytes(), each_bytes);
  RecoverAll();
  EXPECT_TRUE(registry_->Find("quiet").ok());
  EXPECT_EQ(registry_->reserved_bytes(), each_bytes);
}

TEST_F(MissionRegistryRecoveryTest, OneThatIsCalledForFindsTheRoomTakenMeanwhile) {
  PutMission(store_, "stored", {}, {{1, RobotRegistered{"r1", 0.2, 7}}});
  budget_bytes_ = MissionOptions().memory_budget_bytes;
  Restart();
  ASSERT_TRUE(registry_->Create("new", {}).ok());
  RecoverAll();
  EXPECT_EQ(ErrorReason(registry_->Find("stored").status()), reason::kLimitReached);
  EXPECT_EQ(registry_->reserved_bytes(), budget_bytes_);
}

TEST_F(MissionRegistryRecoveryTest, OneTenantLeavesPlacesToOthers) {
  max_per_tenant_ = 1;
  Restart();
  ASSERT_TRUE(registry_->Create("a", {}, {"ann", "acme"}).ok());
  EXPECT_EQ(ErrorReason(registry_->Create("b", {}, {"ann", "acme"}).status()),
            reason::kLimitReached);
  now_ += std::chrono::seconds(60);
  EXPECT_EQ(SleepAll(), 1);
  ASSERT_TRUE(registry_->Create("b", {}, {"ann", "acme"}).ok());
  EXPECT_EQ(ErrorReason(registry_->Find("a", "acme").status()), reason::kLimitReached);
  EXPECT_TRUE(registry_->Create("a", {}, {"bob", "other"}).ok());
}

TEST_F(MissionRegistryRecoveryTest, ADamagedMissionTakesNoMemory) {
  PutMission(store_, "bad", {}, {{1, RobotRemoved{"r1"}}});  // who was never there
  Restart();
  RecoverAll();
  EXPECT_EQ(registry_->absent().damaged, 1);
  EXPECT_EQ(registry_->reserved_bytes(), 0);
}

TEST_F(MissionRegistryRecoveryTest, MissionsThatSleepTakeNoRoomAndAreForgottenInTime) {
  for (const char* id : {"a", "b"}) ASSERT_TRUE(registry_->Create(id, {}).ok());
  registry_->Find("a").value()->standing().set_idle_time_to_live(absl::Hours(1));
  now_ += std::chrono::seconds(60);
  EXPECT_EQ(SleepAll(), 2);
  for (const char* id : {"c", "d"}) ASSERT_TRUE(registry_->Create(id, {}).ok());
  EXPECT_EQ(ErrorReason(registry_->Find("b").status()), reason::kLimitReached);
  EXPECT_EQ(registry_->absent().sleeping, 2) << "there is no room to wake";
  ASSERT_TRUE(registry_->Delete("c").ok());
  ASSERT_TRUE(registry_->AwaitStopped(SteadyTime::max()));
  EXPECT_EQ(ErrorReason(registry_->Find("b").status()), reason::kRecovering);
  RecoverAll();
  EXPECT_TRUE(registry_->Find("b").ok());
  now_ += std::chrono::hours(1);
  EXPECT_THAT(registry_->DeleteIdle(), testing::ElementsAre("a"));
  EXPECT_TRUE(absl::IsNotFound(registry_->Find("a").status()));
}

TEST_F(MissionRegistryRecoveryTest, AfterARestartWhatThereIsNoRoomForSleeps) {
  for (const char* key : {"a", "b", "c"}) {
    PutMission(store_, key, {}, {{1, RobotRegistered{"r1", 0.2, 7}}});
  }
  PutMission(store_, "busy", {},
             {{1, RobotRegistered{"r1", 0.2, 7}}, {2, RobotRegistered{"r2", 0.2, 8}}});
  Restart();
  EXPECT_EQ(registry_->absent().sleeping, 2);
  RecoverAll();
  EXPECT_TRUE(registry_->Find("busy").ok());
  EXPECT_EQ(registry_->absent().sleeping, 2);
}

TEST_F(MissionRegistryRecoveryTest, WhatWasAppliedIsStoredWhenAllAreStopped) {
  const auto host = registry_->Create("hall", {}).value();
  store_.Hold();
  ASSERT_TRUE(host->Post([](MissionWriter& writer) {
                    EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, 1}).ok());
                  })
                  .ok());
  store_.AwaitHeld(1);
  registry_->StopAll(absl::UnavailableError("over"));
  EXPECT_TRUE(registry_->AwaitStopped(SteadyTime::max()));
  EXPECT_FALSE(registry_->AwaitStored(SteadyNow()));
  store_.Release();
  EXPECT_TRUE(registry_->AwaitStored(SteadyTime::max()));
  EXPECT_EQ(store_.Peek("hall")->head, 1);
}

}  // namespace mission_registry_recovery_test
}  // namespace plumescout::server
