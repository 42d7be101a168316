// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>

#include "absl/synchronization/notification.h"
#include "formats/view/mission_mcap.h"
#include "server/missions/mission_maker.h"
#include "server/missions/mission_recovery.h"
#include "tests/server/host_parts.h"
#include "tests/server/missions/recorded_files.h"
#include "tests/server/stored_run.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace recorder_test {

using ::testing::HasSubstr;

class RecorderTest : public testing::Test {
 protected:
  RecorderTest() { options_.folder = folder_.path(); }

  // Applies the events of a run, from the first one on, and tells of each.
  void Drive(RecordingFeed& feed, std::size_t count = 1'000'000) {
    const std::vector<Event> events = RoomRunEvents(MissionOptions());
    while (applied_ < events.size() && count-- > 0) {
      const auto applied = mission_.Apply(events[applied_].body);
      ASSERT_TRUE(applied.ok()) << applied.status();
      feed.Note(events[applied_++], *applied, mission_);
    }
  }

  const TempFolder folder_;
  RecordingOptions options_;
  prometheus::Registry registry_;
  MissionMetrics metrics_{registry_};
  Mission mission_{MissionOptions()};
  std::size_t applied_ = 0;
  const JournalStart start_ = StartOf({.code_version = "1.2", .mission = "hall"}, {});
};

// But for plans: a store keeps less of them.
TEST_F(RecorderTest, TheFileIsThatOfAnExport) {
  options_.map_period_s = 2.0;
  options_.map_share = std::numeric_limits<double>::infinity();
  {
    Recorder recorder(options_, &metrics_);
    const auto feed = recorder.Begin(start_, "hall");
    Drive(*feed);
    feed->End(mission_);
  }
  MissionMcap exported(start_, std::make_unique<Mission>(MissionOptions()), 2.0,
                       options_.map_share);
  for (const Event& event : RoomRunEvents(MissionOptions())) {
    ASSERT_TRUE(exported.Add(event, EncodeEvent(event, PlanDetail::kForReplay)).ok());
  }
  ASSERT_TRUE(exported.Finish().ok());
  ASSERT_TRUE(WriteFile(folder_.File("exported.mcap"), exported.Take()).ok());
  const RecordedFile live = ReadRecording(folder_.File("hall.1.mcap"));
  EXPECT_EQ(live.torn_end, "");
  EXPECT_GT(live.by_topic.at("/map/gas/mean").size(), 5u);
  EXPECT_EQ(live.by_topic, ReadRecording(folder_.File("exported.mcap")).by_topic);
}

TEST_F(RecorderTest, AFileHasAnEndThoughTheMissionHasNone) {
  {
    Recorder recorder(options_, &metrics_);
    Drive(*recorder.Begin(start_, "acme/hall"), 20);
  }
  const RecordedFile file = ReadRecording(folder_.File("acme/hall.1.mcap"));
  EXPECT_EQ(file.events.size(), 20u);
  EXPECT_EQ(file.torn_end, "");
}

// The thread stands still in a write while the mission goes on.
TEST_F(RecorderTest, ASlowDiskCostsEventsAndNobodyWaits) {
  absl::Notification goes_on;
  options_.file.open = [&](const std::string& path) {
    goes_on.WaitForNotification();
    return OpenRecordingFile(path);
  };
  constexpr std::int64_t kRoom = 20'000;  // of some events
  {
    Recorder recorder(options_, &metrics_, kRoom);
    const auto feed = recorder.Begin(start_, "hall");
    Drive(*feed);
    feed->End(mission_);
    goes_on.Notify();
  }
  const RecordedFile file = ReadRecording(folder_.File("hall.1.mcap"));
  EXPECT_FALSE(file.events.empty());
  EXPECT_LT(file.events.size(), applied_ / 2);
  EXPECT_EQ(file.torn_end, "");
  EXPECT_THAT(TextOf(registry_),
              HasSubstr(absl::StrCat("plumescout_recording_dropped_events_total ",
                                     applied_ - file.events.size(), "\n")));
}

TEST_F(RecorderTest, MissionsOfARegistryAreRecorded) {
  std::optional<Recorder> recorder(std::in_place, options_, &metrics_);
  std::uint64_t digest = 0;
  {
    RegistryHooks hooks;
    hooks.recorder = &*recorder;
    const MissionMaker maker({}, hooks);
    const auto host = maker.Make("hall", {}, {"ann", "acme"}).value();
    absl::Notification done;
    ASSERT_TRUE(host->Post([&](MissionWriter& writer) {
                      EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, 7}).ok());
                      host->Ingest(writer, "r1", 7, RoomRunBatch());
                      digest = writer.mission().Digest();
                      done.Notify();
                    })
                    .ok());
    done.WaitForNotification();
  }
  recorder.reset();
  const RecordedFile file = ReadRecording(folder_.File("acme/hall.1.mcap"));
  EXPECT_EQ(file.torn_end, "");
  EXPECT_EQ(DigestOf(file), digest);
}

TEST_F(RecorderTest, AMissionThatComesBackHasAnotherFile) {
  MemoryStore store;
  PutMission(store, "hall", {}, RoomRunEvents(MissionOptions()));
  const auto last = static_cast<std::int64_t>(RoomRunEvents(MissionOptions()).size());
  {
    Recorder recorder(options_, &metrics_);
    RegistryHooks hooks;
    hooks.recorder = &recorder;
    hooks.store = &store;
    const auto host = MissionMaker({}, hooks).Revive("hall", NeverStop()).value();
    absl::Notification done;
    ASSERT_TRUE(host->Post([&](MissionWriter& writer) {
                      EXPECT_TRUE(writer.conduct().Register({"r2", 0.2, 8}).ok());
                      done.Notify();
                    })
                    .ok());
    done.WaitForNotification();
  }
  const RecordedFile file = ReadRecording(folder_.File(absl::StrCat("hall.", last + 1, ".mcap")));
  EXPECT_EQ(file.events, std::vector<std::int64_t>{last + 1});
}

}  // namespace recorder_test
}  // namespace plumescout::server
