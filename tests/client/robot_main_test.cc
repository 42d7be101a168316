// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The program plumescout-robot as a robot's own program sees it: lines in, lines out, an exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "client/grpc_planner_client.h"
#include "formats/file_io.h"
#include "formats/map_server.h"
#include "server/server.h"
#include "tests/client/recorded_run.h"
#include "tests/support/box_room.h"
#include "tests/support/program_path.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace robot_main_test {

constexpr Pose2 kPose = {1.5, 1.0, 0.0};
constexpr std::int64_t kStep_ns = 100'000'000;
constexpr int kMostSteps = 3000;  // far beyond what a plan takes on any machine

std::string Read(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// What a robot that stands in a room of 5 x 4 m writes at one moment.
std::string LinesAt(std::int64_t time_ns, bool with_scan = true) {
  std::vector<std::string> ranges;
  const Scan scan = support::ScanInBox(kPose, 5.0, 4.0);
  for (const float range_m : scan.ranges_m) {
    ranges.push_back(std::isfinite(range_m) ? absl::StrCat(range_m) : "null");
  }
  const std::string pose =
      absl::StrCat(R"({"type":"pose","time_ns":)", time_ns, R"(,"x_m":)", kPose.x_m, R"(,"y_m":)",
                   kPose.y_m, R"(,"yaw_rad":0})", "\n");
  const std::string scan_line =
      absl::StrCat(R"({"type":"scan","time_ns":)", time_ns, R"(,"start_angle_rad":)",
                   scan.start_angle_rad, R"(,"angle_step_rad":)", scan.angle_step_rad,
                   R"(,"max_range_m":8,"ranges_m":[)", absl::StrJoin(ranges, ","), "]}\n");
  return absl::StrCat(pose, with_scan ? scan_line : "", R"({"type":"gas","time_ns":)", time_ns,
                      R"(,"concentration_ppm":3.2})", "\n");
}

class RobotMainTest : public ::testing::Test {
 protected:
  // Runs the program without input. Returns its exit code.
  int Run(const std::string& arguments) {
    return WEXITSTATUS(std::system(Command(arguments, "< /dev/null").c_str()));
  }
  std::string Command(const std::string& arguments, const std::string& input) const {
    return absl::StrCat(support::ProgramPath("plumescout-robot"), " ", arguments, " ", input, " > ",
                        out_, " 2> ", err_);
  }

  TempFolder folder_;
  const std::string out_ = folder_.File("out");
  const std::string err_ = folder_.File("err");
};

TEST_F(RobotMainTest, SaysHowItIsUsed) {
  EXPECT_EQ(Run("--help"), EXIT_SUCCESS);
  const std::string help = Read(out_);
  for (const char* word :
       {"--server", "--mission", "--robot", "--log-dir", "--record", R"("type":"scan")", "twist"}) {
    EXPECT_TRUE(absl::StrContains(help, word)) << word;
  }
}

TEST_F(RobotMainTest, RefusesToStartWithoutNames) {
  EXPECT_NE(Run("--robot scout"), EXIT_SUCCESS);
  EXPECT_TRUE(absl::StrContains(Read(err_), "--mission")) << Read(err_);
}

TEST_F(RobotMainTest, FailsIfTheRobotNeverSaysWhereItIs) {
  EXPECT_EQ(Run("--mission room --robot scout"), EXIT_FAILURE);
  EXPECT_TRUE(absl::StrContains(Read(err_), "plumescout-robot: ")) << Read(err_);
}

// How far the mission is in what the robot has seen.
class AppliedTime {
 public:
  server::EventSink MakeSink() {
    return [this](const Event& event) {
      const auto* received = std::get_if<ObservationReceived>(&event.body);
      if (received == nullptr) return;
      const absl::MutexLock lock(&mutex_);
      latest_ns_ = std::max(latest_ns_, received->observation.sample_time_ns);
    };
  }
  // Whether the mission came to `time_ns` before patience was at its end.
  bool Await(std::int64_t time_ns) const {
    const auto reached = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
      return latest_ns_ >= time_ns;
    };
    const absl::MutexLock lock(&mutex_);
    return mutex_.AwaitWithTimeout(absl::Condition(&reached), kPatience);
  }

 private:
  static constexpr absl::Duration kPatience = absl::Seconds(30);

  mutable absl::Mutex mutex_;
  std::int64_t latest_ns_ ABSL_GUARDED_BY(mutex_) = 0;
};

// A server, and the program as its client with a pipe to its standard input.
class RobotMainWithServerTest : public RobotMainTest {
 protected:
  void SetUp() override {
    signal(SIGPIPE, SIG_IGN);  // the program may end before we stop writing
    server::ServerConfig config;
    config.listen = "127.0.0.1:0";
    server::RegistryHooks hooks;
    hooks.make_event_sink = [this](const MissionId&, const MissionOptions&) {
      return applied_.MakeSink();
    };
    auto server = server::Server::Start(config, hooks);
    ASSERT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
    address_ = absl::StrCat("127.0.0.1:", server_->port());
  }
  void Start(const std::string& arguments) {
    const std::string all =
        absl::StrCat("--server ", address_, " --mission room --robot scout --create-mission ");
    robot_ = popen(Command(all + arguments, "").c_str(), "w");
    ASSERT_NE(robot_, nullptr);
  }
  void Write(const std::string& lines) {
    fputs(lines.c_str(), robot_);
    fflush(robot_);
  }
  int TwistCount() const {
    const std::vector<std::string> parts = absl::StrSplit(Read(out_), "twist");
    return static_cast<int>(parts.size()) - 1;
  }
  // Ends the program's input. Returns its exit code.
  int End() { return WEXITSTATUS(pclose(robot_)); }

  AppliedTime applied_;  // before the server that tells it
  std::unique_ptr<server::Server> server_;
  std::string address_;
  FILE* robot_ = nullptr;
};

TEST_F(RobotMainWithServerTest, DrivesByPlansUntilTheRobotsProgramEnds) {
  Start("");
  Write("this is no message\n");
  bool in_time = true;
  for (int step = 1; in_time && step <= kMostSteps; ++step) {
    if (TwistCount() > 1) break;  // the first has it stand
    Write(LinesAt(step * kStep_ns));
    // The first line of a step has the program send what the step before has shown.
    in_time = applied_.Await((step - 1) * kStep_ns);
  }
  EXPECT_TRUE(in_time);
  EXPECT_EQ(End(), EXIT_FAILURE) << "nobody told it that the mission is over";
  const std::string notes = Read(err_);
  EXPECT_TRUE(absl::StrContains(Read(out_), R"("type":"twist")")) << notes;
  for (const char* note : {"bad line: ", "plan 1 at ", "the robot program has ended"}) {
    EXPECT_TRUE(absl::StrContains(notes, note)) << note << " is not in:\n" << notes;
  }
  const auto map = MakeGrpcPlannerClient({.target = address_})->GetMap("room");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_GT(map->gas_counters.readings, 0);
}

TEST_F(RobotMainWithServerTest, KnowsItsBuildingFromAFileAndDrivesWithoutAScan) {
  Grid<CellState> room({0.0, 0.0, 0.05, 100, 80}, CellState::kOccupied);
  for (int y = 1; y < 79; ++y) {
    for (int x = 1; x < 99; ++x) room[Cell{x, y}] = CellState::kFree;
  }
  ASSERT_TRUE(WriteMapServer(room, folder_.File("room.yaml")).ok());
  Start("--prior-map " + folder_.File("room.yaml"));
  bool in_time = true;
  for (int step = 1; in_time && step <= kMostSteps; ++step) {
    if (TwistCount() > 1) break;  // the first has it stand
    Write(LinesAt(step * kStep_ns, /*with_scan=*/false));
    in_time = applied_.Await((step - 5) * kStep_ns);  // gas is read at 2 Hz, not with every line
  }
  EXPECT_TRUE(in_time);
  EXPECT_EQ(End(), EXIT_FAILURE) << "nobody told it that the mission is over";
  EXPECT_TRUE(absl::StrContains(Read(out_), R"("type":"twist")")) << Read(err_);
  const auto map = MakeGrpcPlannerClient({.target = address_})->GetMap("room");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->occupancy.geometry().resolution_m, 0.05);
  EXPECT_EQ(
      std::count(map->occupancy.values().begin(), map->occupancy.values().end(), CellState::kFree),
      98 * 78);
}

TEST_F(RobotMainTest, RefusesAPriorMapThatIsNone) {
  ASSERT_TRUE(WriteFile(folder_.File("room.yaml"), "image: no.pgm").ok());
  EXPECT_EQ(Run("--mission room --robot scout --prior-map " + folder_.File("room.yaml")),
            EXIT_FAILURE);
  EXPECT_TRUE(absl::StrContains(Read(err_), "room.yaml: ")) << Read(err_);
}

TEST_F(RobotMainWithServerTest, GoesOnWithItsLogWhenItIsKilled) {
  const std::string log_dir = absl::StrCat(" --log-dir ", folder_.File("log"));
  Start(log_dir);
  constexpr int kFirstLife = 20;
  for (int step = 1; step <= kFirstLife; ++step) Write(LinesAt(step * kStep_ns));
  EXPECT_TRUE(applied_.Await((kFirstLife - 5) * kStep_ns));
  EXPECT_EQ(End(), EXIT_FAILURE);
  Start(absl::StrCat(log_dir, " --take-over --time-limit 1"));
  for (int step = kFirstLife + 1; step <= 2 * kFirstLife; ++step) Write(LinesAt(step * kStep_ns));
  EXPECT_EQ(End(), EXIT_SUCCESS);

  const auto map = MakeGrpcPlannerClient({.target = address_})->GetMap("room");
  ASSERT_TRUE(map.ok()) << map.status();
  ASSERT_EQ(map->robots.size(), 1U);
  // Both lives are in one log without a hole: all that the second knows of, the server has.
  EXPECT_TRUE(absl::StrContains(
      Read(err_), absl::StrCat(map->robots[0].applied_sequence, " of ",
                               map->robots[0].applied_sequence, " observations applied")))
      << Read(err_);
}

TEST_F(RobotMainTest, RefusesAFolderThatIsNoneForItsLog) {
  ASSERT_TRUE(WriteFile(folder_.File("log"), "a file").ok());
  const std::string pose = folder_.File("pose");
  ASSERT_TRUE(WriteFile(pose, LinesAt(kStep_ns)).ok());
  const std::string arguments =
      absl::StrCat("--mission room --robot scout --log-dir ", folder_.File("log"));
  EXPECT_EQ(WEXITSTATUS(std::system(Command(arguments, absl::StrCat("< ", pose)).c_str())),
            EXIT_FAILURE);
  EXPECT_TRUE(absl::StrContains(Read(err_), folder_.File("log"))) << Read(err_);
}

TEST_F(RobotMainWithServerTest, RecordsItsRunIfItIsToldWhere) {
  Start("--time-limit 2 --record " + folder_.File("runs"));
  for (int step = 1; step <= 30; ++step) Write(LinesAt(step * kStep_ns));
  EXPECT_EQ(End(), EXIT_SUCCESS) << Read(err_);
  const std::vector<std::string> files = RecordingsIn(folder_.File("runs"));
  ASSERT_EQ(files.size(), 1u) << Read(err_);
  EXPECT_TRUE(absl::StrContains(files[0], "/room/scout.")) << files[0];
  EXPECT_TRUE(absl::StrContains(Read(err_), "recorded in " + files[0])) << Read(err_);
  const RecordedRun run = ReadRun(files[0]);
  EXPECT_EQ(run.torn_end, "");
  EXPECT_EQ(run.Count("/registration"), 1u);
  const auto map = MakeGrpcPlannerClient({.target = address_})->GetMap("room");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(run.Count("/observations"), static_cast<std::size_t>(map->robots[0].applied_sequence));
  EXPECT_GT(run.Count("/robots/scout/scan"), 0u);
  EXPECT_THAT(run.log, testing::Contains("link is up"));
  EXPECT_THAT(run.log, testing::Contains(testing::StartsWith("done after ")));
}

TEST_F(RobotMainWithServerTest, SaysWhatItDidWhenItsTimeIsOver) {
  Start("--time-limit 1");
  for (int step = 1; step <= 20; ++step) Write(LinesAt(step * kStep_ns));
  EXPECT_EQ(End(), EXIT_SUCCESS);
  EXPECT_TRUE(absl::StrContains(Read(err_), "done after ")) << Read(err_);
}

}  // namespace robot_main_test
}  // namespace plumescout::client
