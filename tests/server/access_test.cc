// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Who may call what, over the wire: every method, by the descriptors of the services.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "plumescout/v1/map_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "plumescout/v1/snapshot_service.grpc.pb.h"
#include "plumescout/v1/system_service.grpc.pb.h"
#include "server/access/rpc.h"
#include "tests/server/access_fixture.h"
#include "tests/server/await_metric.h"
#include "tests/server/held_store.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace access_test {

class WhoMayCallTest : public AccessTest {
 protected:
  // Another server of the same callers, whose missions that store keeps.
  std::unique_ptr<Server> StartWithStore(MissionStore& store) const {
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.access.tokens_file = tokens_path_;
    RegistryHooks hooks;
    hooks.store = &store;
    auto server = Server::Start(config, hooks);
    EXPECT_TRUE(server.ok()) << server.status();
    return server.ok() ? *std::move(server) : nullptr;
  }
  static std::shared_ptr<grpc::Channel> ChannelTo(const Server& server) {
    return grpc::CreateChannel(absl::StrCat("127.0.0.1:", server.port()),
                               grpc::InsecureChannelCredentials());
  }
  static const RpcRow& RowOfMethod(const Method& method) {
    for (const RpcRow& row : RpcTable()) {
      if (row.service == method.service()->name() && row.method == method.name()) return row;
    }
    ADD_FAILURE() << ShortName(method) << " has no row";
    return RpcTable()[0];
  }
  // Whether the method names a robot that its caller acts for.
  static bool ActsForARobot(const Method& method) {
    for (const char* name : {"robot", "robot_id", "open"}) {
      if (method.input_type()->FindFieldByName(name) != nullptr) return true;
    }
    return false;
  }
};

TEST_F(WhoMayCallTest, NoMethodAnswersWhomItDoesNotKnow) {
  for (const Method* method : methods_) {
    for (const char* token : {"", "no such token"}) {
      const Answer answer = Ask(*method, {"ghost"}, token);
      EXPECT_EQ(answer.code, grpc::StatusCode::UNAUTHENTICATED) << ShortName(*method) << answer;
      EXPECT_FALSE(answer.responded) << ShortName(*method);
    }
  }
}

TEST_F(WhoMayCallTest, EveryMethodKeepsToTheTable) {
  const std::map<const char*, Role> callers = {{kAlice, Role::kOperator},
                                               {kEve, Role::kViewer},
                                               {kScout, Role::kRobot},
                                               {kRoot, Role::kAdmin}};
  int refused = 0;
  for (const Method* method : methods_) {
    for (const auto& [token, role] : callers) {
      const bool allowed = IsAllowed(role, RowOfMethod(*method).rpc);
      if (allowed && method->name() == "DrainServer") continue;  // the rest needs the server
      const Answer answer = Ask(*method, {"ghost"}, token);
      EXPECT_EQ(answer.code != grpc::StatusCode::PERMISSION_DENIED, allowed)
          << ShortName(*method) << " by " << token << ": " << answer;
      refused += allowed ? 0 : 1;
    }
  }
  EXPECT_GE(refused, 10);
}

TEST_F(WhoMayCallTest, ARobotActsForItselfAlone) {
  int checked = 0;
  for (const Method* method : methods_) {
    if (!ActsForARobot(*method) || !IsAllowed(Role::kRobot, RowOfMethod(*method).rpc)) continue;
    const Answer other = Ask(*method, {"ghost", "rover"}, kScout);
    EXPECT_EQ(other.code, grpc::StatusCode::PERMISSION_DENIED) << ShortName(*method) << other;
    const Answer own = Ask(*method, {"ghost", "scout"}, kScout);
    EXPECT_EQ(own.code, grpc::StatusCode::NOT_FOUND) << ShortName(*method) << own;
    ++checked;
  }
  EXPECT_GE(checked, 9);
}

TEST_F(WhoMayCallTest, ARobotIsNotToldWhatOthersWereTold) {
  v1::ListPlansRequest request;
  request.set_mission("missions/ghost");
  const auto ask = [&](const std::string& token) {
    const Method& method = *google::protobuf::DescriptorPool::generated_pool()->FindMethodByName(
        "plumescout.v1.PlanningService.ListPlans");
    return AnyCall(channel_, method, token).Make(request).code;
  };
  EXPECT_EQ(ask(kScout), grpc::StatusCode::NOT_FOUND);
  request.set_with_latest(true);
  EXPECT_EQ(ask(kScout), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(ask(kEve), grpc::StatusCode::NOT_FOUND);
}

TEST_F(WhoMayCallTest, AStreamEndsOnceItsTokenIsRevoked) {
  ASSERT_EQ(AskFor("MissionService.CreateMission", {"hall"}, kAlice).code, grpc::StatusCode::OK);
  const auto stub = v1::MapService::NewStub(channel_);
  const auto watch = [&](grpc::ClientContext& context, const std::string& token) {
    SetPatience(context);
    context.AddMetadata("authorization", absl::StrCat("Bearer ", token));
    v1::WatchMapRequest request;
    request.set_mission("missions/hall");
    return stub->WatchMap(&context, request);
  };
  grpc::ClientContext of_eve, of_alice;
  const auto revoked = watch(of_eve, kEve);
  const auto kept = watch(of_alice, kAlice);
  v1::WatchMapResponse map;
  ASSERT_TRUE(revoked->Read(&map));
  ASSERT_TRUE(kept->Read(&map));
  WriteTokens("");
  while (revoked->Read(&map)) {
  }
  EXPECT_EQ(revoked->Finish().error_code(), grpc::StatusCode::UNAUTHENTICATED);
  of_alice.TryCancel();
  EXPECT_EQ(kept->Finish().error_code(), grpc::StatusCode::CANCELLED);
}

TEST_F(WhoMayCallTest, AnImportEndsOnceItsTokenIsRevoked) {
  WriteTokens(TokenLine(kEve, "eve operator acme never"));
  MemoryStore store(/*is_durable=*/true);
  const auto server = StartWithStore(store);
  ASSERT_NE(server, nullptr);
  const auto stub = v1::SnapshotService::NewStub(ChannelTo(*server));
  grpc::ClientContext context;
  SetPatience(context);
  context.AddMetadata("authorization", absl::StrCat("Bearer ", kEve));
  v1::ImportMissionResponse response;
  const auto import = stub->ImportMission(&context, &response);
  v1::ImportMissionRequest part;
  part.mutable_start()->set_mission_id("hall");
  ASSERT_TRUE(import->Write(part));
  EXPECT_TRUE(AwaitMetric(*server, "plumescout_open_streams 1"));
  WriteTokens("");
  EXPECT_EQ(import->Finish().error_code(), grpc::StatusCode::UNAUTHENTICATED);
}

TEST_F(WhoMayCallTest, WhatIsWrongWithTheStoreIsToldToOperators) {
  HeldStore store;
  const auto server = StartWithStore(store);
  ASSERT_NE(server, nullptr);
  store.set_state(Refusing("/srv is full"));
  const auto stub = v1::SystemService::NewStub(ChannelTo(*server));
  const auto ask = [&](const std::string& token) {
    grpc::ClientContext context;
    SetPatience(context);
    context.AddMetadata("authorization", absl::StrCat("Bearer ", token));
    v1::GetServerInfoResponse response;
    EXPECT_TRUE(stub->GetServerInfo(&context, {}, &response).ok());
    EXPECT_FALSE(response.store().available());
    return response.store().trouble();
  };
  EXPECT_EQ(ask(kEve), "");
  EXPECT_EQ(ask(kScout), "");
  EXPECT_EQ(ask(kAlice), "/srv is full");
  EXPECT_EQ(ask(kRoot), "/srv is full");
}

TEST_F(WhoMayCallTest, HealthIsForEverybody) {
  grpc::GenericStub stub(channel_);
  grpc::ClientContext context;
  SetPatience(context);
  grpc::CompletionQueue queue;
  const grpc::Slice whole_server;  // HealthCheckRequest{}
  const grpc::ByteBuffer request(&whole_server, 1);
  const auto call =
      stub.PrepareUnaryCall(&context, "/grpc.health.v1.Health/Check", request, &queue);
  call->StartCall();
  grpc::ByteBuffer response;
  grpc::Status status;
  call->Finish(&response, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  ASSERT_TRUE(queue.Next(&tag, &ok));
  EXPECT_TRUE(status.ok()) << status.error_message();
}

}  // namespace access_test
}  // namespace plumescout::server
