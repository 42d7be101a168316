// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/ingest_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/belief/belief.h"
#include "lab/program/recording.h"
#include "tests/lab/bags/bag_files.h"
#include "tests/lab/program/robot_runs.h"
#include "tests/support/room_run.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace ingest_command_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

// The command line as a user types it; paths are within a fresh folder.
class IngestCommandTest : public ::testing::Test {
 protected:
  std::string Ingest(const std::string& bag, const std::string& more = "") {
    CLI::App app;
    absl::Status status;
    AddIngestCommand(app, status);
    testing::internal::CaptureStderr();
    try {
      app.parse(absl::StrCat("ingest ", folder_.File(bag), " ", folder_.File("recording"),
                             " --out ", folder_.File("out"), " ", more));
    } catch (const CLI::ParseError& error) {
      status = absl::InvalidArgumentError(error.what());
    }
    stderr_ = testing::internal::GetCapturedStderr();
    return std::string(status.message());
  }
  std::unique_ptr<Mission> Replayed() {
    auto recording = Recording::Open(folder_.File("recording"));
    EXPECT_TRUE(recording.ok()) << recording.status();
    auto mission = Replay(*recording, 0);
    EXPECT_TRUE(mission.ok()) << mission.status();
    return *std::move(mission);
  }

  TempFolder folder_;
  std::string stderr_;
};

TEST_F(IngestCommandTest, BagBecomesAMissionThatIsReplayed) {
  WriteSqliteBag(folder_.File("bag.db3"), RoomBag(20));
  WriteMcapBag(folder_.File("bag.mcap"), RoomBag(20));
  std::string map;
  std::string recording;
  for (const char* bag : {"bag.db3", "bag.mcap"}) {
    ASSERT_EQ(Ingest(bag), "");
    const MapSnapshot replayed = MakeMapSnapshot(*Replayed()->Snapshot());
    EXPECT_EQ(replayed.gas_counters.readings, 20);
    const auto& cells = replayed.occupancy.values();
    EXPECT_GT(std::count(cells.begin(), cells.end(), CellState::kFree), 500);
    const std::string bytes = ReadFile(folder_.File("out/map.pgm"), 1 << 24).value_or("");
    EXPECT_TRUE(map.empty() || bytes == map) << "both kinds of bag give the same map";
    map = bytes;
    const std::string events = ReadFile(folder_.File("recording"), 1 << 24).value_or("");
    EXPECT_TRUE(recording.empty() || events == recording);
    recording = events;
  }
}

TEST_F(IngestCommandTest, OfABagThatWasCutOffTheFrontIsKept) {
  WriteMcapBag(folder_.File("bag"), RoomBag(60));
  CutFile(folder_.File("bag"), 0.5, folder_.File("cut"));
  EXPECT_EQ(Ingest("cut"), "");
  EXPECT_THAT(stderr_, AllOf(HasSubstr("cut off at byte"), HasSubstr("is kept")));
  EXPECT_GT(MakeMapSnapshot(*Replayed()->Snapshot()).gas_counters.readings, 10);
}

TEST_F(IngestCommandTest, WhatARobotRecordedBecomesAMission) {
  const std::vector<Observation> log = support::RoomRun();
  WriteRobotRun(folder_.File("run"), log);
  ASSERT_EQ(Ingest("run"), "");
  const MapSnapshot map = MakeMapSnapshot(*Replayed()->Snapshot());
  EXPECT_EQ(map.gas_counters.readings, 67);
  ASSERT_EQ(map.robots.size(), 1u);
  EXPECT_EQ(map.robots[0].id, "scout");
  EXPECT_EQ(map.robots[0].radius_m, 0.25);
  EXPECT_EQ(map.robots[0].applied_sequence, std::ssize(log));
  EXPECT_GT(map.robots[0].pose.x_m, 10.0) << "in the mission's frame";
}

TEST_F(IngestCommandTest, WhatARobotOfBeforeRecordedStillBecomesAMission) {
  const auto run = ReadFile("tests/formats/view/golden/scout.mcap", 1 << 20);
  ASSERT_TRUE(run.ok()) << run.status();
  ASSERT_TRUE(WriteFile(folder_.File("run"), *run).ok());
  ASSERT_EQ(Ingest("run"), "");
  const MapSnapshot map = MakeMapSnapshot(*Replayed()->Snapshot());
  ASSERT_EQ(map.robots.size(), 1u);
  EXPECT_EQ(map.robots[0].id, "scout");
  EXPECT_EQ(map.gas_counters.readings, 16);
}

TEST_F(IngestCommandTest, OfARobotsRecordingThatWasCutOffTheFrontIsKept) {
  std::vector<Observation> log;
  for (int lap = 0; lap < 10; ++lap) {  // more than one chunk
    for (Observation seen : support::RoomRun()) {
      seen.sequence = std::ssize(log) + 1;
      seen.sample_time_ns += lap * std::int64_t{20'000'000'000};
      log.push_back(std::move(seen));
    }
  }
  WriteRobotRun(folder_.File("run"), log);
  CutFile(folder_.File("run"), 0.9, folder_.File("cut"));
  EXPECT_EQ(Ingest("cut"), "");
  EXPECT_THAT(stderr_, AllOf(HasSubstr("cut off at byte"), HasSubstr("is kept")));
  EXPECT_GT(MakeMapSnapshot(*Replayed()->Snapshot()).gas_counters.readings, 100);
}

TEST_F(IngestCommandTest, ARobotThatSensedNothingIsNamed) {
  WriteRobotRun(folder_.File("run"), {});
  EXPECT_THAT(Ingest("run"), HasSubstr("robot scout has sensed nothing"));
}

TEST_F(IngestCommandTest, WhatIsMissingIsNamed) {
  WriteMcapBag(folder_.File("bag"), RoomBag(3));
  EXPECT_THAT(Ingest("bag", "--scan-topic /front --gas-topic /nose"),
              AllOf(HasSubstr("no scan and no gas reading"),
                    HasSubstr("/scan (sensor_msgs/msg/LaserScan)")));
  EXPECT_THAT(Ingest("bag", "--gas-calibration steep"), HasSubstr("steep"));
  EXPECT_THAT(Ingest("nowhere"), HasSubstr("nowhere"));
}

}  // namespace ingest_command_test
}  // namespace plumescout::lab
