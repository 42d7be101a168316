// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/simulated_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

namespace plumescout::lab {
namespace simulated_robot_test {

using ::testing::HasSubstr;

// Rounding of a few thousand additions of values up to 10.
constexpr double kRounding = 1e-9;

// An empty room, free in [0.5, 9.5) m on both axes. The gas is `ppm` everywhere in every frame.
Scene EmptyRoom(double ppm = 0.0) {
  GridGeometry geometry;
  geometry.resolution_m = 0.5;
  geometry.width = geometry.height = 20;
  Scene scene;
  scene.name = "room";
  scene.occupancy = Grid<CellState>(geometry, CellState::kOccupied);
  for (int y = 1; y < 19; ++y) {
    for (int x = 1; x < 19; ++x) scene.occupancy[Cell{x, y}] = CellState::kFree;
  }
  scene.series.frames = 2;
  const auto counts = static_cast<std::uint16_t>(ppm / scene.series.scale_ppm_per_count);
  scene.series.counts.assign(2 * geometry.size(), counts);
  scene.start_pose = {2.0, 3.0, 0.0};
  return scene;
}

class SimulatedRobotTest : public ::testing::Test {
 protected:
  SimulatedRobot Make(const SimulatedRobotOptions& options = {}) {
    auto robot = SimulatedRobot::Create(world_, options);
    EXPECT_TRUE(robot.ok()) << robot.status();
    return *std::move(robot);
  }
  void ExpectInvalid(const SimulatedRobotOptions& options, const std::string& message) {
    const absl::Status status = SimulatedRobot::Create(world_, options).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(std::string(status.message()), HasSubstr(message));
  }

  const SceneWorld world_{EmptyRoom(40.0)};
};

void ExpectPose(const Pose2& pose, double x_m, double y_m, double yaw_rad) {
  EXPECT_NEAR(pose.x_m, x_m, kRounding);
  EXPECT_NEAR(pose.y_m, y_m, kRounding);
  EXPECT_NEAR(pose.yaw_rad, yaw_rad, kRounding);
}

TEST_F(SimulatedRobotTest, StandsAtTheScenesStartWithItsClockAtFrameZero) {
  const SimulatedRobot robot = Make();
  EXPECT_EQ(robot.pose(), (Pose2{2.0, 3.0, 0.0}));
  EXPECT_EQ(robot.now_ns(), 1'700'000'000'000'000'000);
}

TEST_F(SimulatedRobotTest, DrivesStraight) {
  SimulatedRobot robot = Make({.start = Pose2{2.0, 3.0, M_PI / 6.0}});
  ASSERT_TRUE(robot.Drive({1.0, 0.0}).ok());
  ASSERT_TRUE(robot.Advance(2.0).ok());
  ExpectPose(robot.pose(), 2.0 + std::sqrt(3.0), 4.0, M_PI / 6.0);
}

TEST_F(SimulatedRobotTest, DrivesExactArcs) {
  SimulatedRobot robot = Make({.start = Pose2{5.0, 3.0, 0.0}});
  ASSERT_TRUE(robot.Drive({1.0, 0.5}).ok());  // a circle of 2 m around (5, 5)
  ASSERT_TRUE(robot.Advance(M_PI).ok());
  ExpectPose(robot.pose(), 7.0, 5.0, M_PI / 2.0);
  ASSERT_TRUE(robot.Advance(3.0 * M_PI).ok());
  ExpectPose(robot.pose(), 5.0, 3.0, 0.0);
}

TEST_F(SimulatedRobotTest, TurnsOnTheSpotEvenAtAWall) {
  SimulatedRobot robot = Make({.start = Pose2{0.56, 3.0, 0.0}});
  ASSERT_TRUE(robot.Drive({0.0, 1.0}).ok());
  ASSERT_TRUE(robot.Advance(2.0).ok());
  ExpectPose(robot.pose(), 0.56, 3.0, 2.0);
}

TEST_F(SimulatedRobotTest, HoldsACommandUntilTheNext) {
  SimulatedRobot robot = Make();
  ASSERT_TRUE(robot.Drive({1.0, 0.0}).ok());
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(robot.Advance(0.1).ok());
  ASSERT_TRUE(robot.Drive({}).ok());
  ASSERT_TRUE(robot.Advance(5.0).ok());
  ExpectPose(robot.pose(), 3.0, 3.0, 0.0);
}

TEST_F(SimulatedRobotTest, KeepsToItsLimits) {
  SimulatedRobot robot = Make({.max_forward_mps = 0.5, .max_turn_rad_per_s = 0.25});
  ASSERT_TRUE(robot.Drive({9.0, 0.0}).ok());
  ASSERT_TRUE(robot.Advance(1.0).ok());
  ExpectPose(robot.pose(), 2.5, 3.0, 0.0);
  ASSERT_TRUE(robot.Drive({-9.0, 0.0}).ok());
  ASSERT_TRUE(robot.Advance(1.0).ok());
  ExpectPose(robot.pose(), 2.0, 3.0, 0.0);
  ASSERT_TRUE(robot.Drive({0.0, -9.0}).ok());
  ASSERT_TRUE(robot.Advance(1.0).ok());
  ExpectPose(robot.pose(), 2.0, 3.0, -0.25);
}

TEST_F(SimulatedRobotTest, StopsAtAWall) {
  SimulatedRobot robot = Make();
  ASSERT_TRUE(robot.Drive({1.0, 0.0}).ok());
  ASSERT_TRUE(robot.Advance(30.0).ok());
  // The wall is at 9.5 m, the body reaches 0.05 m, a step is 0.02 m.
  EXPECT_LT(robot.pose().x_m, 9.45);
  EXPECT_GE(robot.pose().x_m, 9.43 - kRounding);
  EXPECT_EQ(robot.collisions(), 1);
}

TEST_F(SimulatedRobotTest, BacksOffAfterACollision) {
  SimulatedRobot robot = Make();
  ASSERT_TRUE(robot.Drive({1.0, 0.0}).ok());
  ASSERT_TRUE(robot.Advance(30.0).ok());
  const double wall_x_m = robot.pose().x_m;
  ASSERT_TRUE(robot.Drive({-1.0, 0.0}).ok());
  ASSERT_TRUE(robot.Advance(1.0).ok());
  EXPECT_NEAR(robot.pose().x_m, wall_x_m - 1.0, kRounding);
}

TEST_F(SimulatedRobotTest, CanBePlaced) {
  SimulatedRobot robot = Make();
  ASSERT_TRUE(robot.PlaceAt({5.0, 6.0, 3.0 * M_PI}).ok());
  ExpectPose(robot.pose(), 5.0, 6.0, M_PI);
}

TEST_F(SimulatedRobotTest, IsNotPlacedInAWall) {
  SimulatedRobot robot = Make();
  ASSERT_TRUE(robot.PlaceAt({0.2, 6.0, 0.0}).ok());
  EXPECT_EQ(robot.pose(), (Pose2{2.0, 3.0, 0.0}));
  EXPECT_EQ(robot.collisions(), 1);
}

TEST_F(SimulatedRobotTest, AdvancesItsClockToTheNanosecond) {
  SimulatedRobot robot = Make();
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(robot.Advance(0.1).ok());
  EXPECT_EQ(robot.now_ns(), 1'700'000'100'000'000'000);
  ASSERT_TRUE(robot.Advance(0.0).ok());
  EXPECT_EQ(robot.now_ns(), 1'700'000'100'000'000'000);
}

TEST_F(SimulatedRobotTest, SmellsTheWorldThroughItsSensorsLag) {
  SimulatedRobotOptions options;
  options.gas_sensor.noise_sigma_ppm = options.gas_sensor.noise_share = 0.0;
  SimulatedRobot robot = Make(options);
  EXPECT_EQ(robot.ReadGas()->concentration_ppm, 0.0);
  ASSERT_TRUE(robot.Advance(0.5).ok());
  EXPECT_NEAR(robot.ReadGas()->concentration_ppm, 40.0 * (1.0 - std::exp(-1.0)), kRounding);
  EXPECT_EQ(robot.ReadGas()->variance_ppm2, 0.0);  // the mission's model
}

TEST_F(SimulatedRobotTest, ScansTheWorldFromWhereItIs) {
  SimulatedRobotOptions options;
  options.lidar.noise_sigma_m = 0.0;
  SimulatedRobot robot = Make(options);
  const Scan scan = *robot.TakeScan();
  ASSERT_EQ(scan.ranges_m.size(), 360u);
  EXPECT_NEAR(scan.ranges_m[180], 7.5 + 0.25, 1e-6);  // ahead: the wall, half a cell in; float
}

TEST_F(SimulatedRobotTest, DependsOnOptionsAndCallsAlone) {
  const auto run = [this](std::uint64_t seed) {
    SimulatedRobot robot = Make({.seed = seed});
    EXPECT_TRUE(robot.Drive({1.0, 0.3}).ok());
    EXPECT_TRUE(robot.Advance(1.0).ok());
    return std::pair(*robot.TakeScan(), *robot.ReadGas());
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1).first, run(2).first);
  EXPECT_NE(run(1).second, run(2).second);
}

TEST_F(SimulatedRobotTest, DoesTheSameInRealTime) {
  SimulatedRobot fast = Make();
  SimulatedRobot paced = Make({.realtime = true});
  for (SimulatedRobot* robot : {&fast, &paced}) {
    ASSERT_TRUE(robot->Drive({1.0, 0.5}).ok());
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(robot->Advance(0.01).ok());
  }
  EXPECT_EQ(fast.pose(), paced.pose());
  EXPECT_GE(paced.now_ns(), fast.now_ns()) << "time that this machine lost has gone by";
}

TEST_F(SimulatedRobotTest, InRealTimeItsClockDoesNotFallBehind) {
  SimulatedRobot robot = Make({.realtime = true});
  const auto made = std::chrono::steady_clock::now();
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(robot.TakeScan().ok());  // takes some time
  const auto scanned = std::chrono::steady_clock::now();
  ASSERT_TRUE(robot.Advance(0.0).ok());
  constexpr double kRounding_s = 1e-8;
  EXPECT_GE(robot.elapsed_s(), std::chrono::duration<double>(scanned - made).count() - kRounding_s);
}

TEST_F(SimulatedRobotTest, RejectsCallsThatMakeNoSense) {
  SimulatedRobot robot = Make();
  const double nan = std::nan("");
  EXPECT_TRUE(absl::IsInvalidArgument(robot.Drive({nan, 0.0})));
  EXPECT_TRUE(absl::IsInvalidArgument(robot.Drive({0.0, HUGE_VAL})));
  EXPECT_TRUE(absl::IsInvalidArgument(robot.PlaceAt({1.0, nan, 0.0})));
  EXPECT_TRUE(absl::IsInvalidArgument(robot.Advance(-0.1)));
  EXPECT_TRUE(absl::IsInvalidArgument(robot.Advance(nan)));
  EXPECT_TRUE(absl::IsInvalidArgument(robot.Advance(1e9)));
  EXPECT_EQ(robot.pose(), (Pose2{2.0, 3.0, 0.0}));
}

TEST_F(SimulatedRobotTest, RejectsOptionsOutOfRange) {
  ExpectInvalid({.start = Pose2{0.52, 3.0, 0.0}}, "robot.start (0.52, 3) touches an obstacle");
  ExpectInvalid({.start = Pose2{std::nan(""), 3.0, 0.0}}, "robot.start must be finite");
  ExpectInvalid({.max_forward_mps = 0.0}, "robot.max_forward_mps = 0");
  ExpectInvalid({.max_turn_rad_per_s = std::nan("")}, "robot.max_turn_rad_per_s = nan");
  ExpectInvalid({.body_radius_m = -1.0}, "robot.body_radius_m = -1");
  ExpectInvalid({.lidar = {.beams = 0}}, "lidar.beams = 0");
  ExpectInvalid({.gas_sensor = {.noise_share = 2.0}}, "gas_sensor.noise_share = 2");
  ExpectInvalid({.start_time_ns = -1}, "robot.start_time_ns");
}

TEST_F(SimulatedRobotTest, SpeedsUpAndBrakesAsItCan) {
  SimulatedRobot robot = Make({.max_acceleration_mps2 = 0.5});
  ASSERT_TRUE(robot.Drive({1.0, 0.0}).ok());
  ASSERT_TRUE(robot.Advance(2.0).ok());
  ExpectPose(robot.pose(), 2.0 + 1.0, 3.0, 0.0);  // a t^2 / 2
  ASSERT_TRUE(robot.Advance(1.0).ok());
  ExpectPose(robot.pose(), 4.0, 3.0, 0.0);
  ASSERT_TRUE(robot.Drive({}).ok());
  ASSERT_TRUE(robot.Advance(10.0).ok());
  ExpectPose(robot.pose(), 5.0, 3.0, 0.0);
}

TEST_F(SimulatedRobotTest, AWallTakesItsSpeed) {
  SimulatedRobot robot = Make({.start = Pose2{9.0, 3.0, 0.0}, .max_acceleration_mps2 = 1.0});
  ASSERT_TRUE(robot.Drive({1.0, 0.0}).ok());
  ASSERT_TRUE(robot.Advance(5.0).ok());
  EXPECT_EQ(robot.collisions(), 1);
  const double wall_x_m = robot.pose().x_m;
  ASSERT_TRUE(robot.Drive({-1.0, 0.0}).ok());
  ASSERT_TRUE(robot.Advance(1.0).ok());
  EXPECT_NEAR(robot.pose().x_m, wall_x_m - 0.5, kRounding);
}

TEST_F(SimulatedRobotTest, DriftOfItsPoseLeadsItAstray) {
  SimulatedRobotOptions options;
  options.pose_error.drift_m_per_sqrt_s = 0.2;
  SimulatedRobot robot = Make(options);
  ASSERT_TRUE(robot.Advance(4.0).ok());
  const Pose2 told = robot.pose();
  EXPECT_EQ(robot.true_pose(), (Pose2{2.0, 3.0, 0.0})) << "it has not moved";
  EXPECT_NE(told.x_m, 2.0);
  ASSERT_TRUE(robot.PlaceAt({5.0, 6.0, 0.0}).ok());
  ExpectPose(robot.pose(), 5.0, 6.0, 0.0);
  ExpectPose(robot.true_pose(), 5.0 - (told.x_m - 2.0), 6.0 - (told.y_m - 3.0), 0.0);
}

TEST_F(SimulatedRobotTest, LosesItsPlaceAndFindsIt) {
  SimulatedRobotOptions options;
  options.pose_error.jump = PoseJumpOptions{1.0, 0.5, 0.25, 0.0, 2.0};
  SimulatedRobot robot = Make(options);
  ASSERT_TRUE(robot.Advance(0.5).ok());
  ExpectPose(robot.pose(), 2.0, 3.0, 0.0);
  ASSERT_TRUE(robot.Advance(0.5).ok());
  ExpectPose(robot.pose(), 2.5, 3.25, 0.0);
  ExpectPose(robot.true_pose(), 2.0, 3.0, 0.0);
  ASSERT_TRUE(robot.PlaceAt({5.5, 6.25, 0.0}).ok());
  ExpectPose(robot.true_pose(), 5.0, 6.0, 0.0);
  ASSERT_TRUE(robot.Advance(1.0).ok());
  EXPECT_FALSE(robot.TakeCorrection().has_value());
  ASSERT_TRUE(robot.Advance(1.0).ok());
  ExpectPose(robot.pose(), 5.0, 6.0, 0.0);
  const auto correction = robot.TakeCorrection();
  ASSERT_TRUE(correction.has_value());
  ASSERT_EQ(correction->anchors.size(), 3U);
  ExpectPose(correction->anchors[0].pose, 2.0, 3.0, 0.0);
  EXPECT_EQ(correction->anchors[2].sample_time_ns, robot.now_ns());
}

TEST_F(SimulatedRobotTest, CollidesWhereItTrulyIs) {
  SimulatedRobotOptions options;
  options.pose_error.position_sigma_m = 1.0;
  SimulatedRobot robot = Make(options);
  ASSERT_TRUE(robot.Drive({1.0, 0.0}).ok());
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(robot.Advance(0.1).ok());
  EXPECT_EQ(robot.collisions(), 1);
  EXPECT_LT(robot.true_pose().x_m, 9.45);
  EXPECT_GE(robot.true_pose().x_m, 9.43 - kRounding);
}

TEST_F(SimulatedRobotTest, MayBeginLaterThanTheScene) {
  Scene scene = EmptyRoom();
  const auto cells = static_cast<std::ptrdiff_t>(scene.geometry().size());
  std::fill(scene.series.counts.begin() + cells, scene.series.counts.end(), std::uint16_t{200});
  const SceneWorld world(scene);  // 0 ppm in frame 0, 10 ppm in frame 1 at 0.5 s
  SimulatedRobotOptions options;
  options.gas_sensor = {.time_constant_s = 0.0, .noise_sigma_ppm = 0.0, .noise_share = 0.0};
  for (const double start_s : {0.0, 0.5}) {
    options.scene_start_s = start_s;
    auto robot = SimulatedRobot::Create(world, options);
    ASSERT_TRUE(robot.ok()) << robot.status();
    ASSERT_TRUE(robot->Advance(0.02).ok());
    EXPECT_NEAR(robot->ReadGas()->concentration_ppm, start_s > 0.0 ? 10.0 : 0.0, kRounding);
    EXPECT_EQ(robot->now_ns(), 1'700'000'000'020'000'000) << "its clock is its own";
  }
}

TEST_F(SimulatedRobotTest, SensesTheAmbientAirFromTheStart) {
  const SceneWorld world(EmptyRoom(), {.ambient_ppm = 400.0});
  SimulatedRobotOptions options;
  options.gas_sensor.noise_sigma_ppm = options.gas_sensor.noise_share = 0.0;
  auto robot = SimulatedRobot::Create(world, options);
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_EQ(robot->ReadGas()->concentration_ppm, 400.0);
}

TEST_F(SimulatedRobotTest, RobotsSeeEachOther) {
  Company company(2, false);
  SimulatedRobotOptions options;
  options.lidar.noise_sigma_m = 0.0;
  options.seen_radius_m = 0.25;
  options.companion = {&company, 0};
  SimulatedRobot west = Make(options);
  options.start = Pose2{5.0, 3.0, 0.0};
  options.companion.robot = 1;
  SimulatedRobot east = Make(options);
  EXPECT_NEAR(west.TakeScan()->ranges_m[180], 2.75, 1e-6);
  ASSERT_TRUE(east.PlaceAt({6.0, 3.0, 0.0}).ok());
  EXPECT_NEAR(west.TakeScan()->ranges_m[180], 3.75, 1e-6);
  ASSERT_TRUE(east.Drive({-1.0, 0.0}).ok());
  ASSERT_TRUE(east.Advance(2.0).ok());
  EXPECT_NEAR(west.TakeScan()->ranges_m[180], 1.75, 1e-6);
  EXPECT_NEAR(company.closest_m(), 2.0, kRounding);
}

TEST_F(SimulatedRobotTest, RobotsBlockEachOther) {
  Company company(2, false);
  SimulatedRobotOptions options;
  options.companion = {&company, 0};
  SimulatedRobot west = Make(options);
  options.start = Pose2{west.pose().x_m + 1.0, west.pose().y_m, 0.0};
  options.companion.robot = 1;
  SimulatedRobot east = Make(options);
  ASSERT_TRUE(east.Drive({-1.0, 0.0}).ok());
  ASSERT_TRUE(east.Advance(2.0).ok());
  EXPECT_NEAR(Distance_m(east.pose().position(), west.pose().position()), 0.4, 0.03);
  EXPECT_EQ(company.contacts(), 1);
  EXPECT_EQ(east.collisions(), 0);
  const Pose2 before = east.pose();
  EXPECT_TRUE(absl::IsUnavailable(east.PlaceAt(west.pose())));
  EXPECT_EQ(east.pose(), before);
  ASSERT_TRUE(east.Advance(kContactPause_s).ok());
  ASSERT_TRUE(east.Drive({1.0, 0.0}).ok());
  ASSERT_TRUE(east.Advance(1.0).ok());
  EXPECT_NEAR(Distance_m(east.pose().position(), west.pose().position()), 1.4, 0.03);
}

TEST_F(SimulatedRobotTest, RejectsNewerOptionsOutOfRange) {
  ExpectInvalid({.max_acceleration_mps2 = 0.0}, "robot.max_acceleration_mps2 = 0");
  ExpectInvalid({.max_acceleration_mps2 = std::nan("")}, "robot.max_acceleration_mps2 = nan");
  ExpectInvalid({.seen_radius_m = -1.0}, "robot.seen_radius_m = -1");
  ExpectInvalid({.lidar = {.dropout_share = 2.0}}, "lidar.dropout_share = 2");
  ExpectInvalid({.pose_error = {.yaw_sigma_rad = -1.0}}, "pose_error.yaw_sigma_rad = -1");
  ExpectInvalid({.scene_start_s = -1.0}, "robot.scene_start_s = -1");
}

}  // namespace simulated_robot_test
}  // namespace plumescout::lab
