// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What missions and robots draw is tested with formats/view and client/robot_view; here is what
// they share.
#include "formats/draw/robot_drawing.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "foxglove/schemas.pb.h"
#include "tests/formats/mcap/mcap_files.h"

namespace plumescout {
namespace robot_drawing_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class RobotDrawingTest : public testing::Test {
 protected:
  // Messages of the topic.
  std::vector<std::string> Read(const std::string& topic) {
    EXPECT_TRUE(encoder_.Finish().ok());
    std::vector<std::string> read;
    const TempFolder folder;
    EXPECT_TRUE(WriteFile(folder.File("f.mcap"), encoder_.Take()).ok());
    auto reader = McapReader::Open(folder.File("f.mcap"));
    EXPECT_TRUE(reader.ok()) << reader.status();
    for (auto message = reader->Next(); message.ok() && *message; message = reader->Next()) {
      if (reader->channels().at((*message)->channel).topic == topic)
        read.push_back((*message)->data);
    }
    return read;
  }

  McapEncoder encoder_{"a test"};
  TypedChannels channels_{&encoder_};
  RobotDrawing drawing_{&channels_};
};

TEST(IsDueTest, GoesByThePeriodAndByTimeThatGoesBack) {
  std::optional<std::int64_t> shown_ns;
  EXPECT_TRUE(IsDue(100, 50, shown_ns));
  EXPECT_FALSE(IsDue(149, 50, shown_ns));
  EXPECT_TRUE(IsDue(150, 50, shown_ns));
  EXPECT_TRUE(IsDue(20, 50, shown_ns)) << "of a robot that sends what it kept";
  EXPECT_FALSE(IsDue(60, 50, shown_ns));
}

TEST_F(RobotDrawingTest, ScansAreThinnedOutForEachRobot) {
  const Scan scan{
      .start_angle_rad = 0.0, .angle_step_rad = 0.1, .max_range_m = 8.0, .ranges_m = {1}};
  for (int tenth = 0; tenth < 25; ++tenth) {
    const std::int64_t time_ns = tenth * kSecond_ns / 10;
    for (const char* robot : {"a", "b"}) {
      ASSERT_TRUE(
          drawing_.DrawObservation(robot, {}, {1, time_ns, {}, scan}, {time_ns, time_ns}).ok());
    }
  }
  EXPECT_EQ(Read("/robots/b/scan").size(), 3u);  // at 0, 1 and 2 s
}

TEST_F(RobotDrawingTest, PosesAreInTheMissionsFrame) {
  const RobotFrame frame{.mission_from_robot = {10.0, 20.0, 0.0}};
  ASSERT_TRUE(
      drawing_.DrawObservation("a", frame, {1, 5, {1.0, 2.0, 0.0}, RobotStatus{0.5}}, {5, 5}).ok());
  const std::vector<std::string> poses = Read("/robots/a/pose");
  ASSERT_EQ(poses.size(), 1u);
  foxglove::PoseInFrame pose;
  ASSERT_TRUE(pose.ParseFromString(poses[0]));
  EXPECT_EQ(pose.frame_id(), "map");
  EXPECT_EQ(pose.pose().position().x(), 11.0);
  EXPECT_EQ(pose.pose().position().y(), 22.0);
}

TEST_F(RobotDrawingTest, AWayGoesWhenItsPlanHasEnded) {
  Plan plan;
  plan.robot = "a";
  plan.trajectory.waypoints = {{.pose = {0, 0, 0}}, {.pose = {1, 0, 0}}};
  ASSERT_TRUE(drawing_.DrawPlan("hall", plan, {1, 1}).ok());
  ASSERT_TRUE(drawing_.DrawEndOfPlan("a", {2, 2}).ok());
  plan.trajectory.waypoints.clear();
  ASSERT_TRUE(drawing_.DrawPlan("hall", plan, {3, 3}).ok());
  const std::vector<std::string> scenes = Read("/scene/plans");
  ASSERT_EQ(scenes.size(), 3u);
  foxglove::SceneUpdate way;
  ASSERT_TRUE(way.ParseFromString(scenes[0]));
  ASSERT_EQ(way.entities_size(), 1);
  EXPECT_EQ(way.entities(0).lines(0).points_size(), 2);
  for (const std::size_t i : {1u, 2u}) {
    foxglove::SceneUpdate gone;
    ASSERT_TRUE(gone.ParseFromString(scenes[i]));
    ASSERT_EQ(gone.deletions_size(), 1);
    EXPECT_EQ(gone.deletions(0).id(), way.entities(0).id());
  }
}

TEST_F(RobotDrawingTest, LinesHaveTheirWeight) {
  ASSERT_TRUE(drawing_.DrawLine(true, "a", "bad", {1, 1}).ok());
  const std::vector<std::string> lines = Read("/log");
  ASSERT_EQ(lines.size(), 1u);
  foxglove::Log log;
  ASSERT_TRUE(log.ParseFromString(lines[0]));
  EXPECT_EQ(log.level(), foxglove::Log::WARNING);
  EXPECT_EQ(log.name(), "a");
  EXPECT_EQ(log.message(), "bad");
}

}  // namespace robot_drawing_test
}  // namespace plumescout
