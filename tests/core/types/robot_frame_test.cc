// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/robot_frame.h"

#include <cmath>
#include <string>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace plumescout {
namespace robot_frame_test {

using ::testing::HasSubstr;

// The robot's frame lies at (2, 1), its x axis along the mission's y.
constexpr Pose2 kOrigin{2.0, 1.0, M_PI / 2};

TEST(RobotFrame, PosesComeIntoTheMissionAndBack) {
  const RobotFrame frame{kOrigin, 0.1, 0.01};
  const Pose2 in_mission = InMission(frame, {3.0, 1.0, 0.25});
  EXPECT_NEAR(in_mission.x_m, 1.0, 1e-12);
  EXPECT_NEAR(in_mission.y_m, 4.0, 1e-12);
  EXPECT_NEAR(in_mission.yaw_rad, M_PI / 2 + 0.25, 1e-12);
  const Pose2 back = InRobot(frame, in_mission);
  EXPECT_NEAR(back.x_m, 3.0, 1e-12);
  EXPECT_NEAR(back.y_m, 1.0, 1e-12);
  EXPECT_NEAR(back.yaw_rad, 0.25, 1e-12);
}

TEST(RobotFrame, TheSameFrameChangesNoBit) {
  const Pose2 pose{0.1, -1e-300, -M_PI};
  EXPECT_EQ(InMission(RobotFrame(), pose), pose);
  EXPECT_EQ(InRobot(RobotFrame(), pose), pose);
}

TEST(RobotFrame, IsRefusedByNameAndValue) {
  EXPECT_TRUE(Validate(RobotFrame{{1000.0, -1000.0, 900.0}, 10.0, M_PI}, 1000.0).ok());
  const auto message = [](const RobotFrame& frame) {
    return std::string(Validate(frame, 1000.0).message());
  };
  EXPECT_THAT(message({{1000.5, 0.0, 0.0}, 0.0, 0.0}),
              HasSubstr("mission_from_robot.x_m = 1000.5"));
  EXPECT_THAT(message({{0.0, NAN, 0.0}, 0.0, 0.0}), HasSubstr("mission_from_robot.y_m"));
  EXPECT_THAT(message({{0.0, 0.0, INFINITY}, 0.0, 0.0}), HasSubstr("mission_from_robot.yaw_rad"));
  EXPECT_THAT(message({{}, -0.1, 0.0}), HasSubstr("position_stddev_m = -0.1"));
  EXPECT_THAT(message({{}, 0.0, 3.2}), HasSubstr("heading_stddev_rad = 3.2"));
}

}  // namespace robot_frame_test
}  // namespace plumescout
