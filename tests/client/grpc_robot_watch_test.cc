// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_robot_watch.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "absl/synchronization/notification.h"
#include "proto/convert/robot_notice.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {
namespace grpc_robot_watch_test {

using Writer = grpc::ServerWriter<v1::WatchRobotResponse>;
using Script = std::function<grpc::Status(const v1::WatchRobotRequest&, Writer&)>;

// A server of watches that does what a test says.
class ScriptedRobots final : public v1::RobotService::Service {
 public:
  explicit ScriptedRobots(Script script) : script_(std::move(script)) {
    grpc::ServerBuilder builder;
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    stub_ = v1::RobotService::NewStub(server_->InProcessChannel({}));
  }
  ~ScriptedRobots() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status WatchRobot(grpc::ServerContext*, const v1::WatchRobotRequest* request,
                          Writer* writer) override {
    return script_(*request, *writer);
  }
  std::unique_ptr<RobotWatch> Open() {
    RobotSession session;
    session.mission = "house";
    session.robot = "scout";
    session.lease_token = 42;
    return OpenGrpcRobotWatch(routes_, *stub_, session);
  }

 private:
  Script script_;
  std::unique_ptr<grpc::Server> server_;
  MissionRoutes routes_;
  std::unique_ptr<v1::RobotService::Stub> stub_;
};

TEST(GrpcRobotWatchTest, NoticesComeInOrderAndThenTheServersWord) {
  ScriptedRobots server([](const v1::WatchRobotRequest& request, Writer& writer) {
    EXPECT_EQ(request.robot(), "missions/house/robots/scout");
    EXPECT_EQ(request.lease_token(), 42);
    writer.Write(ToProto(RobotStanding{.leased = true}, "house"));
    writer.Write(ToProto(PlanInvalidated{.plan = 3}, "house"));
    return grpc::Status(grpc::StatusCode::NOT_FOUND, "it left");
  });
  const auto watch = server.Open();
  EXPECT_EQ(*watch->Read(kPatience), RobotNotice(RobotStanding{.leased = true}));
  EXPECT_EQ(*watch->Read(kPatience), RobotNotice(PlanInvalidated{.plan = 3}));
  EXPECT_TRUE(absl::IsNotFound(watch->Read(kPatience).status()));
  EXPECT_TRUE(absl::IsNotFound(watch->TryRead().status()));
}

TEST(GrpcRobotWatchTest, AQuietWatchLivesOn) {
  absl::Notification go;
  ScriptedRobots server([&](const v1::WatchRobotRequest&, Writer& writer) {
    go.WaitForNotification();
    writer.Write(ToProto(PlanAssigned{3}, "house"));
    return grpc::Status::OK;
  });
  const auto watch = server.Open();
  EXPECT_TRUE(absl::IsDeadlineExceeded(watch->TryRead().status()));
  EXPECT_TRUE(absl::IsDeadlineExceeded(watch->Read(absl::Milliseconds(5)).status()));
  go.Notify();
  EXPECT_EQ(*watch->Read(kPatience), RobotNotice(PlanAssigned{3}));
  EXPECT_TRUE(absl::IsUnavailable(watch->Read(kPatience).status()));  // it has no end by itself
}

TEST(GrpcRobotWatchTest, CancelEndsAReadFromAnotherThread) {
  absl::Notification over;
  ScriptedRobots server([&](const v1::WatchRobotRequest&, Writer&) {
    over.WaitForNotification();
    return grpc::Status::OK;
  });
  const auto watch = server.Open();
  std::thread canceller([&] { watch->Cancel(); });
  EXPECT_TRUE(absl::IsCancelled(watch->Read(kPatience).status()));
  canceller.join();
  over.Notify();
}

TEST(GrpcRobotWatchTest, WhatWasNotReadKeepsNobodyFromLeaving) {
  ScriptedRobots server([](const v1::WatchRobotRequest&, Writer& writer) {
    while (writer.Write(ToProto(RobotStanding{}, "house"))) {
    }
    return grpc::Status::OK;
  });
  const auto watch = server.Open();
  EXPECT_TRUE(watch->Read(kPatience).ok());
}

TEST(GrpcRobotWatchTest, ANoticeThatIsNoneIsTheServersFault) {
  ScriptedRobots server([](const v1::WatchRobotRequest&, Writer& writer) {
    writer.Write({});
    return grpc::Status::OK;
  });
  EXPECT_TRUE(absl::IsInternal(server.Open()->Read(kPatience).status()));
}

}  // namespace grpc_robot_watch_test
}  // namespace plumescout::client
