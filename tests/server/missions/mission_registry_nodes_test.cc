// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission registry: a store that several servers share.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <iterator>
#include <memory>
#include <string>

#include "absl/synchronization/notification.h"
#include "core/types/error_reason.h"
#include "server/base/errors.h"
#include "server/missions/mission_registry.h"
#include "server/missions/recovery_list.h"
#include "tests/server/fake_nodes.h"
#include "tests/server/stored_run.h"

namespace plumescout::server {
namespace mission_registry_nodes_test {

using ::testing::ElementsAre;

class MissionRegistryNodesTest : public testing::Test {
 protected:
  MissionRegistryNodesTest() {
    RegistryHooks hooks;
    hooks.store = &store_;
    hooks.clock = [this] { return now_; };
    hooks.snapshot_pool = &snapshot_pool_;
    RegistryOptions options;
    options.sleep_after = absl::Seconds(60);
    registry_ = std::make_unique<MissionRegistry>(options, hooks);
  }
  void Put(const std::string& key) {
    PutMission(store_, key, {}, {{1, RobotRegistered{"r1", 0.2, 7}}});
  }
  // What a call is told once the store has been asked.
  absl::StatusOr<std::shared_ptr<MissionHost>> CallFor(const std::string& id) {
    EXPECT_EQ(ErrorReason(registry_->Find(id).status()), reason::kRecovering);
    while (registry_->RecoverNext()) {
    }
    return registry_->Find(id);
  }

  // A mission that did something which does not become durable until the store is released.
  std::shared_ptr<MissionHost> MakeUnsettled(const std::string& id) {
    const auto host = registry_->Create(id, {}).value();
    store_.Hold();
    const auto something = [](MissionWriter& writer) {
      EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, 1}).ok());
    };
    EXPECT_TRUE(host->Post(something).ok());
    return host;
  }
  // Asks its writer something once that rests, as it does when it waits for what it did before to
  // be durable. What becomes of it comes later.
  static std::shared_ptr<std::promise<absl::Status>> AskAtRest(MissionHost& host) {
    while (host.journal().next_deadline() == SteadyTime::max()) {
    }
    auto told = std::make_shared<std::promise<absl::Status>>();
    EXPECT_TRUE(host.Post([](MissionWriter&) { ADD_FAILURE() << "it rests"; },
                          [told](const absl::Status& status) { told->set_value(status); })
                    .ok());
    return told;
  }

  SteadyTime now_ = SteadyTime() + std::chrono::hours(1);
  SharedStore store_;
  WorkerPool snapshot_pool_{{"snapshot", 1, 4}};
  std::unique_ptr<MissionRegistry> registry_;
};

TEST_F(MissionRegistryNodesTest, AMissionOfNobodyIsAcquiredWhenItIsCalledFor) {
  Put("hall");
  ASSERT_TRUE(registry_->FindStored().ok());
  EXPECT_FALSE(registry_->RecoverNext()) << "nobody has called";
  const auto host = CallFor("hall");
  ASSERT_TRUE(host.ok()) << host.status();
  EXPECT_EQ((*host)->summary().revision, 1);
  EXPECT_EQ((*host)->journal().epoch(), 2);
}

TEST_F(MissionRegistryNodesTest, CallsAreSentToTheNodeThatHasTheMissionAsLongAsItLives) {
  Put("hall");
  store_.SetOwner("hall", "n2");
  EXPECT_EQ(NodeElsewhere(CallFor("hall").status()), "n2");
  store_.SetOwner("hall", "");
  EXPECT_EQ(NodeElsewhere(registry_->Find("hall").status()), "n2") << "as it was told lately";
  now_ += std::chrono::seconds(2);
  EXPECT_TRUE(CallFor("hall").ok());
}

TEST_F(MissionRegistryNodesTest, WhatTheStoreDoesNotHaveCanBeMade) {
  EXPECT_EQ(ErrorReason(registry_->Find("hall").status()), reason::kRecovering);
  EXPECT_EQ(ErrorReason(registry_->Create("hall", {}).status()), reason::kRecovering)
      << "it may be there";
  EXPECT_TRUE(registry_->RecoverNext());
  EXPECT_TRUE(absl::IsNotFound(registry_->Find("hall").status()));
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  EXPECT_TRUE(registry_->Find("hall").ok());
}

TEST_F(MissionRegistryNodesTest, WhatAnotherNodeHasIsNotMadeAnew) {
  Put("hall");
  store_.SetOwner("hall", "n2");
  EXPECT_TRUE(absl::IsAlreadyExists(registry_->Create("hall", {}).status()));
  EXPECT_EQ(NodeElsewhere(CallFor("hall").status()), "n2");
}

TEST_F(MissionRegistryNodesTest, NobodyIsServedWithoutALease) {
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  store_.SetLeaseUntil(now_);
  EXPECT_EQ(ErrorReason(registry_->Find("hall").status()), reason::kStoreUnavailable);
  EXPECT_EQ(ErrorReason(registry_->Create("yard", {}).status()), reason::kStoreUnavailable);
  store_.SetLeaseUntil(now_ + std::chrono::nanoseconds(1));
  EXPECT_TRUE(registry_->Find("hall").ok());
}

TEST_F(MissionRegistryNodesTest, WithTheLeaseAllMissionsAreLost) {
  const auto host = registry_->Create("hall", {}).value();
  absl::Notification ended;
  host->end_listeners().Add([&](const absl::Status&) { ended.Notify(); });
  registry_->LoseAll(absl::UnavailableError("lost"));
  ended.WaitForNotification();
  EXPECT_TRUE(absl::IsUnavailable(host->Post([](MissionWriter&) {})));
  store_.SetOwner("hall", "n2");
  EXPECT_EQ(NodeElsewhere(CallFor("hall").status()), "n2");
}

TEST_F(MissionRegistryNodesTest, AMissionThatWasTakenOverIsLookedForAnew) {
  const auto host = registry_->Create("hall", {}).value();
  ASSERT_TRUE(store_.HeldStore::Acquire("hall").ok());
  absl::Notification told;
  ASSERT_TRUE(host->Post([&](MissionWriter& writer) {
                    EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, 1}).ok());
                    host->WhenDurable([&](const absl::Status& status) {
                      EXPECT_EQ(ErrorReason(status), reason::kFenced);
                      told.Notify();
                    });
                  })
                  .ok());
  told.WaitForNotification();
  store_.SetOwner("hall", "n2");
  EXPECT_EQ(NodeElsewhere(CallFor("hall").status()), "n2");
}

TEST_F(MissionRegistryNodesTest, WhatOthersHaveIsListed) {
  for (const char* key : {"acme/hall", "acme/yard", "hall", "mill"}) Put(key);
  store_.SetOwner("acme/yard", "n2");
  store_.SetOwner("mill", "n1");  // ours: it is on the list of those that run, or will be
  EXPECT_EQ(registry_->node(), "n1");
  EXPECT_THAT(*registry_->ListElsewhere("", 9),
              ElementsAre(OwnedMission{"acme/hall", ""}, OwnedMission{"acme/yard", "n2"},
                          OwnedMission{"hall", ""}));
  EXPECT_THAT(*registry_->ListElsewhere("acme/hall", 1),
              ElementsAre(OwnedMission{"acme/yard", "n2"}));
  EXPECT_THAT(*registry_->ListElsewhere("", 9, "acme/"),
              ElementsAre(OwnedMission{"acme/hall", ""}, OwnedMission{"acme/yard", "n2"}));
  const auto of_nobody = [](const std::string& key) { return TenantOf(key).empty(); };
  EXPECT_THAT(*registry_->ListElsewhere("", 9, "", of_nobody),
              ElementsAre(OwnedMission{"hall", ""}));
}

TEST_F(MissionRegistryNodesTest, AnAdministratorsNameIsLookedForInTheStore) {
  for (const char* key : {"acme/hall", "acme/yard", "globex/yard", "globex/mill"}) Put(key);
  store_.SetOwner("globex/mill", "n2");
  const auto find = [this](const MissionId& id) {
    auto found = registry_->FindOfAnyTenant(id);
    while (ErrorReason(found.status()) == reason::kRecovering) {
      EXPECT_FALSE(AwaitedMission(found.status()).empty()) << "who calls may wait for it";
      while (registry_->RecoverNext()) {
      }
      found = registry_->FindOfAnyTenant(id);
    }
    return found;
  };
  const auto hall = find("hall");
  ASSERT_TRUE(hall.ok()) << hall.status();
  EXPECT_EQ((*hall)->tenant(), "acme");
  EXPECT_EQ(NodeElsewhere(find("mill").status()), "n2");
  EXPECT_TRUE(absl::IsFailedPrecondition(find("yard").status())) << "of several tenants";
  EXPECT_TRUE(absl::IsNotFound(find("attic").status()));
}

TEST_F(MissionRegistryNodesTest, TheStoreIsToldForHowLongMissionsAreKept) {
  constexpr absl::Duration kPeriod = absl::Seconds(30);
  ASSERT_TRUE(registry_->Create("mill", {}).ok());
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  registry_->Find("hall").value()->standing().set_idle_time_to_live(absl::Minutes(10));
  now_ += std::chrono::minutes(4);
  ASSERT_TRUE(registry_->DeleteForgotten(kPeriod)->empty());
  EXPECT_EQ(store_.kept()["mill"], absl::InfiniteDuration());
  EXPECT_EQ(store_.kept()["hall"], absl::Minutes(6) + 2 * kPeriod);
  const auto used = registry_->Find("hall");
  EXPECT_TRUE(registry_->DeleteIdle().empty());
  ASSERT_TRUE(registry_->DeleteForgotten(kPeriod)->empty());
  EXPECT_EQ(store_.kept()["hall"], absl::Minutes(10) + 2 * kPeriod) << "it is used";
}

TEST_F(MissionRegistryNodesTest, MissionsOfNobodyGoWhenTheirTimeIsOver) {
  for (const char* key : {"hall", "mill", "yard", "attic"}) Put(key);
  ASSERT_TRUE(CallFor("hall").ok());
  store_.SetOwner("mill", "n2");
  // One is here, one is another's by now, one was used meanwhile.
  store_.SetForgotten({{"hall", 2}, {"mill", 1}, {"yard", 0}, {"attic", 1}});
  const auto deleted = registry_->DeleteForgotten(absl::Seconds(30));
  ASSERT_TRUE(deleted.ok()) << deleted.status();
  EXPECT_THAT(*deleted, ElementsAre("attic"));
  EXPECT_TRUE(absl::IsNotFound(CallFor("attic").status()));
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"yard", 2}}));
  EXPECT_TRUE(CallFor("yard").ok());
  EXPECT_TRUE(registry_->Find("hall").ok());
}

TEST_F(MissionRegistryNodesTest, ADeletedMissionIsNotTakenOverBeforeTheStoreHasForgottenIt) {
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  store_.Hold();
  absl::Notification removed;
  const auto note = [&](const absl::Status& status) {
    EXPECT_TRUE(status.ok()) << status;
    removed.Notify();
  };
  ASSERT_TRUE(registry_->Delete("hall", "", note).ok());
  EXPECT_TRUE(absl::IsNotFound(registry_->Find("hall").status()));
  EXPECT_TRUE(absl::IsNotFound(registry_->Recover("hall")));
  EXPECT_EQ(store_.Peek("hall")->epoch, 1);
  store_.AwaitHeld(1);
  EXPECT_TRUE(absl::IsNotFound(registry_->Find("hall").status()));
  store_.HeldStore::Release();
  removed.WaitForNotification();
  EXPECT_TRUE(absl::IsNotFound(CallFor("hall").status())) << "the store is asked";
  EXPECT_TRUE(registry_->Create("hall", {}).ok());
  EXPECT_TRUE(registry_->Find("hall").ok());
}

TEST_F(MissionRegistryNodesTest, WhatOthersAreToReadIsShortened) {
  const auto host = registry_->Create("hall", support::FastAgeing()).value();
  absl::Notification applied;
  ASSERT_TRUE(host->Post([&](MissionWriter& writer) {
                    const auto lease = writer.conduct().Register({"r1", 0.2}, host->leases());
                    const auto batch = support::RoomRunBatch();
                    EXPECT_TRUE(
                        writer.conduct().Ingest("r1", lease->lease_token, batch).status.ok());
                    applied.Notify();
                  })
                  .ok());
  applied.WaitForNotification();
  store_.Hold();
  EXPECT_FALSE(registry_->TakeSnapshots(After(SteadyNow(), absl::Milliseconds(1))));
  store_.HeldStore::Release();
  EXPECT_TRUE(registry_->TakeSnapshots(SteadyTime::max()));
  const auto snapshots = store_.Peek("hall")->snapshots;
  ASSERT_FALSE(snapshots.empty());
  EXPECT_GT(snapshots[0].revision, std::ssize(support::RoomRun())) << "all that was observed";
  EXPECT_TRUE(host->CheckMayWrite().ok()) << "it goes on";
}

TEST_F(MissionRegistryNodesTest, NothingIsHandedOverToNobody) {
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  EXPECT_FALSE(registry_->HandOverAll(SteadyTime::max()));
  EXPECT_TRUE(registry_->Find("hall").ok());
  EXPECT_TRUE(registry_->Create("yard", {}).ok());
}

TEST_F(MissionRegistryNodesTest, WhoAsksWhileAMissionMovesWaitsAndIsToldWhoHasItNext) {
  store_.AddNode("n2");
  const auto host = MakeUnsettled("hall");
  store_.AwaitHeld(1);
  auto moved =
      std::async(std::launch::async, [this] { return registry_->HandOverAll(SteadyTime::max()); });
  const auto told = AskAtRest(*host);
  EXPECT_TRUE(store_.released().empty()) << "not all is durable";
  store_.HeldStore::Release();
  EXPECT_TRUE(moved.get());
  EXPECT_EQ(NodeElsewhere(told->get_future().get()), "n2");
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"hall", 1}}));
  EXPECT_EQ(store_.Peek("hall")->head, 1);
  EXPECT_EQ(NodeElsewhere(registry_->Find("hall").status()), "n2");
}

TEST_F(MissionRegistryNodesTest, WhoHandsItsMissionsOverTakesNoOthers) {
  store_.AddNode("n2");
  Put("yard");
  ASSERT_TRUE(CallFor("yard").ok());
  now_ += std::chrono::minutes(2);
  EXPECT_TRUE(registry_->SleepIdle().empty()) << "not all is settled";
  while (registry_->SleepIdle().empty()) {
  }
  Put("attic");
  EXPECT_EQ(ErrorReason(registry_->Find("attic").status()), reason::kRecovering);
  EXPECT_TRUE(registry_->HandOverAll(SteadyTime::max()));
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"yard", 2}}));
  EXPECT_TRUE(registry_->RecoverNext()) << "it was asked for before";
  EXPECT_EQ(store_.Peek("attic")->epoch, 1);
  for (const char* key : {"yard", "attic", "cellar"}) {
    EXPECT_EQ(NodeElsewhere(registry_->Find(key).status()), "n2");
    EXPECT_EQ(NodeElsewhere(registry_->Create(key, {}).status()), "n2");
  }
}

TEST_F(MissionRegistryNodesTest, WhatDoesNotComeToRestIsDropped) {
  store_.AddNode("n2");
  const auto host = MakeUnsettled("hall");
  EXPECT_TRUE(registry_->HandOverAll(SteadyNow()));
  EXPECT_TRUE(store_.released().empty());
  EXPECT_EQ(ErrorReason(host->Post([](MissionWriter&) {})), reason::kDraining);
  store_.HeldStore::Release();
  registry_->StopAll(absl::UnavailableError("over"));
  EXPECT_TRUE(registry_->AwaitStopped(SteadyTime::max()));
  EXPECT_TRUE(registry_->AwaitStored(SteadyTime::max()));
  registry_->ReleaseAll();
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"hall", 1}}));
}

TEST_F(MissionRegistryNodesTest, AMissionWhoseCallsComeToAnotherNodeIsGivenUpToIt) {
  const auto host = MakeUnsettled("hall");
  store_.AwaitHeld(1);
  const StrayMission stray{"hall", 1, "n3"};
  auto given = std::async(std::launch::async, [&] { return registry_->GiveUp(stray); });
  const auto told = AskAtRest(*host);
  EXPECT_TRUE(store_.released().empty()) << "not all is durable";
  store_.HeldStore::Release();
  EXPECT_TRUE(given.get().ok());
  EXPECT_EQ(NodeElsewhere(told->get_future().get()), "n3");
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"hall", 1}}));
  EXPECT_EQ(NodeElsewhere(registry_->Find("hall").status()), "n3") << "it is to have it first";
  EXPECT_TRUE(registry_->Create("yard", {}).ok()) << "the node goes on";
  now_ += std::chrono::seconds(5);
  EXPECT_TRUE(CallFor("hall").ok()) << "nobody has taken it";
}

TEST_F(MissionRegistryNodesTest, WhatSleepsOrIsDamagedIsGivenUpAndWhatIsReadIsNot) {
  Put("yard");
  ASSERT_TRUE(CallFor("yard").ok());
  now_ += std::chrono::minutes(2);
  while (registry_->SleepIdle().empty()) {
  }
  EXPECT_TRUE(registry_->GiveUp({"yard", 2, "n3"}).ok());
  EXPECT_TRUE(registry_->GiveUp({"mill", 7, "n3"}).ok()) << "it is ours, and was not read";
  EXPECT_EQ(NodeElsewhere(registry_->Find("yard").status()), "n3");
  EXPECT_EQ(ErrorReason(registry_->Find("attic").status()), reason::kRecovering);
  EXPECT_TRUE(absl::IsAborted(registry_->GiveUp({"attic", 1, "n3"})));
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"mill", 7}, {"yard", 2}}));
}

TEST_F(MissionRegistryNodesTest, WhatIsBeingDeletedIsNotGivenUp) {
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  store_.Hold();
  std::promise<absl::Status> removed;
  ASSERT_TRUE(
      registry_->Delete("hall", "", [&](const absl::Status& status) { removed.set_value(status); })
          .ok());
  EXPECT_TRUE(absl::IsNotFound(registry_->GiveUp({"hall", 1, "n3"})));
  store_.AwaitHeld(1);
  EXPECT_TRUE(absl::IsNotFound(registry_->GiveUp({"hall", 1, "n3"})));
  EXPECT_TRUE(store_.released().empty()) << "another node could take it over";
  store_.HeldStore::Release();
  EXPECT_TRUE(removed.get_future().get().ok());
}

TEST_F(MissionRegistryNodesTest, MissionsAreReleasedOnceAllHaveStopped) {
  ASSERT_TRUE(registry_->Create("hall", {}).ok());
  Put("yard");
  ASSERT_TRUE(CallFor("yard").ok());
  registry_->StopAll(absl::UnavailableError("over"));
  EXPECT_TRUE(registry_->AwaitStopped(SteadyTime::max()));
  EXPECT_TRUE(registry_->AwaitStored(SteadyTime::max()));
  registry_->ReleaseAll();
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"hall", 1}, {"yard", 2}}));
}

}  // namespace mission_registry_nodes_test
}  // namespace plumescout::server
