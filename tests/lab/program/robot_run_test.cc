// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/robot_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "formats/file_io.h"
#include "proto/convert/observation.h"
#include "tests/lab/program/robot_runs.h"
#include "tests/support/room_run.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace robot_run_test {

class RobotRunTest : public testing::Test {
 protected:
  const TempFolder folder_;
  const std::string path_ = folder_.File("a.mcap");
};

TEST_F(RobotRunTest, HasWhoTheRobotWasAndWhatItSaid) {
  const std::vector<Observation> log = support::RoomRun();
  WriteRobotRun(path_, log);
  auto run = RobotRun::Open(path_);
  ASSERT_TRUE(run.ok()) << run.status();
  ASSERT_TRUE(run->has_value());
  EXPECT_EQ((*run)->robot(), "scout");
  EXPECT_EQ((*run)->radius_m(), 0.25);
  EXPECT_EQ((*run)->outfit().frame.mission_from_robot.x_m, 10.0);
  ASSERT_EQ((*run)->outfit().sensors.size(), 1u);
  std::size_t count = 0;
  for (auto seen = (*run)->Next(); seen.ok() && *seen; seen = (*run)->Next()) {
    ASSERT_LT(count, log.size());
    Observation said = log[count++];
    said.pose.yaw_rad = WrapAngle_rad(said.pose.yaw_rad);  // as it is read
    EXPECT_EQ(ToProto(**seen).SerializeAsString(), ToProto(said).SerializeAsString());
  }
  EXPECT_EQ(count, log.size());
  EXPECT_EQ((*run)->torn_end(), "");
  EXPECT_EQ((*run)->senseless(), 0);
}

TEST_F(RobotRunTest, OtherFilesAreNone) {
  ASSERT_TRUE(WriteFile(path_, "no MCAP").ok());
  auto run = RobotRun::Open(path_);
  ASSERT_TRUE(run.ok()) << run.status();
  EXPECT_FALSE(run->has_value());
  McapEncoder encoder("a test");
  ASSERT_TRUE(encoder.Add({encoder.AddChannel("/registration", "text", 0), 1, 1, 1, "me"}).ok());
  ASSERT_TRUE(encoder.Finish().ok());
  ASSERT_TRUE(WriteFile(path_, encoder.Take()).ok());
  run = RobotRun::Open(path_);
  ASSERT_TRUE(run.ok()) << run.status();
  EXPECT_FALSE(run->has_value());
  EXPECT_FALSE(RobotRun::Open(folder_.File("nowhere")).value_or(std::nullopt).has_value());
}

TEST_F(RobotRunTest, ObservationsThatMakeNoSenseArePassedOverAndNamed) {
  std::vector<Observation> log = support::RoomRun();
  log.resize(5);
  log[2].pose.x_m = std::nan("");
  WriteRobotRun(path_, log);
  auto run = RobotRun::Open(path_);
  ASSERT_TRUE(run.ok() && run->has_value());
  int count = 0;
  for (auto seen = (*run)->Next(); seen.ok() && *seen; seen = (*run)->Next()) ++count;
  EXPECT_EQ(count, 4);
  EXPECT_EQ((*run)->senseless(), 1);
  EXPECT_NE((*run)->first_senseless().message().find("observation 3"), std::string::npos)
      << (*run)->first_senseless();
}

}  // namespace robot_run_test
}  // namespace plumescout::lab
