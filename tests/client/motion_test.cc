// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/client/fake_driver.h"

namespace plumescout::client {
namespace motion_test {

using ::testing::ElementsAre;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kTick_s = 0.1;

// Two metres east in two seconds, half a second of standing, a metre north in one second.
Trajectory AroundTheCorner() {
  Trajectory trajectory;
  trajectory.waypoints = {
      {{0.0, 0.0, 0.0}, 0.0, 0.0}, {{2.0, 0.0, M_PI_2}, 2.0, 0.5}, {{2.0, 1.0, M_PI_2}, 3.5, 0.0}};
  trajectory.length_m = 3.0;
  trajectory.duration_s = 3.5;
  return trajectory;
}

std::unique_ptr<Motion> Start(Following following, const FakeDriver& driver,
                              const FollowerOptions& options = {}) {
  return StartMotion(following, AroundTheCorner(), options, driver.now_ns());
}

TEST(IdealMotionTest, TheRobotStandsWhereThePlanPutsItAtThatTimeOfItsClock) {
  FakeDriver driver;
  const auto motion = Start(Following::kIdeal, driver);
  const std::int64_t departure_ns = driver.now_ns();

  driver.set_now_ns(departure_ns + kSecond_ns / 2);
  ASSERT_TRUE(motion->Step(driver).ok());
  EXPECT_NEAR(driver.pose().x_m, 0.5, 1e-12);

  driver.set_now_ns(departure_ns + 9 * kSecond_ns / 4);  // it dwells
  ASSERT_TRUE(motion->Step(driver).ok());
  EXPECT_EQ(driver.pose().position(), (Point2{2.0, 0.0}));

  driver.set_now_ns(departure_ns + 3 * kSecond_ns);
  ASSERT_TRUE(motion->Step(driver).ok());
  EXPECT_NEAR(driver.pose().y_m, 0.5, 1e-12);
}

TEST(IdealMotionTest, TheRobotSpeedsUpAndTurnsAsPlanned) {
  FakeDriver driver;
  Trajectory trajectory;  // a turn by one radian in a second, then 1 m/s^2 for two
  trajectory.waypoints = {
      {{0, 0, -1}, 0.0, 0.0}, {{0, 0, 0}, 1.0, 0.0, 0.0}, {{2, 0, 0}, 3.0, 0.0, 2.0}};
  const std::int64_t departure_ns = driver.now_ns();
  const auto motion = StartMotion(Following::kIdeal, trajectory, {}, departure_ns);

  driver.set_now_ns(departure_ns + kSecond_ns / 2);
  ASSERT_TRUE(motion->Step(driver).ok());
  EXPECT_NEAR(driver.pose().yaw_rad, -0.5, 1e-12);

  driver.set_now_ns(departure_ns + 2 * kSecond_ns);
  ASSERT_TRUE(motion->Step(driver).ok());
  EXPECT_NEAR(driver.pose().x_m, 0.5, 1e-12);
}

TEST(IdealMotionTest, IsDoneOnlyOnceTheRobotStandsAtTheEnd) {
  FakeDriver driver;
  const auto motion = Start(Following::kIdeal, driver);
  driver.set_now_ns(driver.now_ns() + 60 * kSecond_ns);
  EXPECT_FALSE(motion->done()) << "the robot has not been put anywhere yet";

  ASSERT_TRUE(motion->Step(driver).ok());

  EXPECT_TRUE(motion->done());
  EXPECT_EQ(driver.pose().position(), (Point2{2.0, 1.0}));
}

TEST(IdealMotionTest, ThePathAheadShortensAsWaypointsAreReached) {
  FakeDriver driver;
  const auto motion = Start(Following::kIdeal, driver);
  driver.set_now_ns(driver.now_ns() + kSecond_ns);
  ASSERT_TRUE(motion->Step(driver).ok());
  EXPECT_THAT(motion->PathAhead(driver.pose()),
              ElementsAre(Point2{1.0, 0.0}, Point2{2.0, 0.0}, Point2{2.0, 1.0}));

  driver.set_now_ns(driver.now_ns() + 2 * kSecond_ns);
  ASSERT_TRUE(motion->Step(driver).ok());

  EXPECT_THAT(motion->PathAhead(driver.pose()), ElementsAre(Point2{2.0, 0.5}, Point2{2.0, 1.0}));
}

TEST(SteeredMotionTest, DrivesToTheEndWithTheWheels) {
  FakeDriver driver;
  const auto motion = Start(Following::kProportional, driver);

  int ticks = 0;
  for (; !motion->done() && ticks < 200; ++ticks) {
    ASSERT_TRUE(motion->Step(driver).ok());
    ASSERT_TRUE(driver.Advance(kTick_s).ok());
  }

  EXPECT_TRUE(motion->done());
  EXPECT_LE(Distance_m(driver.pose().position(), {2.0, 1.0}),
            FollowerOptions{}.arrival_tolerance_m);
  EXPECT_GE(ticks * kTick_s, 3.0);  // 3 m at the plan's 1 m/s; the dwell comes on top
}

TEST(SteeredMotionTest, KeepsToTheLimitsOfTheRobot) {
  FakeDriver driver;
  driver.set_pose({0.0, 0.0, M_PI});  // it has to turn round
  FollowerOptions options;
  options.max_forward_mps = 0.3;
  options.max_turn_rad_per_s = 0.7;
  const auto motion = Start(Following::kProportional, driver, options);

  double fastest_mps = 0.0;
  double fastest_rad_per_s = 0.0;
  for (int ticks = 0; !motion->done() && ticks < 500; ++ticks) {
    ASSERT_TRUE(motion->Step(driver).ok());
    fastest_mps = std::max(fastest_mps, std::abs(driver.twist().forward_mps));
    fastest_rad_per_s = std::max(fastest_rad_per_s, std::abs(driver.twist().turn_rad_per_s));
    ASSERT_TRUE(driver.Advance(kTick_s).ok());
  }

  EXPECT_TRUE(motion->done());
  EXPECT_LE(fastest_mps, 0.3);
  EXPECT_GT(fastest_mps, 0.29);  // which it makes use of
  EXPECT_EQ(fastest_rad_per_s, 0.7);
}

TEST(IdealMotionTest, WaitsWhileAnotherRobotIsInTheWay) {
  FakeDriver driver;
  const auto motion = Start(Following::kIdeal, driver);
  const auto tick = [&] {
    ASSERT_TRUE(motion->Step(driver).ok());
    ASSERT_TRUE(driver.Advance(kTick_s).ok());
  };
  for (int i = 0; i < 5; ++i) tick();
  const Pose2 there = driver.pose();
  driver.place_status = absl::UnavailableError("another robot is in the way");
  for (int i = 0; i < 30; ++i) tick();
  EXPECT_EQ(driver.pose(), there);
  EXPECT_FALSE(motion->done());
  driver.place_status = absl::OkStatus();
  tick();
  EXPECT_NEAR(Distance_m(driver.pose().position(), there.position()), kTick_s, 1e-9)
      << "it goes on at 1 m/s from where it stood";
}

TEST(SteeredMotionTest, ThePathAheadBeginsAtTheRobot) {
  FakeDriver driver;
  driver.set_pose({0.5, 0.2, 0.0});
  const auto motion = Start(Following::kProportional, driver);

  EXPECT_EQ(motion->PathAhead(driver.pose()).front(), (Point2{0.5, 0.2}));
  EXPECT_EQ(motion->PathAhead(driver.pose()).back(), (Point2{2.0, 1.0}));
}

TEST(OthersMotionTest, WhoeverDrivesAnyWayArrivesAtTheEndAndStandsThereAsPlanned) {
  FakeDriver driver;
  Trajectory trajectory = AroundTheCorner();
  trajectory.waypoints.back().dwell_s = 0.3;
  const auto motion =
      StartMotion(Following::kByOthers, trajectory, FollowerOptions(), driver.now_ns());
  driver.set_pose({2.1, 0.2, 0.0});  // the corner was cut
  ASSERT_TRUE(motion->Step(driver).ok());
  EXPECT_EQ(driver.twist().forward_mps, 0.0);
  EXPECT_FALSE(motion->done());
  EXPECT_FALSE(motion->standing());
  EXPECT_THAT(motion->PathAhead(driver.pose()),
              ElementsAre(Point2{2.1, 0.2}, Point2{2.0, 0.0}, Point2{2.0, 1.0}));

  driver.set_pose({2.05, 0.95, 0.0});
  ASSERT_TRUE(motion->Step(driver).ok());
  EXPECT_TRUE(motion->standing());
  EXPECT_FALSE(motion->done());
  driver.set_now_ns(driver.now_ns() + kSecond_ns / 2);
  ASSERT_TRUE(motion->Step(driver).ok());
  EXPECT_TRUE(motion->done());
}

// Real robots do not jump.
class RealRobot final : public RobotDriver {
 public:
  std::int64_t now_ns() const override { return 0; }
  Pose2 pose() const override { return {}; }
  absl::StatusOr<Scan> TakeScan() override { return absl::UnavailableError("no lidar"); }
  absl::StatusOr<GasReading> ReadGas() override { return absl::UnavailableError("no gas sensor"); }
  absl::Status Drive(const Twist&) override { return absl::InternalError("wheels are stuck"); }
  absl::Status PlaceAt(const Pose2&) override { return absl::UnimplementedError("cannot jump"); }
  absl::Status Advance(double) override { return absl::OkStatus(); }
};

TEST(MotionTest, WhatTheRobotRefusesIsPassedOn) {
  RealRobot robot;
  const Trajectory trajectory = AroundTheCorner();

  EXPECT_TRUE(absl::IsUnimplemented(
      StartMotion(Following::kIdeal, trajectory, {}, robot.now_ns())->Step(robot)));
  EXPECT_TRUE(absl::IsInternal(
      StartMotion(Following::kProportional, trajectory, {}, robot.now_ns())->Step(robot)));
}

TEST(MotionTest, TellsWhetherTheRobotStands) {
  for (const Following following : {Following::kIdeal, Following::kProportional}) {
    FakeDriver driver;
    const auto motion = Start(following, driver);
    int stops = 0;
    bool stood = true;
    while (!motion->done()) {
      ASSERT_TRUE(motion->Step(driver).ok());
      if (motion->standing() && !stood) ++stops;
      stood = motion->standing();
      const Pose2 before = driver.pose();
      ASSERT_TRUE(driver.Advance(kTick_s).ok());
      if (stood && following == Following::kProportional) {
        EXPECT_EQ(driver.pose(), before);
      }
    }
    EXPECT_EQ(stops, 2) << "at the corner and at the end";
    EXPECT_TRUE(motion->standing());
  }
}

}  // namespace motion_test
}  // namespace plumescout::client
