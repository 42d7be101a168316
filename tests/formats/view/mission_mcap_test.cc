// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/view/mission_mcap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "formats/mcap/mcap_journal.h"
#include "foxglove/schemas.pb.h"
#include "plumescout/v1/planning_service.pb.h"
#include "tests/formats/mcap/mcap_files.h"
#include "tests/support/room_run.h"

namespace plumescout {
namespace mission_mcap_test {

using testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kAll = std::numeric_limits<double>::infinity();

class MissionMcapTest : public testing::Test {
 protected:
  // A robot joins, drives around a room and gets a plan on the way.
  std::vector<Event> MakeEvents() {
    std::vector<EventBody> bodies = {RobotRegistered{.robot = "scout", .lease_token = 1}};
    for (const Observation& seen : support::RoomRun()) {
      bodies.push_back(ObservationReceived{"scout", seen});
      if (seen.sequence != 100) continue;
      bodies.push_back(PosteriorRefreshed{seen.sample_time_ns});
      PlanIssued issued;
      issued.plan.robot = "scout";
      issued.plan.explanation = "stays";
      bodies.push_back(issued);
    }
    bodies.push_back(RobotRemoved{"scout"});
    std::vector<Event> events;
    Mission mission{MissionOptions()};
    for (const EventBody& body : bodies) {
      const auto applied = mission.Apply(body);
      EXPECT_TRUE(applied.ok()) << applied.status();
      events.push_back({applied->revision, body});
    }
    digest_ = mission.Digest();
    return events;
  }
  // The file that these make.
  std::string Write(const std::vector<Event>& events, double map_share = kAll) {
    MissionMcap mcap(start_, std::make_unique<Mission>(MissionOptions()), 10.0, map_share);
    std::string bytes;
    for (const Event& event : events) {
      EXPECT_TRUE(mcap.Add(event, EncodeEvent(event)).ok());
      bytes += mcap.Take();
    }
    EXPECT_TRUE(mcap.Finish().ok());
    return bytes + mcap.Take();
  }
  // Messages by topic.
  std::map<std::string, std::vector<McapMessage>> Read(const std::string& bytes) {
    std::map<std::string, std::vector<McapMessage>> read;
    EXPECT_TRUE(WriteFile(path_, bytes).ok());
    auto reader = McapReader::Open(path_);
    EXPECT_TRUE(reader.ok()) << reader.status();
    std::uint64_t last_ns = 0;
    auto message = reader->Next();
    for (; message.ok() && *message; message = reader->Next()) {
      EXPECT_GE((*message)->log_time_ns, last_ns);
      last_ns = (*message)->log_time_ns;
      read[reader->channels().at((*message)->channel).topic].push_back(**message);
    }
    EXPECT_TRUE(message.ok()) << message.status();
    return read;
  }

  const JournalStart start_{.code_version = "1.2.3", .mission_options = "any", .mission = "hall"};
  const TempFolder folder_;
  const std::string path_ = folder_.File("hall.mcap");
  std::uint64_t digest_ = 0;
};

TEST_F(MissionMcapTest, TheMissionReplaysToTheSameState) {
  const std::vector<Event> events = MakeEvents();
  ASSERT_TRUE(WriteFile(path_, Write(events)).ok());
  auto reader = McapJournalReader::Open(path_);
  ASSERT_TRUE(reader.ok()) << reader.status();
  EXPECT_EQ(reader->start(), start_);
  Mission mission{MissionOptions()};
  std::size_t count = 0;
  for (auto event = reader->Next(); event.ok() && *event; event = reader->Next()) {
    ASSERT_LT(count, events.size());
    EXPECT_EQ(EncodeEvent(**event), EncodeEvent(events[count++]));
    ASSERT_TRUE(mission.Apply((*event)->body).ok());
  }
  EXPECT_EQ(count, events.size());
  EXPECT_EQ(mission.Digest(), digest_);
}

TEST_F(MissionMcapTest, TheSameEventsGiveTheSameBytes) {
  const std::vector<Event> events = MakeEvents();
  EXPECT_EQ(Write(events), Write(events));
}

// The run has 200 scans of 20 s, ten a second, and a reading with every third.
TEST_F(MissionMcapTest, ViewersHaveWhatTheyDraw) {
  const std::vector<Event> events = MakeEvents();
  auto read = Read(Write(events));
  EXPECT_EQ(read["/journal"].size(), events.size() + 1);
  EXPECT_EQ(read["/robots/scout/pose"].size(), 100u);
  EXPECT_EQ(read["/robots/scout/scan"].size(), 20u);
  EXPECT_EQ(read["/robots/scout/gas"].size(), 67u);
  EXPECT_EQ(read["/plans"].size(), 1u);
  // Maps at 0.1 s and 10.1 s, and of the end.
  for (const char* topic :
       {"/map/occupancy", "/map/gas/mean", "/map/gas/stddev", "/scene/frontiers"}) {
    EXPECT_EQ(read[topic].size(), 3u) << topic;
  }
  v1::Plan plan;
  ASSERT_TRUE(plan.ParseFromString(read["/plans"][0].data));
  EXPECT_EQ(plan.name(), "missions/hall/plans/1");
  foxglove::LaserScan scan;
  ASSERT_TRUE(scan.ParseFromString(read["/robots/scout/scan"][0].data));
  EXPECT_EQ(scan.timestamp().nanos(), 100'000'000);
  std::set<std::string> lines;
  for (const McapMessage& message : read["/log"]) {
    foxglove::Log log;
    ASSERT_TRUE(log.ParseFromString(message.data));
    lines.insert(log.message());
  }
  EXPECT_EQ(lines, (std::set<std::string>{"joins with a radius of 0.20 m",
                                          "plan to stay: there are no goals", "leaves"}));
}

TEST_F(MissionMcapTest, MapsThatAreTooLargeForTheirShareAreShownFirstAndLast) {
  const std::vector<Event> events = MakeEvents();
  const std::string bytes = Write(events, 0.0);
  auto read = Read(bytes);
  EXPECT_EQ(read["/journal"].size(), events.size() + 1);
  for (const char* topic :
       {"/map/occupancy", "/map/gas/mean", "/map/gas/stddev", "/scene/frontiers"}) {
    ASSERT_EQ(read[topic].size(), 2u) << topic;
    EXPECT_EQ(read[topic][0].log_time_ns, 100'000'000u) << topic;
    EXPECT_EQ(read[topic][1].log_time_ns, 20u * kSecond_ns) << topic;
  }
  EXPECT_LT(bytes.size(), Write(events).size());
}

// Plans with words in them, before anything is seen.
std::vector<Event> ManyPlans(std::size_t bytes) {
  std::vector<Event> events = {{1, RobotRegistered{.robot = "scout", .lease_token = 1}}};
  constexpr std::size_t kWords = 10'000;
  for (std::size_t written = 0; written < bytes; written += kWords) {
    PlanIssued issued;
    issued.plan.robot = "scout";
    issued.plan.explanation = std::string(kWords, 'w');
    events.push_back({static_cast<std::int64_t>(events.size()) + 1, issued});
  }
  return events;
}

TEST_F(MissionMcapTest, WhatWaitsForTheFirstObservationIsBounded) {
  const std::size_t many = 4 * MissionView::kMostEarlyBytes + McapEncoder::kChunkBytes;
  MissionMcap mcap(start_, std::make_unique<Mission>(MissionOptions()), 10.0);
  std::string bytes;
  const std::vector<Event> events = ManyPlans(many);
  for (const Event& event : events) {
    ASSERT_TRUE(mcap.Add(event, EncodeEvent(event)).ok());
    bytes += mcap.Take();
  }
  EXPECT_GT(bytes.size(), 0u) << "all of it waits";
  const Observation seen = support::RoomRun().front();
  const Event first{static_cast<std::int64_t>(events.size()) + 1,
                    ObservationReceived{"scout", seen}};
  ASSERT_TRUE(mcap.Add(first, EncodeEvent(first)).ok());
  ASSERT_TRUE(mcap.Finish().ok());
  const auto read = Read(bytes + mcap.Take());
  const std::vector<McapMessage>& journal = read.at("/journal");
  ASSERT_EQ(journal.size(), events.size() + 2);  // with the start
  EXPECT_EQ(journal.front().log_time_ns, 0u);
  EXPECT_EQ(journal.back().log_time_ns, static_cast<std::uint64_t>(seen.sample_time_ns));
}

TEST_F(MissionMcapTest, WhatComesBeforeTheFirstObservationHasItsTime) {
  const auto read = Read(Write(MakeEvents()));
  EXPECT_EQ(read.at("/journal")[0].log_time_ns, 100'000'000u);
  EXPECT_EQ(read.at("/log")[0].log_time_ns, 100'000'000u);
}

TEST_F(MissionMcapTest, AnObservationOfThePastIsPublishedThenAndLoggedNow) {
  std::vector<Event> events = {
      {1, RobotRegistered{.robot = "a", .lease_token = 1}},
      {2, RobotRegistered{.robot = "b", .lease_token = 1}},
      {3, ObservationReceived{"a", {1, 50 * kSecond_ns, {}, RobotStatus{0.5}}}},
      {4, ObservationReceived{"b", {1, 20 * kSecond_ns, {}, RobotStatus{0.5}}}}};
  const auto read = Read(Write(events));
  const McapMessage& late = read.at("/robots/b/pose")[0];
  EXPECT_EQ(late.log_time_ns, 50u * kSecond_ns);
  EXPECT_EQ(late.publish_time_ns, 20u * kSecond_ns);
}

// Which an independent reader reads too: console/test/mcap.test.ts.
TEST_F(MissionMcapTest, AFileOfBeforeIsStillReplayed) {
  auto reader = McapJournalReader::Open("tests/formats/view/golden/room.mcap");
  ASSERT_TRUE(reader.ok()) << reader.status();
  EXPECT_EQ(reader->start()->mission, "room");
  Mission mission{MissionOptions()};
  auto event = reader->Next();
  for (; event.ok() && *event; event = reader->Next()) {
    ASSERT_TRUE(mission.Apply((*event)->body).ok());
  }
  EXPECT_TRUE(event.ok()) << event.status();
  EXPECT_EQ(mission.revision(), 34);
}

TEST_F(MissionMcapTest, AMissionWithoutObservationsIsAFileToo) {
  const std::vector<Event> events = {{1, RobotRegistered{.robot = "a", .lease_token = 1}}};
  EXPECT_EQ(Read(Write(events)).at("/journal").size(), 2u);
  EXPECT_EQ(Read(Write({})).at("/journal").size(), 1u);
}

TEST_F(MissionMcapTest, WhatTheMissionRefusesIsDataLoss) {
  MissionMcap mcap(start_, std::make_unique<Mission>(MissionOptions()), 1.0);
  const Event unknown{1, RobotRemoved{"nobody"}};
  const absl::Status status = mcap.Add(unknown, EncodeEvent(unknown));
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(std::string(status.message()), HasSubstr("event 1 does not follow"));
  const Event second{2, RobotRegistered{.robot = "a", .lease_token = 1}};
  EXPECT_EQ(mcap.Add(second, EncodeEvent(second)).code(), absl::StatusCode::kDataLoss);
}

}  // namespace mission_mcap_test
}  // namespace plumescout
