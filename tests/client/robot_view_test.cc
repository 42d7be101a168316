// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "formats/file_io.h"
#include "plumescout/v1/planning_service.pb.h"
#include "plumescout/v1/robot_service.pb.h"
#include "proto/convert/observation.h"
#include "tests/client/recorded_run.h"
#include "tests/support/room_run.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace robot_view_test {

using ::testing::ElementsAre;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class RobotViewTest : public testing::Test {
 protected:
  RecordedRun Read() {
    EXPECT_TRUE(view_.Finish().ok());
    EXPECT_TRUE(WriteFile(folder_.File("a.mcap"), view_.Take()).ok());
    return ReadRun(folder_.File("a.mcap"));
  }

  const TempFolder folder_;
  RobotView view_{{.mission = "hall",
                   .robot = "scout",
                   .radius_m = 0.25,
                   .frame = {.mission_from_robot = {10.0, 0.0, 0.0}}},
                  50'000'000};
};

TEST_F(RobotViewTest, WhatTheServerIsToldIsInTheFileAsItGoesOverTheWire) {
  const std::vector<Observation> log = support::RoomRun();
  for (const Observation& seen : log) ASSERT_TRUE(view_.Add(seen).ok());
  const RecordedRun run = Read();
  EXPECT_EQ(run.torn_end, "");
  v1::RegisterRobotRequest registration;
  ASSERT_EQ(run.Count("/registration"), 1u);
  ASSERT_TRUE(registration.ParseFromString(run.by_topic.at("/registration")[0].data));
  EXPECT_EQ(registration.mission(), "missions/hall");
  EXPECT_EQ(registration.robot_id(), "scout");
  EXPECT_EQ(registration.radius_m(), 0.25);
  EXPECT_EQ(registration.frame().mission_from_robot().x_m(), 10.0);
  ASSERT_EQ(run.Count("/observations"), log.size());
  for (std::size_t i = 0; i < log.size(); ++i) {
    EXPECT_EQ(run.by_topic.at("/observations")[i].data, ToProto(log[i]).SerializeAsString()) << i;
  }
}

// The run has 200 scans of 20 s, ten a second, and a reading with every third.
TEST_F(RobotViewTest, ViewersHaveWhatTheyDraw) {
  for (const Observation& seen : support::RoomRun()) ASSERT_TRUE(view_.Add(seen).ok());
  Plan plan;
  plan.id = 7;
  plan.trajectory.waypoints = {{.pose = {10, 0, 0}}, {.pose = {11, 0, 0}}};
  ASSERT_TRUE(view_.Add(PlanGiven{20 * kSecond_ns, plan}).ok());
  ASSERT_TRUE(view_.Add(PlanEnded{}).ok());
  ASSERT_TRUE(view_.Add(SaidLine{false, "link is up"}).ok());
  const RecordedRun run = Read();
  EXPECT_EQ(run.Count("/robots/scout/pose"), 100u);
  EXPECT_EQ(run.Count("/robots/scout/scan"), 20u);
  EXPECT_EQ(run.Count("/robots/scout/gas"), 67u);
  EXPECT_EQ(run.Count("/scene/plans"), 2u);
  EXPECT_THAT(run.log, ElementsAre("link is up"));
  v1::Plan read;
  ASSERT_EQ(run.Count("/plans"), 1u);
  ASSERT_TRUE(read.ParseFromString(run.by_topic.at("/plans")[0].data));
  EXPECT_EQ(read.name(), "missions/hall/plans/7");
  EXPECT_EQ(read.robot(), "missions/hall/robots/scout");
}

TEST_F(RobotViewTest, PlacesAreInTheMissionsFrame) {
  ASSERT_TRUE(view_.Add(RobotPlace{kSecond_ns, {1.0, 2.0, 0.0}}).ok());
  ASSERT_TRUE(view_.Add(RobotPlace{kSecond_ns + 1, {1.0, 2.0, 0.0}}).ok());  // too soon
  const RecordedRun run = Read();
  ASSERT_EQ(run.Count("/robots/scout/pose"), 1u);
  foxglove::PoseInFrame pose;
  ASSERT_TRUE(pose.ParseFromString(run.by_topic.at("/robots/scout/pose")[0].data));
  EXPECT_EQ(pose.pose().position().x(), 11.0);
}

TEST_F(RobotViewTest, TheLogsTimeNeverGoesBack) {
  ASSERT_TRUE(view_.Add(RobotPlace{5 * kSecond_ns, {}}).ok());
  ASSERT_TRUE(view_.Add(RobotPlace{2 * kSecond_ns, {}}).ok());  // its clock was set back
  ASSERT_TRUE(view_.NoteGap(3).ok());
  EXPECT_EQ(view_.now_ns(), 5 * kSecond_ns);
  const RecordedRun run = Read();
  const McapMessage& late = run.by_topic.at("/robots/scout/pose").back();
  EXPECT_EQ(late.log_time_ns, 5u * kSecond_ns);
  EXPECT_EQ(late.publish_time_ns, 2u * kSecond_ns);
  EXPECT_THAT(run.log, ElementsAre("recording: 3 messages are missing"));
}

// Which an independent reader reads too: console/test/mcap.test.ts.
TEST_F(RobotViewTest, AFileOfBeforeIsStillRead) {
  const RecordedRun run = ReadRun("tests/formats/view/golden/scout.mcap");
  EXPECT_EQ(run.torn_end, "");
  v1::RegisterRobotRequest registration;
  ASSERT_EQ(run.Count("/registration"), 1u);
  ASSERT_TRUE(registration.ParseFromString(run.by_topic.at("/registration")[0].data));
  EXPECT_EQ(registration.robot_id(), "scout");
  EXPECT_EQ(run.Count("/observations"), 92u);
  for (const McapMessage& message : run.by_topic.at("/observations")) {
    v1::Observation proto;
    ASSERT_TRUE(proto.ParseFromString(message.data));
    EXPECT_TRUE(FromProto(proto, "observation").ok()) << proto.sequence();
  }
}

TEST_F(RobotViewTest, AnEmptyRunSaysWhoItWas) { EXPECT_EQ(Read().Count("/registration"), 1u); }

}  // namespace robot_view_test
}  // namespace plumescout::client
