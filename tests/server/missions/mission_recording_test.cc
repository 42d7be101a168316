// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "formats/mcap/mcap_journal.h"
#include "server/missions/mission_recovery.h"
#include "tests/server/captured_log.h"
#include "tests/server/missions/recorded_files.h"
#include "tests/server/stored_run.h"
#include "tests/support/full_disk.h"

namespace plumescout::server {
namespace mission_recording_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MissionRecordingTest : public testing::Test {
 protected:
  MissionRecordingTest() {
    options_.folder = folder_.path();
    Mission mission{MissionOptions()};
    MapTimer timer(options_.map_period_s);
    for (const Event& event : RoomRunEvents(MissionOptions())) {
      const auto applied = mission.Apply(event.body);
      EXPECT_TRUE(applied.ok()) << applied.status();
      moments_.push_back(MomentAfter(event, *applied, mission, timer));
    }
    belief_ = mission.Snapshot();
    digest_ = mission.Digest();
  }
  void Make() {
    recording_ = std::make_unique<MissionRecording>(StartOf({.mission = "hall"}, {}), "hall",
                                                    options_, &metrics_);
  }
  // Events from the one of index `first` up to that of `end`.
  void Add(std::size_t first, std::size_t end, std::int64_t missing = 0) {
    for (std::size_t i = first; i < end; ++i) recording_->Add(moments_[i], missing, now_);
  }

  const TempFolder folder_;
  RecordingOptions options_;
  prometheus::Registry registry_;
  MissionMetrics metrics_{registry_};
  SteadyTime now_ = SteadyNow();
  std::vector<MissionMoment> moments_;
  std::shared_ptr<const Belief> belief_;
  std::uint64_t digest_ = 0;
  std::unique_ptr<MissionRecording> recording_;
};

TEST_F(MissionRecordingTest, TheFileReplaysToTheSameState) {
  Make();
  Add(0, moments_.size());
  recording_->Finish(belief_, now_);
  const RecordedFile file = ReadRecording(folder_.File("hall.1.mcap"));
  EXPECT_EQ(file.torn_end, "");
  EXPECT_EQ(file.events.size(), moments_.size());
  EXPECT_EQ(DigestOf(file), digest_);
}

TEST_F(MissionRecordingTest, AChunkEndsInTime) {
  Make();
  Add(0, 10);
  recording_->EndChunkIfDue(now_ + absl::ToChronoSeconds(options_.file.chunk_period) -
                            std::chrono::seconds(1));
  EXPECT_TRUE(ReadRecording(folder_.File("hall.1.mcap")).events.empty());
  recording_->EndChunkIfDue(now_ + absl::ToChronoSeconds(options_.file.chunk_period));
  const RecordedFile file = ReadRecording(folder_.File("hall.1.mcap"));
  EXPECT_EQ(file.events.size(), 10u);
  EXPECT_NE(file.torn_end, "") << "it goes on";
}

TEST_F(MissionRecordingTest, ALongFileIsFollowedByAnother) {
  options_.file.max_file_bytes = 1;
  Make();
  Add(0, 20);  // the head of a file is longer
  recording_->Finish(belief_, now_);
  EXPECT_THAT(ReadRecording(folder_.File("hall.1.mcap")).events, ElementsAre(1));
  EXPECT_THAT(ReadRecording(folder_.File("hall.20.mcap")).events, ElementsAre(20));
  EXPECT_EQ(ReadRecording(folder_.File("hall.20.mcap")).torn_end, "");
}

TEST_F(MissionRecordingTest, FilesOfBeforeStay) {
  for (int life = 0; life < 2; ++life) {
    Make();
    Add(0, 5);
    recording_->Finish(nullptr, now_);
  }
  EXPECT_EQ(ReadRecording(folder_.File("hall.1.mcap")).events.size(), 5u);
  EXPECT_EQ(ReadRecording(folder_.File("hall.1-2.mcap")).events.size(), 5u);
}

TEST_F(MissionRecordingTest, DroppedEventsAreInTheLogOfTheFile) {
  Make();
  Add(0, 5);
  Add(8, 9, /*missing=*/3);
  recording_->Finish(nullptr, now_);
  const RecordedFile file = ReadRecording(folder_.File("hall.1.mcap"));
  EXPECT_THAT(file.events, ElementsAre(1, 2, 3, 4, 5, 9));
  EXPECT_THAT(file.log, testing::Contains("recording: 3 events are missing before event 9"));
}

TEST_F(MissionRecordingTest, AFullDiskIsTriedAgainLater) {
  bool full = false;
  options_.file.open = support::OpenOnDiskThatFills(full);
  Make();
  Add(0, 10);
  full = true;
  now_ += std::chrono::seconds(10);
  const std::string log = LogOf([&] { recording_->EndChunkIfDue(now_); });
  EXPECT_THAT(log, HasSubstr("recording stops"));
  EXPECT_THAT(log, HasSubstr("No space left on device"));
  Add(10, 20);
  full = false;
  Add(20, 30);  // too early
  now_ += std::chrono::seconds(30);
  Add(30, 40);
  recording_->Finish(nullptr, now_);
  const RecordedFile second = ReadRecording(folder_.File("hall.31.mcap"));
  EXPECT_EQ(second.events.size(), 10u);
  EXPECT_THAT(second.log, testing::Contains("recording: 20 events are missing before event 31"));
  const std::string text = TextOf(registry_);
  EXPECT_THAT(text, HasSubstr("plumescout_recording_failures_total 1\n"));
  EXPECT_THAT(text, HasSubstr("plumescout_recording_dropped_events_total 20\n"));
}

TEST_F(MissionRecordingTest, AFolderThatTakesNoFileStopsNothing) {
  options_.folder = "/proc/no-such-place";
  Make();
  EXPECT_THAT(LogOf([&] { Add(0, 3); }), HasSubstr("recording stops"));
  recording_->Finish(belief_, now_);
  EXPECT_THAT(TextOf(registry_), HasSubstr("plumescout_recording_dropped_events_total 3\n"));
}

}  // namespace mission_recording_test
}  // namespace plumescout::server
