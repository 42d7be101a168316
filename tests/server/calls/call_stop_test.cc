// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/call_stop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <memory>
#include <utility>

#include "absl/synchronization/notification.h"
#include "plumescout/v1/system_service.grpc.pb.h"
#include "server/calls/door.h"
#include "server/calls/service_context.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_clients.h"

namespace plumescout::server {
namespace call_stop_test {

// Hands each call over to the test.
class HeldService final : public v1::SystemService::CallbackService {
 public:
  HeldService() { context_.door = &door_; }
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const v1::GetServerInfoRequest*,
                                          v1::GetServerInfoResponse*) override {
    return UnaryCall::Start(context_, Rpc::kGetServerInfo, context,
                            [&](const std::shared_ptr<UnaryCall>& call) {
                              call_.set_value(call);
                              return absl::OkStatus();
                            });
  }
  std::shared_ptr<UnaryCall> TakeCall() { return call_.get_future().get(); }

 private:
  const Door door_;
  ServiceContext context_;
  std::promise<std::shared_ptr<UnaryCall>> call_;
};

class CallStopTest : public testing::Test {
 protected:
  void SetUp() override {
    grpc::ServerBuilder builder;
    builder.RegisterService(&service_);
    server_ = builder.BuildAndStart();
    stub_ = v1::SystemService::NewStub(server_->InProcessChannel({}));
    SetPatience(context_);
  }
  void TearDown() override {
    call_->Answer(absl::OkStatus());
    call_ = nullptr;
    done_.WaitForNotification();
    server_->Shutdown();
  }
  void Begin() {
    stub_->async()->GetServerInfo(&context_, &request_, &response_,
                                  [this](grpc::Status) { done_.Notify(); });
    call_ = service_.TakeCall();
  }

  HeldService service_;
  std::unique_ptr<grpc::Server> server_;
  std::unique_ptr<v1::SystemService::Stub> stub_;
  grpc::ClientContext context_;
  const v1::GetServerInfoRequest request_;
  v1::GetServerInfoResponse response_;
  absl::Notification done_;
  std::shared_ptr<UnaryCall> call_;
  const std::shared_ptr<MissionHost> host_ =
      std::make_shared<MissionHost>(HostParts(), HostOptions{});
};

TEST_F(CallStopTest, GoesOnUntilThereIsAReason) {
  Begin();
  const CallStop stop(call_, host_);
  EXPECT_FALSE(stop.stops());
  EXPECT_TRUE(stop.AnswerOf(absl::OkStatus()).ok());
  EXPECT_TRUE(absl::IsNotFound(stop.AnswerOf(absl::NotFoundError("x"))));
}

TEST_F(CallStopTest, EndOfTheMissionIsTheReasonThatIsGiven) {
  Begin();
  const CallStop stop(call_, host_);
  host_->EndWaits(absl::UnavailableError("the server is going down"));
  EXPECT_TRUE(stop.stops());
  EXPECT_TRUE(absl::IsUnavailable(stop.AnswerOf(absl::CancelledError("cut short"))));
  EXPECT_TRUE(stop.AnswerOf(absl::OkStatus()).ok());  // it was ready all the same
}

TEST_F(CallStopTest, CallerWhoGivesUpIsOne) {
  Begin();
  const CallStop stop(call_, host_);
  absl::Notification cancelled;
  call_->WhenCancelled([&] { cancelled.Notify(); });
  context_.TryCancel();
  cancelled.WaitForNotification();
  EXPECT_TRUE(stop.stops());
}

TEST_F(CallStopTest, LeavesNoListener) {
  Begin();
  { const CallStop stop(call_, host_); }
  EXPECT_EQ(host_->end_listeners().size(), 0);
}

}  // namespace call_stop_test
}  // namespace plumescout::server
