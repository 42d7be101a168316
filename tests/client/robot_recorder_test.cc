// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "absl/synchronization/notification.h"
#include "tests/client/recorded_run.h"
#include "tests/support/room_run.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace robot_recorder_test {

using ::testing::ElementsAre;
using ::testing::SizeIs;

constexpr std::int64_t kTick_ns = 100'000'000;

// Counts what it is told.
class Counter final : public RobotObserver {
 public:
  void OnTick(const RobotTick&) override { ++ticks; }
  void OnLogged(const Observation&) override { ++logged; }
  void OnPlan(const PlanArrival&) override { ++plans; }
  void OnReport(PlanId, ProgressOutcome) override { ++reports; }
  void OnPlanFailure(const absl::Status&) override { ++others; }
  void OnPlaceDoubted(bool) override { ++others; }
  void OnRejected(const ObservationRejected&) override { ++others; }
  void OnLink(const absl::Status&) override { ++others; }
  void OnRolledBack(std::int64_t, std::int64_t) override { ++others; }
  void OnDisk(const absl::Status&) override { ++others; }

  int ticks = 0;
  int logged = 0;
  int plans = 0;
  int reports = 0;
  int others = 0;
};

class RobotRecorderTest : public testing::Test {
 protected:
  RobotRecorderTest() { options_.folder = folder_.path(); }
  std::string File() const {
    const std::vector<std::string> files = RecordingsIn(folder_.path());
    EXPECT_THAT(files, SizeIs(1));
    return files.empty() ? "" : files[0];
  }

  const TempFolder folder_;
  RobotRecordingOptions options_;
  const Participation scout_{.mission = "hall", .robot = "scout"};
  Counter next_;
};

TEST_F(RobotRecorderTest, WhatHappensIsInTheFileAndToldToTheNext) {
  const std::vector<Observation> log = support::RoomRun();
  Plan plan;
  plan.id = 1;
  {
    RobotRecorder recorder(options_, scout_, 0, &next_);
    for (const Observation& seen : log) recorder.OnLogged(seen);
    recorder.OnPlan(
        {.time_ns = 21'000'000'000, .elapsed_s = 1, .pose = {}, .plan = plan, .rpc_wall = {}});
    recorder.OnReport(1, ProgressOutcome::kReached);
    recorder.OnPlanFailure(absl::InternalError(""));
    recorder.OnPlaceDoubted(true);
    recorder.OnRejected({});
    recorder.OnLink({});
    recorder.OnRolledBack(0, 0);
    recorder.OnDisk({});
    recorder.OnSaid(true, "a battery is low");
  }
  const RecordedRun run = ReadRun(File());
  EXPECT_EQ(run.torn_end, "");
  EXPECT_EQ(run.Count("/observations"), log.size());
  EXPECT_EQ(run.Count("/plans"), 1u);
  EXPECT_THAT(run.log, ElementsAre("a battery is low"));
  EXPECT_EQ(next_.logged, static_cast<int>(log.size()));
  EXPECT_EQ(next_.plans, 1);
  EXPECT_EQ(next_.reports, 1);
  EXPECT_EQ(next_.others, 6);
}

TEST_F(RobotRecorderTest, PlacesAreKeptEverySecondTick) {
  {
    RobotRecorder recorder(options_, scout_, 0, &next_);
    for (int i = 0; i < 20; ++i)
      recorder.OnTick({.time_ns = i * kTick_ns, .pose = {}, .ingest = {}});
  }
  EXPECT_EQ(ReadRun(File()).Count("/robots/scout/pose"), 10u);
  EXPECT_EQ(next_.ticks, 20);
}

// The thread stands still in a write while the robot goes on.
TEST_F(RobotRecorderTest, ASlowDiskCostsMessagesAndTheRobotDoesNotWait) {
  absl::Notification goes_on;
  options_.file.open = [&](const std::string& path) {
    goes_on.WaitForNotification();
    return OpenRecordingFile(path);
  };
  const std::vector<Observation> log = support::RoomRun();
  constexpr std::int64_t kRoom = 20'000;  // of some scans
  {
    RobotRecorder recorder(options_, scout_, 0, &next_, kRoom);
    for (const Observation& seen : log) recorder.OnLogged(seen);
    goes_on.Notify();
  }
  const RecordedRun run = ReadRun(File());
  EXPECT_EQ(run.torn_end, "");
  EXPECT_GT(run.Count("/observations"), 0u);
  EXPECT_LT(run.Count("/observations"), log.size() / 2);
  std::size_t missing = 0;
  for (const std::string& line : run.log) {
    std::size_t count = 0;
    EXPECT_EQ(std::sscanf(line.c_str(), "recording: %zu messages are missing", &count), 1) << line;
    missing += count;
  }
  EXPECT_EQ(missing, log.size() - run.Count("/observations"));
}

TEST_F(RobotRecorderTest, ARunOfNothingLeavesNoFile) {
  { RobotRecorder recorder(options_, scout_, 0, &next_); }
  EXPECT_THAT(RecordingsIn(folder_.path()), SizeIs(0));
}

}  // namespace robot_recorder_test
}  // namespace plumescout::client
