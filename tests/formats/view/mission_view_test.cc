// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a view shows is tested with mission_mcap_test.cc; here is what files need that are written
// while a mission runs.
#include "formats/view/mission_view.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "formats/mcap/mcap_journal.h"
#include "foxglove/schemas.pb.h"
#include "tests/formats/mcap/mcap_files.h"
#include "tests/support/room_run.h"

namespace plumescout {
namespace mission_view_test {

class MissionViewTest : public testing::Test {
 protected:
  MissionViewTest() {
    Apply(RobotRegistered{.robot = "scout", .lease_token = 1});
    for (const Observation& seen : support::RoomRun()) Apply(ObservationReceived{"scout", seen});
  }
  void Apply(const EventBody& body) {
    const auto applied = mission_.Apply(body);
    ASSERT_TRUE(applied.ok()) << applied.status();
    moments_.push_back(MomentAfter({applied->revision, body}, *applied, mission_, timer_));
    moments_.back().record = EncodeEvent(moments_.back().event);
  }
  // Numbers of the events that the file has, and where it is cut off.
  std::vector<std::int64_t> Events(const std::string& bytes, std::string* torn_end = nullptr) {
    std::vector<std::int64_t> numbers;
    EXPECT_TRUE(WriteFile(folder_.File("a.mcap"), bytes).ok());
    auto reader = McapJournalReader::Open(folder_.File("a.mcap"));
    EXPECT_TRUE(reader.ok()) << reader.status();
    if (!reader.ok()) return numbers;
    auto event = reader->Next();
    for (; event.ok() && *event; event = reader->Next()) numbers.push_back((*event)->number);
    EXPECT_TRUE(event.ok()) << event.status();
    if (torn_end != nullptr) *torn_end = reader->torn_end();
    return numbers;
  }

  const TempFolder folder_;
  Mission mission_{MissionOptions()};
  MapTimer timer_{1.0};
  std::vector<MissionMoment> moments_;
  MissionView view_{JournalStart{.mission = "hall"}};
};

TEST_F(MissionViewTest, AChunkThatWasEndedCanBeReadWithoutTheRest) {
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(view_.Add(moments_[i]).ok());
  ASSERT_TRUE(view_.EndChunk().ok());
  const std::string bytes = view_.Take();
  ASSERT_TRUE(view_.EndChunk().ok());
  EXPECT_EQ(view_.ready_bytes(), 0u) << "there was nothing to end";
  std::string torn_end;
  EXPECT_EQ(Events(bytes, &torn_end).size(), 50u);
  EXPECT_NE(torn_end, "");
  for (int i = 50; i < 60; ++i) ASSERT_TRUE(view_.Add(moments_[i]).ok());
  ASSERT_TRUE(view_.Finish(nullptr).ok());
  EXPECT_EQ(Events(bytes + view_.Take(), &torn_end).size(), 60u);
  EXPECT_EQ(torn_end, "");
}

TEST_F(MissionViewTest, AFileMayBeginInTheMiddle) {
  for (int i = 100; i < 110; ++i) ASSERT_TRUE(view_.Add(moments_[i]).ok());
  ASSERT_TRUE(view_.Finish(mission_.Snapshot()).ok());
  const std::vector<std::int64_t> numbers = Events(view_.Take());
  EXPECT_EQ(numbers.front(), 101);
  EXPECT_EQ(numbers.back(), 110);
}

TEST_F(MissionViewTest, GapsAreInTheLog) {
  ASSERT_TRUE(view_.Add(moments_[10]).ok());
  ASSERT_TRUE(view_.Add(moments_[20]).ok());
  ASSERT_TRUE(view_.NoteGap(9, 21).ok());
  ASSERT_TRUE(view_.Finish(nullptr).ok());
  ASSERT_TRUE(WriteFile(folder_.File("a.mcap"), view_.Take()).ok());
  auto reader = McapReader::Open(folder_.File("a.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.status();
  std::string line;
  for (auto message = reader->Next(); message.ok() && *message; message = reader->Next()) {
    if (reader->channels().at((*message)->channel).topic != "/log") continue;
    foxglove::Log log;
    ASSERT_TRUE(log.ParseFromString((*message)->data));
    EXPECT_EQ(log.level(), foxglove::Log::WARNING);
    line = log.message();
  }
  EXPECT_EQ(line, "recording: 9 events are missing before event 21");
}

TEST_F(MissionViewTest, TheMapIsDueByTheMissionsTime) {
  int maps = 0;
  for (const MissionMoment& moment : moments_) maps += moment.belief != nullptr ? 1 : 0;
  EXPECT_EQ(maps, 20);  // of 20 s
  EXPECT_EQ(moments_[0].belief, nullptr) << "nothing was seen yet";
  EXPECT_NE(moments_[1].belief, nullptr);
}

}  // namespace mission_view_test
}  // namespace plumescout
