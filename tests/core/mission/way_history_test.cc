// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/way_history.h"

#include <algorithm>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/core/mission/kept_way.h"
#include "tests/support/box_room.h"

namespace plumescout {
namespace way_history_test {

using ::testing::HasSubstr;

using support::kSecond_ns;

class WayHistoryTest : public support::KeptWay {};

TEST_F(WayHistoryTest, KeepsKeyScansAndCountsTheOthers) {
  for (int i = 0; i < 5; ++i) Scan(1.0 + 0.01 * i, i * kSecond_ns / 10);
  Scan(1.2, kSecond_ns / 2);
  Scan(1.2, 2 * kSecond_ns);
  const std::vector<PlacedScan> scans = history_.ScansFrom(0);
  ASSERT_EQ(scans.size(), 3u);
  EXPECT_EQ(scans[0].times, 5);
  EXPECT_EQ(scans[0].pose.x_m, 1.0);
  EXPECT_EQ(scans[1].times, 1) << "moved";
  EXPECT_EQ(scans[2].times, 1) << "stood for a second";
  EXPECT_EQ(history_.bytes(), 3 * (104 + 160 + 720));
  history_.CloseKeyScans();
  Scan(1.2, 2 * kSecond_ns);
  EXPECT_EQ(history_.ScansFrom(0).size(), 4u);
  EXPECT_EQ(history_.ScansFrom(history_.next_number() - 1).size(), 1u);
}

// Also once they are merged.
TEST(WayHistoryOfGases, TellsReadingsOfGasesApart) {
  MissionOptions options;
  options.gas_species.resize(2);
  options.gas_species[0].name = "methane";
  options.gas_species[1].name = "ozone";
  WayHistory history(options);
  for (int i = 0; i < 6; ++i) {
    const std::size_t species = i < 2 ? 0 : 1;
    history.AddReading("a", i * kSecond_ns, {1.0 + i, 1.5, 0.0}, {2.0, 0.0}, false, {}, species);
  }
  EXPECT_EQ(history.bytes(), 6 * 136);
  for (int t = 0; t < 300; ++t) {
    const Pose2 pose{1.0 + 0.1 * (t % 40), 1.5, 0.0};
    history.AddScan("a", (10 + t) * kSecond_ns, pose, support::ScanInBox(pose, 6, 3), {}, false);
  }
  OccupancyGrid whole = history.Base();
  InsertAll(history.ScansFrom(0), {}, whole);
  for (const bool merged : {false, true}) {
    // Room for the map and six readings.
    if (merged) history.Trim(5 * static_cast<std::int64_t>(whole.geometry().size()) + 6 * 500);
    EXPECT_EQ(history.ScansFrom(0).empty(), merged);
    const std::vector<WayHistory::Heard> heard = history.HeardReadings();
    const std::vector<ReadingStore> readings = history.Readings(heard);
    EXPECT_EQ(readings[0].counters().readings, 2) << merged;
    EXPECT_EQ(readings[1].counters().readings, 4) << merged;
    const std::vector<SampledCells> sampled = history.Sampled(heard);
    for (const std::size_t species : {0U, 1U}) {
      const auto cells = sampled[species].On({0.0, 0.0, 0.1, 80, 20}).values();
      EXPECT_EQ(std::count(cells.begin(), cells.end(), 1), species == 0 ? 2 : 4) << merged;
    }
    EXPECT_EQ(sampled[1].Nearest({5.05, 1.55})->time_ns, 4 * kSecond_ns) << merged;
  }
}

TEST_F(WayHistoryTest, ReckonsWithLongNamesOfSensors) {
  GasSensor sensor;
  sensor.id = std::string(60, 's');
  for (int i = 0; i < 8; ++i) {
    history_.AddReading("a", i * kSecond_ns, {1.0, 1.5, 0.0}, {2.0, 0.0}, i >= 6, sensor);
  }
  EXPECT_EQ(history_.bytes(), 8 * (136 + 61));
  history_.DropQuarantined("a");
  EXPECT_EQ(history_.bytes(), 6 * (136 + 61));
  history_.Trim(4 * (136 + 61));
  EXPECT_LE(history_.bytes(), 4 * (136 + 61)) << "or it keeps nothing";
}

TEST_F(WayHistoryTest, WhatIsInQuarantineCountsForNothing) {
  Read(1.0, 0);
  const std::int64_t from = history_.next_number();
  Read(2.0, kSecond_ns);
  Scan(2.0, kSecond_ns);
  EXPECT_FALSE(history_.was_used());
  history_.Quarantine("a", from);
  EXPECT_TRUE(history_.was_used());
  EXPECT_TRUE(history_.HasQuarantined("a"));
  EXPECT_EQ(Readings().counters().readings, 1);
  EXPECT_TRUE(history_.ScansFrom(0).empty());
  history_.DropQuarantined("a");
  EXPECT_FALSE(history_.HasQuarantined("a"));
  EXPECT_EQ(history_.bytes(), 136);
}

TEST_F(WayHistoryTest, ACorrectionThatCoversTheQuarantineEndsIt) {
  for (int t = 0; t < 10; ++t) Read(1.0 + t, t * kSecond_ns, /*quarantined=*/t >= 5);
  const auto before = history_.Correct("a", 10 * kSecond_ns, {{2 * kSecond_ns, {3.0, 2.0, 0.0}}});
  ASSERT_TRUE(before.ok()) << before.status();
  EXPECT_FALSE(before->covers_doubt);
  EXPECT_EQ(Places().size(), 5u);
  const auto covers = history_.Correct(
      "a", 10 * kSecond_ns, {{4 * kSecond_ns, {5.0, 2.0, 0.0}}, {5 * kSecond_ns, {6.0, 4.0, 0.0}}});
  ASSERT_TRUE(covers.ok()) << covers.status();
  EXPECT_TRUE(covers->covers_doubt);
  const std::vector<Point2> places = Places();
  ASSERT_EQ(places.size(), 10u);
  EXPECT_NEAR(places[3].y_m, 2.0, 1e-9);
  EXPECT_NEAR(places[9].x_m, 10.0, 1e-9);
  EXPECT_NEAR(places[9].y_m, 4.0, 1e-9);
}

TEST_F(WayHistoryTest, ACorrectionOfAnEarlierDoubtLeavesThePresentOne) {
  for (int t = 0; t < 30; ++t) Read(1.0, t * kSecond_ns, /*quarantined=*/t < 3 || t >= 25);
  const std::int64_t present = history_.next_number() - 5;
  const auto covers =
      history_.Correct("a", 30 * kSecond_ns, {{2 * kSecond_ns, {1.0, 2.0, 0.0}}}, present);
  ASSERT_TRUE(covers.ok()) << covers.status();
  EXPECT_FALSE(covers->covers_doubt);
  EXPECT_EQ(Places().size(), 25u);
}

TEST_F(WayHistoryTest, TellsByHowMuchAPoseWasMovedAtMost) {
  for (int t = 0; t < 4; ++t) Scan(1.0 + t, t * kSecond_ns);
  const auto moved_m = [this](std::vector<PoseAnchor> anchors) {
    const auto corrected = history_.Correct("a", 2 * kSecond_ns, anchors);
    EXPECT_TRUE(corrected.ok()) << corrected.status();
    return corrected->moved_m;
  };
  EXPECT_EQ(moved_m({{kSecond_ns, {2.0, 1.5, 0.0}}}), 0.0);
  EXPECT_NEAR(moved_m({{0, {1.0, 1.5, 0.0}}, {2 * kSecond_ns, {3.0, 1.7, 0.0}}}), 0.2, 1e-9);
  // About its place at the start: farthest off 2 s later, and what it saw turns with it.
  EXPECT_NEAR(moved_m({{0, {1.0, 1.5, 0.01}}, {2 * kSecond_ns, {3.0, 1.7, 0.01}}}), 0.03, 1e-9);
}

TEST_F(WayHistoryTest, WhatCameAfterTheCorrectionIsRight) {
  Read(1.0, kSecond_ns);
  Read(2.0, 3 * kSecond_ns);
  ASSERT_TRUE(history_.Correct("a", 2 * kSecond_ns, {{kSecond_ns, {1.0, 2.5, 0.0}}}).ok());
  const std::vector<Point2> places = Places();
  EXPECT_EQ(places[0], (Point2{1.0, 2.5}));
  EXPECT_EQ(places[1], (Point2{2.0, 1.5}));
}

TEST_F(WayHistoryTest, TheStartOfAWayMovesWithIt) {
  Read(1.0, kSecond_ns);
  Read(2.0, 3 * kSecond_ns);
  WayPoint start{kSecond_ns, {1.0, 1.5, 0.0}};
  WayPoint later{4 * kSecond_ns, {2.0, 1.5, 0.0}};
  const std::vector<PoseAnchor> up = {{kSecond_ns, {1.0, 2.5, 0.0}}};
  ASSERT_TRUE(history_.Correct("a", 3 * kSecond_ns, up, 0, &start).ok());
  EXPECT_EQ(start.pose.position(), (Point2{1.0, 2.5}));
  ASSERT_TRUE(history_.Correct("a", 3 * kSecond_ns, up, 0, &later).ok());
  EXPECT_EQ(later.pose.position(), (Point2{2.0, 1.5})) << "it was taken after the correction";
}

TEST_F(WayHistoryTest, RefusesWhatItCannotCorrect) {
  Read(1.0, kSecond_ns);
  const auto message = [&](std::vector<PoseAnchor> anchors, const char* robot = "a") {
    const auto corrected = history_.Correct(robot, 9 * kSecond_ns, anchors);
    EXPECT_EQ(corrected.status().code(), absl::StatusCode::kInvalidArgument);
    return std::string(corrected.status().message());
  };
  EXPECT_THAT(message({{5, {}}}), HasSubstr("anchors[0].sample_time_ns = 5 is before"));
  EXPECT_THAT(message({{5, {}}}, "b"), HasSubstr("anchors[0].sample_time_ns = 5"));
  EXPECT_THAT(message({{kSecond_ns, {1001.0, 0.0, 0.0}}}), HasSubstr("anchors[0].pose"));
  EXPECT_EQ(Places()[0], (Point2{1.0, 1.5}));
  Read(999.0, 2 * kSecond_ns);
  EXPECT_THAT(message({{kSecond_ns, {900.0, 0.0, 0.0}}}), HasSubstr("beyond pose_limit_m"));
  EXPECT_EQ(Places()[0], (Point2{1.0, 1.5}));
  MissionOptions without;
  without.keep_scans = false;
  WayHistory none(without);
  none.AddReading("a", 5, {}, {}, false);
  const auto refused = none.Correct("a", 9, {{5, {}}});
  EXPECT_EQ(refused.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(refused.status().message()), HasSubstr("keep_scans"));
}

}  // namespace way_history_test
}  // namespace plumescout
