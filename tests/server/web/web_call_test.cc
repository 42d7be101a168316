// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/web_call.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "absl/synchronization/mutex.h"
#include "server/web/grpc_web.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace web_call_test {

using ::testing::HasSubstr;

constexpr char kGetMission[] = "/plumescout.v1.MissionService/GetMission";
constexpr char kWatchMap[] = "/plumescout.v1.MapService/WatchMap";

// Rung by a call, which may do so once more after it has ended.
class Bell {
 public:
  void Ring() {
    const absl::MutexLock lock(&mutex_);
    rung_ = true;
  }
  void Await() {
    const absl::MutexLock lock(&mutex_);
    mutex_.Await(absl::Condition(&rung_));
    rung_ = false;
  }

 private:
  absl::Mutex mutex_;
  bool rung_ = false;
};

// A reader of calls.
class WebCallTest : public ServiceTest {
 protected:
  std::unique_ptr<WebCall> StartCall(const std::string& method,
                                     const google::protobuf::Message& request) {
    WebCall::Parts parts;
    parts.method = method;
    parts.message = request.SerializeAsString();
    parts.timeout = absl::Seconds(60);
    parts.wake = [bell = bell_] { bell->Ring(); };
    return WebCall::Start(server_->InProcessChannel(), std::move(parts));
  }
  // What the call has to say next.
  std::string Next(WebCall& call) {
    while (true) {
      const std::string frames = call.Take();
      if (!frames.empty() || call.ended()) return frames;
      bell_->Await();
    }
  }
  // All that it says until it ends.
  std::string Rest(WebCall& call) {
    std::string all;
    while (!call.ended()) all += Next(call);
    return all;
  }

  const std::shared_ptr<Bell> bell_ = std::make_shared<Bell>();
};

v1::GetMissionRequest OfMission(const std::string& name) {
  v1::GetMissionRequest request;
  request.set_name(name);
  return request;
}

TEST_F(WebCallTest, AnswerIsAMessageAndTrailers) {
  StartServer();
  const auto call = StartCall(kGetMission, OfMission("missions/hall"));
  const std::string answer = Rest(*call);
  EXPECT_THAT(answer, HasSubstr("missions/hall"));
  EXPECT_THAT(answer, ::testing::EndsWith(TrailerFrame(grpc::Status())));
}

TEST_F(WebCallTest, ErrorsComeWithTheirDetails) {
  StartServer();
  const auto call = StartCall(kGetMission, OfMission("missions/other"));
  const std::string answer = Rest(*call);
  EXPECT_THAT(answer, HasSubstr("grpc-status: 5\r\n"));
  EXPECT_THAT(answer, HasSubstr("grpc-status-details-bin: "));
}

TEST_F(WebCallTest, StreamsGoOnUntilTheyAreCancelled) {
  StartServer();
  const std::int64_t lease = Lease();
  v1::WatchMapRequest request;
  request.set_mission("missions/hall");
  const auto call = StartCall(kWatchMap, request);
  EXPECT_FALSE(Next(*call).empty());
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  EXPECT_FALSE(Next(*call).empty());
  EXPECT_FALSE(call->ended());
  call->Cancel();
  EXPECT_THAT(Rest(*call), HasSubstr("grpc-status: 1\r\n"));
}

// Nothing is taken, so a message waits; the call ends all the same, and the server with it.
TEST_F(WebCallTest, CallThatNobodyReadsCanBeCancelled) {
  StartServer();
  v1::WatchMapRequest request;
  request.set_mission("missions/hall");
  const auto call = StartCall(kWatchMap, request);
  bell_->Await();
  call->Cancel();
  EXPECT_THAT(Rest(*call), HasSubstr("grpc-status: 1\r\n"));
}

TEST_F(WebCallTest, CallThatIsDroppedIsOverBeforeItsServer) {
  StartServer();
  v1::WatchMapRequest request;
  request.set_mission("missions/hall");
  for (int i = 0; i < 20; ++i) {
    const auto call = StartCall(kWatchMap, request);
    if (i % 2 == 0) bell_->Await();
  }
  server_ = nullptr;
}

TEST_F(WebCallTest, StreamsEndWithTheServer) {
  StartServer();
  v1::WatchMapRequest request;
  request.set_mission("missions/hall");
  const auto call = StartCall(kWatchMap, request);
  EXPECT_FALSE(Next(*call).empty());
  server_->Drain();
  EXPECT_THAT(Rest(*call), HasSubstr("grpc-status: 14\r\n"));
}

}  // namespace web_call_test
}  // namespace plumescout::server
