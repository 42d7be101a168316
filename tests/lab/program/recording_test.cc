// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <memory>
#include <string>

#include "formats/file_io.h"
#include "formats/journal/journal_file.h"
#include "formats/mcap/mcap_reader.h"
#include "lab/about/about.h"
#include "lab/program/mcap_export.h"
#include "plumescout/v1/options.pb.h"
#include "tests/formats/journal/golden_events.h"
#include "tests/lab/program/robot_runs.h"
#include "tests/support/room_run.h"
#include "tests/support/same_bytes.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace recording_test {

MissionOptions UnusualOptions() {
  MissionOptions options;
  options.occupancy.resolution_m = 0.2;
  options.planning.alpha_per_m = 0.25;
  options.frontier.fixed_gas_threshold_ppm = 7.5;
  options.seed = 42;
  return options;
}

class RecordingTest : public ::testing::Test {
 protected:
  // Applies what a robot saw to a mission, and records it.
  void RecordARun() {
    auto recorder = Recorder::Create(path_, mission_.options());
    ASSERT_TRUE(recorder.ok()) << recorder.status();
    const auto apply = [&](const EventBody& body) {
      const auto applied = mission_.Apply(body);
      ASSERT_TRUE(applied.ok()) << applied.status();
      recorder->Record({applied->revision, body});
    };
    apply(RobotRegistered{.robot = "scout", .radius_m = 0.2, .lease_token = 1});
    const std::vector<Observation> run = support::RoomRun();
    for (std::size_t i = 0; i < 60; ++i) apply(ObservationReceived{"scout", run[i]});
    apply(PosteriorRefreshed{mission_.sample_time_ns()});
    ASSERT_TRUE(recorder->status().ok());
  }

  TempFolder folder_;
  const std::string path_ = folder_.File("below/mission.events");
  Mission mission_{UnusualOptions()};
};

TEST_F(RecordingTest, ReplaysToTheSameMap) {
  RecordARun();
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  EXPECT_EQ(recording->options().occupancy.resolution_m, 0.2);
  EXPECT_EQ(recording->options().planning.alpha_per_m, 0.25);
  EXPECT_EQ(recording->options().frontier.fixed_gas_threshold_ppm, 7.5);
  EXPECT_EQ(recording->options().seed, 42u);

  const auto again = Replay(*recording, 0);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ((*again)->revision(), mission_.revision());
  EXPECT_EQ((*again)->Snapshot()->occupancy->values(), mission_.Snapshot()->occupancy->values());
}

TEST_F(RecordingTest, ReplaysFromAnMcapFileToTheSameState) {
  RecordARun();
  const std::string mcap = folder_.File("mission.mcap");
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  ASSERT_TRUE(ExportMcap(*recording, mcap, 1.0, 0.15).ok());
  EXPECT_TRUE(McapReader::IsMcap(mcap));
  EXPECT_FALSE(std::filesystem::exists(mcap + ".part"));
  auto exported = Recording::Open(mcap);
  ASSERT_TRUE(exported.ok()) << exported.status();
  EXPECT_EQ(exported->code_version(), CodeVersion());
  EXPECT_EQ(exported->options().seed, 42u);
  const auto again = Replay(*exported, 0);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ((*again)->revision(), mission_.revision());
  EXPECT_EQ((*again)->Digest(), mission_.Digest());
  EXPECT_EQ(EndRemark(*exported), "");
}

// Which an independent reader reads too: console/test/mcap.test.ts.
TEST_F(RecordingTest, WhatAServerOfBeforeRecordedIsStillReplayed) {
  auto recording = Recording::Open("tests/formats/view/golden/live.mcap");
  ASSERT_TRUE(recording.ok()) << recording.status();
  EXPECT_EQ(recording->start().mission, "hall");
  const auto mission = Replay(*recording, 0);
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_EQ((*mission)->revision(), 195);
  EXPECT_EQ(EndRemark(*recording), "");
}

TEST_F(RecordingTest, WhatARobotRecordedIsNamedWithWhatToDo) {
  WriteRobotRun(folder_.File("run.mcap"), {});
  const absl::Status status = Recording::Open(folder_.File("run.mcap")).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_NE(status.message().find("robot scout"), std::string::npos) << status;
  EXPECT_NE(status.message().find("plumescout-lab ingest"), std::string::npos) << status;
}

TEST_F(RecordingTest, AnMcapFileThatCannotBeWrittenLeavesNothing) {
  RecordARun();
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  EXPECT_EQ(ExportMcap(*recording, folder_.File("no/such/folder.mcap"), 1.0, 0.15).code(),
            absl::StatusCode::kUnavailable);
}

TEST_F(RecordingTest, ReplaysAMissionThatKnewItsBuilding) {
  MissionOptions options;
  Grid<CellState> map({-0.3, 0.1, 0.1, 30, 20}, CellState::kFree);
  map[Cell{4, 5}] = CellState::kUnknown;
  map[Cell{9, 9}] = CellState::kOccupied;
  options.prior_map = std::make_shared<const Grid<CellState>>(map);
  const auto mission = Mission::Create(options);
  ASSERT_TRUE(mission.ok()) << mission.status();
  auto recorder = Recorder::Create(path_, options);
  ASSERT_TRUE(recorder.ok()) << recorder.status();
  const Observation reading = {1, 1'000'000'000, {1.0, 1.0, 0.0}, GasReading{4.0, 0.0}};
  for (const EventBody& body :
       {EventBody(PosteriorRefreshed{}), EventBody(RobotRegistered{"scout", 0.2, 1}),
        EventBody(ObservationReceived{"scout", reading}),
        EventBody(PosteriorRefreshed{1'000'000'000})}) {
    const auto applied = (*mission)->Apply(body);
    ASSERT_TRUE(applied.ok()) << applied.status();
    recorder->Record({applied->revision, body});
  }
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  ASSERT_NE(recording->options().prior_map, nullptr);
  EXPECT_EQ(*recording->options().prior_map, map);
  const auto again = Replay(*recording, 0);
  ASSERT_TRUE(again.ok()) << again.status();
  const auto before = (*mission)->Snapshot();
  const auto after = (*again)->Snapshot();
  EXPECT_EQ(after->occupancy->values(), before->occupancy->values());
  EXPECT_TRUE(support::SameBytes(*after->gas_mean_ppm, *before->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*after->gas_variance_ppm2, *before->gas_variance_ppm2));
}

TEST_F(RecordingTest, StopsAtTheRevisionAskedFor) {
  RecordARun();
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  const auto early = Replay(*recording, 5);
  ASSERT_TRUE(early.ok()) << early.status();
  EXPECT_EQ((*early)->revision(), 5);
  for (const std::int64_t absent : {std::int64_t{-1}, mission_.revision() + 1}) {
    recording = Recording::Open(path_);
    ASSERT_TRUE(recording.ok()) << recording.status();
    EXPECT_EQ(Replay(*recording, absent).status().code(), absl::StatusCode::kOutOfRange);
  }
}

TEST_F(RecordingTest, TellsHowFarItIs) {
  RecordARun();
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  std::vector<double> shares;
  ASSERT_TRUE(Replay(*recording, 4, [&](double share) { shares.push_back(share); }).ok());
  EXPECT_EQ(shares, (std::vector<double>{0.0, 0.25, 0.5, 0.75}));
}

TEST_F(RecordingTest, RefusesEventsOfAnotherMission) {
  RecordARun();
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  ASSERT_TRUE(recording->Next().ok());  // nobody registered the robot
  EXPECT_EQ(Replay(*recording, 0).status().code(), absl::StatusCode::kDataLoss);
}

TEST_F(RecordingTest, IsOneFileThatKnowsWhoWroteIt) {
  RecordARun();
  const std::filesystem::directory_iterator files(std::filesystem::path(path_).parent_path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  EXPECT_EQ(recording->code_version(), CodeVersion());
  EXPECT_EQ(VersionRemark(CodeVersion()), "");
  EXPECT_NE(VersionRemark("0.0.1").find("0.0.1"), std::string::npos);
  EXPECT_NE(VersionRemark(""), "");
}

TEST_F(RecordingTest, OptionsThatAreNoneAreRefused) {
  v1::MissionOptions out_of_range;
  out_of_range.mutable_occupancy()->set_resolution_m(-1.0);
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path());
  for (const std::string& options : {std::string("no message"), out_of_range.SerializeAsString()}) {
    std::filesystem::remove(path_);
    ASSERT_TRUE(
        JournalFileWriter::Create(path_, {.code_version = "1.0.0", .mission_options = options})
            .ok());
    const absl::Status status = Recording::Open(path_).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    EXPECT_NE(status.message().find(path_), std::string::npos) << status;
  }
}

TEST_F(RecordingTest, ATornEndIsRemarked) {
  RecordARun();
  const std::string bytes = *ReadFile(path_, 1 << 28);
  ASSERT_TRUE(WriteFile(path_, bytes.substr(0, bytes.size() - 1)).ok());
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  const auto again = Replay(*recording, 0);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ((*again)->revision(), mission_.revision() - 1);
  EXPECT_NE(EndRemark(*recording).find("torn"), std::string::npos);
}

TEST_F(RecordingTest, DamageIsAnErrorUnlessItStandsBehind) {
  RecordARun();
  std::string bytes = *ReadFile(path_, 1 << 28);
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  ASSERT_TRUE(WriteFile(path_, bytes).ok());
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  const absl::Status status = Replay(*recording, 0).status();
  EXPECT_TRUE(absl::IsDataLoss(status)) << status;
  EXPECT_NE(status.message().find(path_), std::string::npos) << status;
  recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  EXPECT_TRUE(Replay(*recording, mission_.revision() - 1).ok());
  EXPECT_EQ(EndRemark(*recording), "");
}

// Recordings used to have their options beside them.
TEST_F(RecordingTest, AnOlderRecordingIsReadWithItsOptionsFile) {
  const std::string bytes = *ReadFile("tests/formats/journal/golden/version_3.events", 1 << 20);
  ASSERT_TRUE(MakeFolder(folder_.File("below")).ok());
  ASSERT_TRUE(WriteFile(path_, bytes).ok());
  EXPECT_TRUE(absl::IsNotFound(Recording::Open(path_).status()));
  ASSERT_TRUE(WriteFile(path_ + ".options.json", "{\"seed\": ").ok());
  EXPECT_TRUE(absl::IsInvalidArgument(Recording::Open(path_).status()));
  ASSERT_TRUE(WriteFile(path_ + ".options.json", "{\"occupancy\": {\"resolution_m\": -1}}").ok());
  EXPECT_TRUE(absl::IsInvalidArgument(Recording::Open(path_).status()));
  ASSERT_TRUE(WriteFile(path_ + ".options.json",
                        "{\"seed\": \"42\", \"occupancy\": {\"resolution_m\": 0.2}}")
                  .ok());
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  EXPECT_EQ(recording->options().seed, 42u);
  EXPECT_EQ(recording->code_version(), "");
  Mission mission(recording->options());
  for (const Event& event : support::GoldenEvents()) ASSERT_TRUE(mission.Apply(event.body).ok());
  const auto again = Replay(*recording, 0);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ((*again)->revision(), mission.revision());
  EXPECT_EQ((*again)->Snapshot()->occupancy->values(), mission.Snapshot()->occupancy->values());
}

TEST_F(RecordingTest, ARecordingOfTheVersionBeforeIsRead) {
  auto recording = Recording::Open("tests/formats/journal/golden/version_4.events");
  ASSERT_TRUE(recording.ok()) << recording.status();
  EXPECT_EQ(recording->options().seed, 42u);
  EXPECT_EQ(recording->code_version(), "0.1.0");
  const auto mission = Replay(*recording, 0);
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_EQ((*mission)->revision(), 13);
}

TEST_F(RecordingTest, ANewRecordingReplacesTheOldOne) {
  RecordARun();
  ASSERT_TRUE(Recorder::Create(path_, MissionOptions{}).ok());
  auto recording = Recording::Open(path_);
  ASSERT_TRUE(recording.ok()) << recording.status();
  EXPECT_FALSE((*recording->Next()).has_value());
  EXPECT_EQ(recording->options().seed, MissionOptions{}.seed);
}

TEST_F(RecordingTest, InvalidOptionsAreNotRecorded) {
  MissionOptions options;
  options.gas.prior_precision_per_ppm2 = -1.0;
  EXPECT_TRUE(absl::IsInvalidArgument(Recorder::Create(path_, options).status()));
}

}  // namespace recording_test
}  // namespace plumescout::lab
