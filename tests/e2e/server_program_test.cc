// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What an operator sees of the real program: its log, metrics and health; and that the program does
// not depend on who reads them.
#include "tests/e2e/server_program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "absl/time/clock.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "tests/server/http_client.h"
#include "tests/support/temp_folder.h"

namespace plumescout::e2e {
namespace server_program_test {

using server::HttpExchange;
using server::HttpGet;
using ::testing::EndsWith;

// Many times what a drain takes, on any machine.
constexpr absl::Duration kDrain = absl::Seconds(30);

// Where the program's log goes: a pipe that takes so much before somebody reads.
struct LogPipe {
  explicit LogPipe(int bytes = 4096) {
    EXPECT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
    EXPECT_GE(fcntl(ends[1], F_SETPIPE_SZ, bytes), bytes);
  }
  ~LogPipe() {
    CloseReader();
    CloseWriter();
  }
  void CloseReader() { Close(ends[0]); }
  void CloseWriter() { Close(ends[1]); }
  static void Close(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
  std::string ReadAll() {
    std::string text;
    std::array<char, 4096> part{};
    for (ssize_t count = 0; (count = read(ends[0], part.data(), part.size())) > 0;) {
      text.append(part.data(), static_cast<std::size_t>(count));
    }
    return text;
  }

  std::array<int, 2> ends{-1, -1};
};

class Missions {
 public:
  explicit Missions(const ServerProgram& program)
      : stub_(v1::MissionService::NewStub(
            grpc::CreateChannel(program.target(), grpc::InsecureChannelCredentials()))) {}

  grpc::StatusCode Create(const std::string& id) {
    v1::CreateMissionRequest request;
    request.set_mission_id(id);
    v1::CreateMissionResponse response;
    grpc::ClientContext context;
    return stub_->CreateMission(&context, request, &response).error_code();
  }
  grpc::StatusCode Get(const std::string& name) {
    v1::GetMissionRequest request;
    request.set_name(name);
    v1::GetMissionResponse response;
    grpc::ClientContext context;
    context.set_deadline(absl::ToChronoTime(absl::Now() + absl::Seconds(60)));
    return stub_->GetMission(&context, request, &response).error_code();
  }

 private:
  const std::unique_ptr<v1::MissionService::Stub> stub_;
};

// The value on the line that begins with `name`; -1 if there is none.
double MetricOf(const ServerProgram& program, const std::string& name) {
  const std::string text = HttpGet(program.http_port(), "/metrics").body;
  for (absl::string_view line : absl::StrSplit(text, '\n')) {
    double value = 0.0;
    if (absl::ConsumePrefix(&line, name + " ") && absl::SimpleAtod(line, &value)) return value;
  }
  return -1.0;
}

TEST(ServerProgramTest, MetricsAndHealthAreServedBesideTheService) {
  LogPipe log;
  ServerProgram program({}, log.ends[1]);
  ASSERT_TRUE(program.listens());
  ASSERT_GT(program.http_port(), 0);
  Missions missions(program);
  EXPECT_EQ(missions.Create("hall"), grpc::StatusCode::OK);
  EXPECT_EQ(missions.Create("hall"), grpc::StatusCode::ALREADY_EXISTS);
  EXPECT_EQ(missions.Create("hall"), grpc::StatusCode::ALREADY_EXISTS);
  const std::string calls = "plumescout_rpc_calls_total{code=";
  const std::string create = R"(,method="CreateMission",service="MissionService"})";
  EXPECT_EQ(MetricOf(program, calls + R"("OK")" + create), 1);
  EXPECT_EQ(MetricOf(program, calls + R"("ALREADY_EXISTS")" + create), 2);
  EXPECT_EQ(MetricOf(program, "plumescout_missions"), 1);
  EXPECT_EQ(HttpGet(program.http_port(), "/healthz").code, 200);
  EXPECT_EQ(HttpGet(program.http_port(), "/readyz").code, 200);
  EXPECT_EQ(HttpGet(program.http_port(), "/").code, 404);
  program.Terminate();
  EXPECT_EQ(program.AwaitExit(kDrain), 0);
}

TEST(ServerProgramTest, NoAddressNoHttp) {
  LogPipe log;
  ServerProgram program({"--set", "observe.http_listen="}, log.ends[1]);
  EXPECT_TRUE(program.listens());
  EXPECT_EQ(program.http_port(), 0);
}

TEST(ServerProgramTest, ConsoleIsServedIfAskedFor) {
  const TempFolder pages;
  std::ofstream(pages.File("index.html")) << "<p>console";
  LogPipe log;
  ServerProgram program({"--http", "127.0.0.1:0", "--http-root", pages.path()}, log.ends[1]);
  ASSERT_TRUE(program.listens());
  ASSERT_GT(program.console_port(), 0);
  EXPECT_THAT(HttpExchange(program.console_port(),
                           "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"),
              EndsWith("<p>console"));
  program.Terminate();
  EXPECT_EQ(program.AwaitExit(kDrain), 0);
  ServerProgram without({"--http", "127.0.0.1:0", "--http-root", pages.File("none")}, log.ends[1]);
  EXPECT_EQ(without.AwaitExit(absl::Seconds(60)), 1);
}

TEST(ServerProgramTest, HttpAddressInUseIsAnError) {
  LogPipe log;
  ServerProgram first({}, log.ends[1]);
  ServerProgram second({"--set", absl::StrCat("observe.http_listen=127.0.0.1:", first.http_port())},
                       log.ends[1]);
  EXPECT_FALSE(second.listens());
  EXPECT_EQ(second.AwaitExit(absl::Seconds(60)), 1);
}

TEST(ServerProgramTest, LogThatNobodyReadsHoldsUpNeitherCallsNorTheEnd) {
  LogPipe log;
  ServerProgram program({"--set", "observe.log_level=debug"}, log.ends[1]);
  ASSERT_TRUE(program.listens());
  Missions missions(program);
  // Each fills half a kilobyte of the log, of which a megabyte is kept.
  const std::string long_name(500, 'x');
  constexpr int kCalls = 6000;
  for (int i = 0; i < kCalls; ++i) {
    ASSERT_EQ(missions.Get(long_name), grpc::StatusCode::INVALID_ARGUMENT);
  }
  const double dropped = MetricOf(program, "plumescout_log_lines_dropped_total");
  EXPECT_GT(dropped, 0);
  EXPECT_LT(dropped, kCalls);
  program.Terminate();
  EXPECT_EQ(program.AwaitExit(kDrain), 0);
}

TEST(ServerProgramTest, LogWhoseReaderHasGoneEndsNothing) {
  LogPipe log;
  ServerProgram program({}, log.ends[1]);
  ASSERT_TRUE(program.listens());
  log.CloseReader();
  log.CloseWriter();
  Missions missions(program);
  EXPECT_EQ(missions.Create("hall"), grpc::StatusCode::OK);  // is logged
  EXPECT_EQ(missions.Get("missions/hall"), grpc::StatusCode::OK);
  program.Terminate();
  EXPECT_EQ(program.AwaitExit(kDrain), 0);
}

TEST(ServerProgramTest, LogIsWrittenToItsEnd) {
  LogPipe log(1 << 16);
  ServerProgram program({"--log-format", "json"}, log.ends[1]);
  ASSERT_TRUE(program.listens());
  Missions missions(program);
  EXPECT_EQ(missions.Create("hall"), grpc::StatusCode::OK);
  program.Terminate();
  EXPECT_EQ(program.AwaitExit(kDrain), 0);
  log.CloseWriter();
  std::vector<std::string> events;
  for (const absl::string_view line : absl::StrSplit(log.ReadAll(), '\n', absl::SkipEmpty())) {
    const auto json = nlohmann::json::parse(line, nullptr, /*allow_exceptions=*/false);
    ASSERT_TRUE(json.is_object()) << line;
    events.push_back(json["event"].get<std::string>());
    if (events.back() == "mission created") {
      EXPECT_EQ(json["mission"].get<std::string>(), "hall");
    }
  }
  // Whoever finds the port open may be quicker than the line that says so.
  ASSERT_THAT(events, ::testing::UnorderedElementsAre("descriptors", "serving", "mission created",
                                                      "draining", "stopped"));
  EXPECT_EQ(events.front(), "descriptors");
  EXPECT_EQ(events.back(), "stopped");
}

}  // namespace server_program_test
}  // namespace plumescout::e2e
