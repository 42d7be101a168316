// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_plan_stream.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "absl/synchronization/notification.h"
#include "proto/convert/plan.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {
namespace grpc_plan_stream_test {

using Writer = grpc::ServerWriter<v1::StreamNextBestTrajectoryResponse>;
using Script = std::function<grpc::Status(Writer&)>;

// A planner that does what a test says.
class ScriptedPlanner final : public v1::PlanningService::Service {
 public:
  explicit ScriptedPlanner(Script script) : script_(std::move(script)) {
    grpc::ServerBuilder builder;
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    stub_ = v1::PlanningService::NewStub(server_->InProcessChannel({}));
  }
  ~ScriptedPlanner() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status StreamNextBestTrajectory(grpc::ServerContext*,
                                        const v1::StreamNextBestTrajectoryRequest*,
                                        Writer* writer) override {
    return script_(*writer);
  }
  std::unique_ptr<PlanStream> Open() { return OpenGrpcPlanStream(routes_, *stub_, {}, kPatience); }

 private:
  Script script_;
  std::unique_ptr<grpc::Server> server_;
  MissionRoutes routes_;
  std::unique_ptr<v1::PlanningService::Stub> stub_;
};

v1::StreamNextBestTrajectoryResponse PlanOf(PlanId id) {
  Plan plan;
  plan.id = id;
  plan.robot = "scout";
  v1::StreamNextBestTrajectoryResponse response;
  *response.mutable_plan() = ToProto(plan, "house");
  return response;
}

TEST(GrpcPlanStreamTest, PlansComeInOrderAndTheLastIsTheRobots) {
  ScriptedPlanner planner([](Writer& writer) {
    writer.Write(PlanOf(0));
    writer.Write(PlanOf(7));
    return grpc::Status::OK;
  });
  const auto stream = planner.Open();
  EXPECT_EQ((**stream->Read(kPatience)).id, 0);
  EXPECT_EQ((**stream->Read(kPatience)).id, 7);
  EXPECT_EQ(*stream->Read(kPatience), std::nullopt);
  EXPECT_EQ(*stream->Read(kPatience), std::nullopt) << "it stays at its end";
}

TEST(GrpcPlanStreamTest, ARefusalIsTheServers) {
  ScriptedPlanner planner(
      [](Writer&) { return grpc::Status(grpc::StatusCode::NOT_FOUND, "no such robot"); });
  EXPECT_TRUE(absl::IsNotFound(planner.Open()->Read(kPatience).status()));
}

TEST(GrpcPlanStreamTest, ADeadlineOfTheServerIsNotThatOfTheReader) {
  ScriptedPlanner planner(
      [](Writer&) { return grpc::Status(grpc::StatusCode::DEADLINE_EXCEEDED, "too late"); });
  EXPECT_TRUE(absl::IsUnavailable(planner.Open()->Read(kPatience).status()));
}

TEST(GrpcPlanStreamTest, APlanThatCannotBeReadIsTheServersFault) {
  ScriptedPlanner planner([](Writer& writer) {
    writer.Write({});
    return grpc::Status::OK;
  });
  EXPECT_TRUE(absl::IsInternal(planner.Open()->Read(kPatience).status()));
}

TEST(GrpcPlanStreamTest, CancelEndsIt) {
  absl::Notification over;
  ScriptedPlanner planner([&](Writer&) {
    over.WaitForNotification();
    return grpc::Status::OK;
  });
  const auto stream = planner.Open();
  EXPECT_TRUE(absl::IsDeadlineExceeded(stream->Read(absl::ZeroDuration()).status()));
  stream->Cancel();
  EXPECT_TRUE(absl::IsCancelled(stream->Read(kPatience).status()));
  over.Notify();
}

}  // namespace grpc_plan_stream_test
}  // namespace plumescout::client
