// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Robots that are slower than their paths, whose clocks are wrong, and that close loops.
#include <gtest/gtest.h>

#include "lab/sim/simulated_robot.h"
#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace simulated_robot_faults_test {

SimulatedRobot Make(const SimulatedRobotOptions& options) {
  auto robot = SimulatedRobot::Create(SmallWorld(), options);
  EXPECT_TRUE(robot.ok()) << robot.status();
  return *std::move(robot);
}

TEST(SimulatedRobotFaults, WhoIsPlacedKeepsItsTopSpeed) {
  SimulatedRobotOptions options;
  options.start = Pose2{0.5, 0.5, 0.0};
  options.pace.top_speed_mps = 0.5;
  SimulatedRobot robot = Make(options);
  for (int tick = 1; tick <= 10; ++tick) {
    ASSERT_TRUE(robot.Advance(0.1).ok());
    const Pose2 here = robot.pose();
    const absl::Status placed = robot.PlaceAt({here.x_m + 0.1, here.y_m, 0.0});  // 1 m/s
    EXPECT_TRUE(placed.ok() || absl::IsUnavailable(placed)) << placed;
    if (!placed.ok()) {
      EXPECT_EQ(robot.pose(), here);
    }
  }
  EXPECT_NEAR(robot.pose().x_m, 0.5 + 0.5, 0.125 + 0.1);
}

TEST(SimulatedRobotFaults, ItsOwnClockGoesWrong) {
  SimulatedRobotOptions options;
  options.clock = {.offset_s = 10.0, .drift_ppm = 1000.0};
  SimulatedRobot robot = Make(options);
  EXPECT_EQ(robot.now_ns(), robot.world_time_ns() + 10'000'000'000);
  ASSERT_TRUE(robot.Advance(2.0).ok());
  EXPECT_EQ(robot.world_time_ns(), options.start_time_ns + 2'000'000'000);
  EXPECT_EQ(robot.elapsed_s(), 2.0);
  EXPECT_EQ(robot.now_ns(), robot.world_time_ns() + 10'002'000'000);
}

TEST(SimulatedRobotFaults, AClosedLoopTakesDriftBack) {
  SimulatedRobotOptions options;
  options.pose_error.drift_m_per_sqrt_s = 0.05;
  options.pose_error.closed_every_s = 5.0;
  SimulatedRobot robot = Make(options);
  for (int tick = 1; tick < 50; ++tick) ASSERT_TRUE(robot.Advance(0.1).ok());
  EXPECT_NE(robot.pose(), robot.true_pose());
  EXPECT_FALSE(robot.TakeCorrection().has_value());
  ASSERT_TRUE(robot.Advance(0.1).ok());
  EXPECT_EQ(robot.pose(), robot.true_pose());
  const auto correction = robot.TakeCorrection();
  ASSERT_TRUE(correction.has_value());
  EXPECT_EQ(correction->anchors.back(), (PoseAnchor{robot.now_ns(), robot.true_pose()}));
  EXPECT_EQ(correction->anchors.size(), 6u);
}

TEST(SimulatedRobotFaults, AGhostIsInNobodysWay) {
  Company company(2, false);
  SimulatedRobotOptions options;
  options.companion = {&company, 0};
  options.has_body = false;
  SimulatedRobot ghost = Make(options);
  ASSERT_TRUE(ghost.Advance(0.1).ok());
  EXPECT_TRUE(company.Others(1).empty());
  options.companion.robot = 1;
  SimulatedRobot other = Make(options);
  EXPECT_TRUE(other.PlaceAt(ghost.pose()).ok());
  EXPECT_EQ(company.contacts(), 0);
}

TEST(SimulatedRobotFaults, ListenersAreToldOfEveryAdvance) {
  SimulatedRobot robot = Make({});
  int told = 0;
  robot.set_listener([&] { ++told; });
  ASSERT_TRUE(robot.Advance(0.1).ok());
  ASSERT_TRUE(robot.Advance(0.0).ok());
  EXPECT_EQ(told, 2);
  robot.set_listener(nullptr);
  ASSERT_TRUE(robot.Advance(0.1).ok());
  EXPECT_EQ(told, 2);
}

TEST(SimulatedRobotFaults, NamesWhatIsOutOfRange) {
  const auto status = [](const SimulatedRobotOptions& options) {
    return SimulatedRobot::Create(SmallWorld(), options).status();
  };
  SimulatedRobotOptions options;
  options.pace.most_late_s = -1.0;
  EXPECT_TRUE(absl::IsInvalidArgument(status(options)));
  options = {};
  options.clock.offset_s = -1e6;
  options.start_time_ns = 1'000'000'000;
  EXPECT_TRUE(absl::IsInvalidArgument(status(options))) << "before the epoch";
  options = {};
  options.pose_error.closed_every_s = 0.5;
  EXPECT_TRUE(absl::IsInvalidArgument(status(options)));
  options.pose_error.closed_every_s = 60.0;
  options.pose_error.jump = PoseJumpOptions{};
  EXPECT_TRUE(absl::IsInvalidArgument(status(options)));
}

}  // namespace simulated_robot_faults_test
}  // namespace plumescout::lab
