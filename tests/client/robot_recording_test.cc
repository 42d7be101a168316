// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_join.h"
#include "tests/client/recorded_run.h"
#include "tests/support/full_disk.h"
#include "tests/support/room_run.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace robot_recording_test {

using std::chrono::seconds;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::SizeIs;

class RobotRecordingTest : public testing::Test {
 protected:
  RobotRecordingTest() {
    options_.folder = folder_.path();
    options_.say = [this](const std::string& text) { said_.push_back(text); };
  }
  void Make() {
    recording_ = std::make_unique<RobotRecording>(
        options_, Participation{.mission = "hall", .robot = "scout"}, std::int64_t{1});
  }
  // Observations from the one of index `first` up to that of `end`.
  void Add(std::size_t first, std::size_t end, std::int64_t missing = 0) {
    for (std::size_t i = first; i < end; ++i) recording_->Add(log_[i], missing, now_);
  }
  std::vector<std::string> Files() const { return RecordingsIn(folder_.path()); }

  const TempFolder folder_;
  RobotRecordingOptions options_;
  RecordingFile::Time now_ = std::chrono::steady_clock::now();
  const std::vector<Observation> log_ = support::RoomRun();
  std::vector<std::string> said_;
  std::unique_ptr<RobotRecording> recording_;
};

TEST_F(RobotRecordingTest, ARunIsAFileOfItsMissionRobotAndTime) {
  Make();
  EXPECT_THAT(Files(), SizeIs(0)) << "there is nothing to tell yet";
  Add(0, log_.size());
  recording_->Finish(0, now_);
  ASSERT_THAT(Files(), SizeIs(1));
  EXPECT_THAT(Files()[0], MatchesRegex(".*/hall/scout\\.[0-9]+T[0-9]+Z\\.mcap"));
  EXPECT_THAT(said_, Contains("recorded in " + Files()[0]));
  const RecordedRun run = ReadRun(Files()[0]);
  EXPECT_EQ(run.torn_end, "");
  EXPECT_EQ(run.Count("/observations"), log_.size());
}

TEST_F(RobotRecordingTest, AChunkEndsInTime) {
  Make();
  Add(0, 10);
  recording_->EndChunkIfDue(now_ + seconds(9));
  EXPECT_EQ(ReadRun(Files()[0]).Count("/observations"), 0u);
  recording_->EndChunkIfDue(now_ + seconds(10));
  const RecordedRun run = ReadRun(Files()[0]);
  EXPECT_EQ(run.Count("/observations"), 10u);
  EXPECT_NE(run.torn_end, "") << "it goes on";
}

TEST_F(RobotRecordingTest, ALongFileIsFollowedByAnotherThatSaysWhoItIs) {
  options_.file.max_file_bytes = 1;
  Make();
  Add(0, 3);  // the head of a file is longer
  EXPECT_THAT(Files(), SizeIs(3));
  for (const std::string& path : Files()) {
    EXPECT_EQ(ReadRun(path).Count("/registration"), 1u);
    EXPECT_EQ(ReadRun(path).Count("/observations"), 1u);
  }
}

TEST_F(RobotRecordingTest, WhatWasDroppedIsInTheLogOfTheFile) {
  Make();
  Add(0, 5);
  Add(8, 9, /*missing=*/3);
  recording_->Finish(/*missing=*/2, now_);
  const RecordedRun run = ReadRun(Files()[0]);
  EXPECT_EQ(run.Count("/observations"), 6u);
  EXPECT_THAT(run.log, testing::ElementsAre("recording: 3 messages are missing",
                                            "recording: 2 messages are missing"));
}

TEST_F(RobotRecordingTest, AFullDiskIsNamedAndTriedAgainLater) {
  bool full = false;
  options_.file.open = support::OpenOnDiskThatFills(full);
  Make();
  Add(0, 10);
  full = true;
  now_ += seconds(10);
  recording_->EndChunkIfDue(now_);
  EXPECT_THAT(absl::StrJoin(said_, "\n"), HasSubstr("No space left on device"));
  full = false;
  Add(10, 30);  // too early
  EXPECT_THAT(Files(), SizeIs(1));
  now_ += seconds(30);
  Add(30, 40);
  recording_->Finish(0, now_);
  ASSERT_THAT(Files(), SizeIs(2));
  std::vector<RecordedRun> runs = {ReadRun(Files()[0]), ReadRun(Files()[1])};
  if (runs[0].torn_end.empty()) std::swap(runs[0], runs[1]);  // both began in one second
  EXPECT_EQ(runs[1].Count("/observations"), 10u);
  EXPECT_THAT(runs[1].log, Contains("recording: 20 messages are missing"));
}

TEST_F(RobotRecordingTest, AFolderThatTakesNoFileIsNamedOnce) {
  options_.folder = "/proc/no-such-place";
  Make();
  Add(0, 10);
  recording_->Finish(0, now_);
  ASSERT_THAT(said_, SizeIs(1));
  EXPECT_THAT(said_[0], HasSubstr("/proc/no-such-place"));
}

}  // namespace robot_recording_test
}  // namespace plumescout::client
