// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/call_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "server/base/log.h"
#include "tests/server/captured_log.h"

namespace plumescout::server {
namespace call_log_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

CallInfo Call(Rpc rpc) {
  CallInfo info;
  info.rpc = rpc;
  info.request_id = "r7";
  return info;
}

std::string LogOfCall(const CallInfo& info, absl::Duration duration, const absl::Status& status) {
  return LogOf([&] { CallLog(absl::Seconds(1)).Note(info, {status, duration}); });
}

TEST(CallLogTest, SlowCallsAreLoggedWithWhatTheyWaitedFor) {
  const CallInfo info = Call(Rpc::kNextBestTrajectory);
  info.stage_times->Add(Stage::kBelief, absl::Milliseconds(300));
  info.stage_times->Add(Stage::kSearch, absl::Milliseconds(1000));
  info.stage_times->Add(Stage::kSearch, absl::Milliseconds(200));
  EXPECT_THAT(LogOfCall(info, absl::Milliseconds(1600), absl::OkStatus()),
              HasSubstr("WARNING slow call method=PlanningService/NextBestTrajectory "
                        "caller=anonymous code=OK duration_ms=1600 belief_ms=300 search_ms=1200 "
                        "request_id=r7\n"));
}

TEST(CallLogTest, QuickCallsAreForDebugging) {
  const CallInfo info = Call(Rpc::kGetMap);
  EXPECT_THAT(LogOfCall(info, absl::Milliseconds(3), absl::NotFoundError("a\nb")), IsEmpty());
  ConfigureLog({LogLevel::kDebug, LogFormat::kText});
  EXPECT_THAT(LogOfCall(info, absl::Milliseconds(3), absl::NotFoundError("a\nb")),
              HasSubstr("DEBUG call method=MapService/GetMap caller=anonymous code=NOT_FOUND "
                        "duration_ms=3 why=\"a\\nb\" request_id=r7\n"));
  ConfigureLog({});
}

TEST(CallLogTest, StreamsMayLast) {
  EXPECT_THAT(LogOfCall(Call(Rpc::kWatchMap), absl::Hours(1), absl::OkStatus()), IsEmpty());
  EXPECT_THAT(LogOfCall(Call(Rpc::kWatchRobot), absl::Hours(1), absl::OkStatus()), IsEmpty());
  EXPECT_THAT(LogOfCall(Call(Rpc::kStreamNextBestTrajectory), absl::Hours(1), absl::OkStatus()),
              Not(IsEmpty()));
}

TEST(CallLogTest, FailuresOfOursAreErrors) {
  EXPECT_THAT(LogOfCall(Call(Rpc::kGetMap), absl::Milliseconds(3), absl::InternalError("odd")),
              HasSubstr("ERROR call failed method=MapService/GetMap"));
}

}  // namespace call_log_test
}  // namespace plumescout::server
