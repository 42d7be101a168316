// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/robot_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace plumescout {
namespace robot_frame_convert_test {

TEST(RobotFrameConvert, ComesBack) {
  const RobotFrame frame{{1.0, -2.0, 0.5}, 0.25, 0.125};
  const auto back = FromProto(ToProto(frame), "frame");
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(*back, frame);
  EXPECT_EQ(*FromProto(v1::RobotFrame(), "frame"), RobotFrame());
}

TEST(RobotFrameConvert, NamesWhatIsNoNumber) {
  v1::RobotFrame proto = ToProto(RobotFrame());
  proto.mutable_mission_from_robot()->set_x_m(NAN);
  EXPECT_THAT(std::string(FromProto(proto, "frame").status().message()),
              testing::HasSubstr("frame.mission_from_robot.x_m"));
  proto = ToProto(RobotFrame());
  proto.set_heading_stddev_rad(-0.5);
  EXPECT_THAT(std::string(FromProto(proto, "frame").status().message()),
              testing::HasSubstr("frame.heading_stddev_rad = -0.5"));
}

}  // namespace robot_frame_convert_test
}  // namespace plumescout
