// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/unary_call.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>

#include "absl/synchronization/notification.h"
#include "plumescout/v1/system_service.grpc.pb.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace unary_call_test {

constexpr auto kUnavailable = absl::StatusCode::kUnavailable;

// A call to CheckTrajectory that is under way.
class Check {
 public:
  Check(v1::PlanningService::Stub& stub, const v1::CheckTrajectoryRequest& request) {
    stub.async()->CheckTrajectory(&context_, &request, &response_, [this](grpc::Status status) {
      status_ = std::move(status);
      done_.Notify();
    });
  }
  ~Check() { Await().IgnoreError(); }
  Check(const Check&) = delete;
  Check& operator=(const Check&) = delete;

  void Cancel() { context_.TryCancel(); }
  bool ended() const { return done_.HasBeenNotified(); }
  absl::Status Await() {
    done_.WaitForNotification();
    return ToAbsl(status_);
  }

 private:
  grpc::ClientContext context_;  // without a deadline
  v1::CheckTrajectoryResponse response_;
  grpc::Status status_;
  absl::Notification done_;
};

class UnaryCallTest : public ServiceTest {
 protected:
  void Start(const ServerConfig& config) {
    StartServer(config);
    request_.set_robot(kRobot);
    request_.set_lease_token(Lease());
    request_.mutable_path()->set_goal_kind(v1::GOAL_KIND_OCCUPANCY_FRONTIER);
    for (const double x_m : {0.0, 1.0}) request_.mutable_path()->add_vertices()->set_x_m(x_m);
  }
  v1::CheckTrajectoryRequest BeyondTheLog() const {
    v1::CheckTrajectoryRequest request = request_;
    request.set_min_applied_sequence(1'000'000);
    return request;
  }
  // Of a call that needs not wait.
  absl::Status CheckNow() {
    return Call(planning_, &v1::PlanningService::Stub::CheckTrajectory, request_).status();
  }

  v1::CheckTrajectoryRequest request_;
};

TEST_F(UnaryCallTest, CancelledWaitsTakeNobodysPlace) {
  constexpr int kCalls = 300;
  ServerConfig config;
  config.limits.max_waiting_calls = 8;
  Start(config);
  const absl::Status before = CheckNow();
  const v1::CheckTrajectoryRequest request = BeyondTheLog();
  for (int i = 0; i < kCalls; ++i) {
    Check call(*planning_, request);
    call.Cancel();
    EXPECT_TRUE(absl::IsCancelled(call.Await()));
  }
  // The server hears of the last ones after we do.
  EXPECT_FALSE(absl::IsResourceExhausted(before)) << before;
  while (CheckNow() != before) {
  }
}

TEST_F(UnaryCallTest, WaitWithoutDeadlineEndsInTime) {
  ServerConfig config;
  config.limits.max_wait_s = 0.1;
  Start(config);
  const v1::CheckTrajectoryRequest request = BeyondTheLog();
  EXPECT_TRUE(absl::IsDeadlineExceeded(Check(*planning_, request).Await()));
}

TEST_F(UnaryCallTest, WaitEndsWithTheServerAndSaysWhenToRetry) {
  ServerConfig config;
  config.limits.max_waiting_calls = 1;
  config.connection.drain_s = 60.0;
  Start(config);
  const v1::CheckTrajectoryRequest request = BeyondTheLog();
  Check first(*planning_, request);
  Check second(*planning_, request);
  // Who is refused found the other one waiting.
  while (!first.ended() && !second.ended()) {
  }
  Check& refused = first.ended() ? first : second;
  Check& waiting = first.ended() ? second : first;
  EXPECT_TRUE(absl::IsResourceExhausted(refused.Await()));
  server_->Drain();
  const absl::Status ended = waiting.Await();
  EXPECT_THAT(ended, Refuses(kUnavailable, "DRAINING"));
  EXPECT_TRUE(RetryDelay(ended).has_value());
}

// A service whose one method does what a test says.
class ScriptedService final : public v1::SystemService::CallbackService {
 public:
  explicit ScriptedService(UnaryCall::Handler script) : script_(std::move(script)) {
    context_.door = &door_;
    grpc::ServerBuilder builder;
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~ScriptedService() override { server_->Shutdown(); }

  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const v1::GetServerInfoRequest*,
                                          v1::GetServerInfoResponse*) override {
    return UnaryCall::Start(context_, Rpc::kGetServerInfo, context, script_);
  }
  absl::Status Ask() {
    const auto stub =
        v1::SystemService::NewStub(server_->InProcessChannel(grpc::ChannelArguments()));
    grpc::ClientContext context;
    SetPatience(context);
    v1::GetServerInfoResponse response;
    return ToAbsl(stub->GetServerInfo(&context, {}, &response));
  }

 private:
  const Door door_;
  ServiceContext context_;
  const UnaryCall::Handler script_;
  std::unique_ptr<grpc::Server> server_;
};

TEST(UnaryCallAnswerTest, CallThatEverybodyLetGoIsAnswered) {
  std::function<void()> task;
  ScriptedService service([&](const std::shared_ptr<UnaryCall>& call) {
    task = [call] { call->Answer(absl::OkStatus()); };  // never run
    task = nullptr;
    return absl::OkStatus();
  });
  EXPECT_TRUE(absl::IsUnavailable(service.Ask()));
}

TEST(UnaryCallAnswerTest, FirstAnswerCounts) {
  ScriptedService service([](const std::shared_ptr<UnaryCall>& call) {
    call->Answer(absl::NotFoundError("first"));
    call->Answer(absl::OkStatus());
    return absl::AbortedError("third");
  });
  EXPECT_TRUE(absl::IsNotFound(service.Ask()));
}

TEST(UnaryCallAnswerTest, RefusalAnswersWithWhatDroppedIt) {
  ScriptedService service([](const std::shared_ptr<UnaryCall>& call) {
    Refusal(call)(absl::NotFoundError("the mission went"));
    return absl::OkStatus();
  });
  EXPECT_TRUE(absl::IsNotFound(service.Ask()));
}

}  // namespace unary_call_test
}  // namespace plumescout::server
