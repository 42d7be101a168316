// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the server: one of several that share a store.
#include <gmock/gmock.h>
#include <grpcpp/client_context.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/strings/match.h"
#include "absl/synchronization/mutex.h"
#include "core/types/error_reason.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "server/server.h"
#include "server/store/store_errors.h"
#include "tests/server/fake_nodes.h"
#include "tests/server/stored_run.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace server_nodes_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Reads of missions wait while it is told so, and rows of missions are damaged.
class SlowStore final : public SharedStore {
 public:
  absl::StatusOr<AcquiredMission> Acquire(const std::string& key) override {
    if (is_damaged(key)) return kDamage;
    return SharedStore::Acquire(key);
  }
  absl::StatusOr<AcquiredMission> Peek(const std::string& key) override {
    if (is_damaged(key)) return kDamage;
    return SharedStore::Peek(key);
  }
  void Discard(const std::string& key, Done done) override {
    EXPECT_TRUE(is_damaged(key));
    {
      absl::MutexLock lock(&reads_mutex_);
      damaged_ = "";
    }
    SharedStore::Remove(key, 1, std::move(done));
  }
  void Damage(const std::string& key) {
    absl::MutexLock lock(&reads_mutex_);
    damaged_ = key;
  }
  void SetReads(bool wait) {
    absl::MutexLock lock(&reads_mutex_);
    reads_wait_ = wait;
  }
  void AwaitRead() const {
    const auto is_read = [this] {
      reads_mutex_.AssertHeld();
      return reads_ > 0;
    };
    absl::MutexLock lock(&reads_mutex_);
    reads_mutex_.Await(absl::Condition(&is_read));
  }
  absl::StatusOr<std::unique_ptr<JournalReader>> Read(const std::string& key,
                                                      std::int64_t first_number) override {
    {
      const auto may_read = [this] {
        reads_mutex_.AssertHeld();
        return !reads_wait_;
      };
      absl::MutexLock lock(&reads_mutex_);
      ++reads_;
      reads_mutex_.Await(absl::Condition(&may_read));
    }
    return SharedStore::Read(key, first_number);
  }

 private:
  bool is_damaged(const std::string& key) const {
    absl::MutexLock lock(&reads_mutex_);
    return damaged_ == key;
  }

  const absl::Status kDamage = StoreDamaged("the header is not what was written");
  mutable absl::Mutex reads_mutex_;
  std::string damaged_ ABSL_GUARDED_BY(reads_mutex_);
  int reads_ ABSL_GUARDED_BY(reads_mutex_) = 0;
  bool reads_wait_ ABSL_GUARDED_BY(reads_mutex_) = false;
};

class ServerNodesTest : public testing::Test {
 protected:
  ServerNodesTest() {
    for (const char* key : {"hall", "yard"}) {
      PutMission(store_, key, {}, {{1, RobotRegistered{"r1", 0.2, 7}}});
    }
    store_.SetOwner("hall", "n2");
    RegistryHooks hooks;
    hooks.store = &store_;
    ServerConfig config;
    config.listen = "";
    auto server = Server::Start(config, hooks);
    EXPECT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
    missions_ = v1::MissionService::NewStub(server_->InProcessChannel());
  }

  struct Answer {
    grpc::Status status;
    std::string owner;  // of the trailer
  };
  grpc::Status Ask(const std::string& id, grpc::ClientContext& context) {
    v1::GetMissionRequest request;
    v1::GetMissionResponse response;
    request.set_name("missions/" + id);
    return missions_->GetMission(&context, request, &response);
  }
  // Asks again while the server asks its store.
  Answer Get(const std::string& id, const std::string& unreached = "") {
    while (true) {
      grpc::ClientContext context;
      if (!unreached.empty()) context.AddMetadata("x-unreached", unreached);
      Answer answer{Ask(id, context), ""};
      if (answer.status.error_message().starts_with(std::string(reason::kRecovering))) continue;
      const auto& trailers = context.GetServerTrailingMetadata();
      const auto owner = trailers.find("x-owner");
      if (owner != trailers.end()) answer.owner = {owner->second.data(), owner->second.size()};
      return answer;
    }
  }
  grpc::Status Delete(const std::string& id) {
    grpc::ClientContext context;
    v1::DeleteMissionRequest request;
    v1::DeleteMissionResponse response;
    request.set_name("missions/" + id);
    return missions_->DeleteMission(&context, request, &response);
  }

  SlowStore store_;
  std::unique_ptr<Server> server_;
  std::unique_ptr<v1::MissionService::Stub> missions_;
};

TEST_F(ServerNodesTest, CallsAreToldWhereAMissionIs) {
  EXPECT_EQ(server_->NotReady(), "") << "missions are read when they are called for";
  const Answer elsewhere = Get("hall");
  EXPECT_EQ(elsewhere.status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_TRUE(elsewhere.status.error_message().starts_with(std::string(reason::kMissionElsewhere)))
      << elsewhere.status.error_message();
  EXPECT_EQ(elsewhere.owner, "n2");
  const Answer mine = Get("yard");
  EXPECT_TRUE(mine.status.ok()) << mine.status.error_message();
  EXPECT_EQ(mine.owner, "");
  EXPECT_EQ(Get("attic").status.error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(ServerNodesTest, CallsThatNamedTheNodeOfTheirMissionAndCameHereAreTold) {
  const Answer strayed = Get("hall", "n2");
  EXPECT_EQ(strayed.status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_THAT(strayed.status.error_message(), StartsWith(std::string(reason::kNodeUnreached)));
  EXPECT_THAT(strayed.status.error_message(), HasSubstr("missions/hall is served by node n2"));
  EXPECT_EQ(strayed.owner, "n2");
  EXPECT_TRUE(Get("yard", "n2").status.ok()) << "it was another's before";
  EXPECT_THAT(Get("hall", "n3").status.error_message(),
              StartsWith(std::string(reason::kMissionElsewhere)));
  EXPECT_THAT(server_->MetricsText(), HasSubstr("plumescout_stray_calls_total 1\n"));
  while (store_.noted_strays().empty()) std::this_thread::yield();
  EXPECT_THAT(store_.noted_strays(), ElementsAre(OwnedMission{"hall", "n2"}));
}

TEST_F(ServerNodesTest, MissionsWhoseCallsGoToOthersAreGivenUp) {
  ASSERT_TRUE(Get("yard").status.ok());
  store_.SetStrays({{{"yard", 2, "n2"}}, {"n1"}});
  while (store_.released().empty()) std::this_thread::yield();
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"yard", 2}}));
  EXPECT_EQ(Get("yard").owner, "n2");
  const auto says = [this](const std::string& line) {
    return absl::StrContains(server_->MetricsText(), line);
  };
  while (!says("plumescout_missions_given_up_total 1\n")) std::this_thread::yield();
  EXPECT_TRUE(says("plumescout_node_unreached{node=\"n1\"} 1\n"));
}

TEST_F(ServerNodesTest, MissionsOfTheWholeStoreAreListed) {
  ASSERT_TRUE(store_.Create("attic", "").ok());
  ASSERT_TRUE(Get("yard").status.ok());
  store_.SetOwner("yard", "n1");
  std::string token;
  std::string listed;
  do {
    grpc::ClientContext context;
    v1::ListMissionsRequest request;
    v1::ListMissionsResponse response;
    request.set_page_size(1);
    request.set_page_token(token);
    ASSERT_TRUE(missions_->ListMissions(&context, request, &response).ok());
    ASSERT_EQ(response.missions_size(), 1);
    const v1::Mission& mission = response.missions(0);
    listed +=
        mission.name() + " " + v1::MissionState_Name(mission.state()) + " " + mission.node() + "\n";
    token = response.next_page_token();
  } while (!token.empty());
  EXPECT_EQ(listed,
            "missions/attic MISSION_STATE_SLEEPING \n"
            "missions/hall MISSION_STATE_ELSEWHERE n2\n"
            "missions/yard MISSION_STATE_RUNNING n1\n");
}

TEST_F(ServerNodesTest, TakingAMissionOverDoesNotMakeItUnready) {
  store_.SetReads(/*wait=*/true);
  grpc::ClientContext context;
  EXPECT_EQ(Ask("yard", context).error_code(), grpc::StatusCode::UNAVAILABLE);
  store_.AwaitRead();
  EXPECT_EQ(server_->NotReady(), "");
  store_.SetReads(/*wait=*/false);
  EXPECT_TRUE(Get("yard").status.ok());
}

TEST_F(ServerNodesTest, WhatCannotBeReadCanBeDeleted) {
  ASSERT_TRUE(store_.Create("mill", "no mission begins so").ok());
  EXPECT_EQ(Get("mill").status.error_code(), grpc::StatusCode::DATA_LOSS);
  const grpc::Status deleted = Delete("mill");
  EXPECT_TRUE(deleted.ok()) << deleted.error_message();
  EXPECT_EQ(Get("mill").status.error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(ServerNodesTest, WhatTheStoreCallsDamagedIsNamedListedAndDeleted) {
  ASSERT_TRUE(store_.Create("acme/mill", "").ok());
  store_.Damage("acme/mill");
  const Answer damaged = Get("mill");  // an admin's call, who is of no tenant
  EXPECT_EQ(damaged.status.error_code(), grpc::StatusCode::DATA_LOSS);
  EXPECT_THAT(damaged.status.error_message(), HasSubstr("the header is not what was written"));
  grpc::ClientContext lists;
  v1::ListMissionsRequest all;
  v1::ListMissionsResponse listed;
  ASSERT_TRUE(missions_->ListMissions(&lists, all, &listed).ok());
  ASSERT_EQ(listed.missions(0).name(), "missions/mill");
  EXPECT_EQ(listed.missions(0).state(), v1::MISSION_STATE_DAMAGED);
  EXPECT_THAT(listed.missions(0).damage(), HasSubstr("the header is not what was written"));
  const grpc::Status deleted = Delete("mill");
  EXPECT_TRUE(deleted.ok()) << deleted.error_message();
  EXPECT_EQ(Get("mill").status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_TRUE(absl::IsNotFound(store_.Peek("acme/mill").status()));
}

TEST_F(ServerNodesTest, WithTheLeaseItStopsServing) {
  ASSERT_TRUE(Get("yard").status.ok());
  store_.SetOwner("yard", "n2");
  store_.LoseLease();
  EXPECT_EQ(Get("yard").owner, "n2");
}

TEST_F(ServerNodesTest, WhoIsDrainedHandsItsMissionsOver) {
  store_.AddNode("n2");
  ASSERT_TRUE(Get("yard").status.ok());
  server_->Drain();
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"yard", 2}}));
}

TEST_F(ServerNodesTest, WhoIsDrainedReleasesItsMissions) {
  ASSERT_TRUE(Get("yard").status.ok());
  server_->Drain();
  EXPECT_EQ(store_.released(), (std::map<std::string, std::int64_t>{{"yard", 2}}));
}

// Notes whether calls could come already when the server began to heed what it is told of leases.
class WatchedStore final : public SharedStore {
 public:
  explicit WatchedStore(std::string socket) : socket_(std::move(socket)) {}
  void SetOnLost(OnLost on_lost) override {
    if (on_lost) {
      is_heeded = true;
      was_listening = std::filesystem::exists(socket_);
    }
    SharedStore::SetOnLost(std::move(on_lost));
  }
  bool is_heeded = false;
  bool was_listening = false;

 private:
  const std::string socket_;
};

TEST(ServerLeaseTest, LostLeasesAreHeededBeforeCallsAreTaken) {
  const TempFolder folder;
  const std::string socket = folder.path() + "/grpc.sock";
  WatchedStore store(socket);
  RegistryHooks hooks;
  hooks.store = &store;
  ServerConfig config;
  config.listen = "unix:" + socket;
  const auto server = Server::Start(config, hooks);
  ASSERT_TRUE(server.ok()) << server.status();
  EXPECT_TRUE(std::filesystem::exists(socket));
  EXPECT_TRUE(store.is_heeded);
  EXPECT_FALSE(store.was_listening);
}

}  // namespace server_nodes_test
}  // namespace plumescout::server
