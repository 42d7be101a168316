// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/ros2_driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/client/ros2/stamped.h"

namespace plumescout::client {
namespace ros2_driver_test {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kStep_ns = kSecond_ns / 10;
constexpr std::int64_t kStamp_ns =
    500 * kSecond_ns;  // the robot's time when the steady clock has 0

// A robot that drives east at 1 m/s and is listened to ten times a second.
class Ros2DriverTest : public ::testing::Test {
 protected:
  Ros2DriverTest() {
    intake_.OnTransforms({.transforms = {Stamped("base_link", "laser", 0, {0.2, 0.0, 0.0})}}, true);
    intake_.OnTransforms({.transforms = {Stamped("map", "odom", kStamp_ns, {})}}, false);
  }
  void Listen(absl::Duration timeout) {
    steady_ns_ += absl::ToInt64Nanoseconds(timeout);
    if (!publishes_) return;
    const double x_m = static_cast<double>(steady_ns_) * 1e-9;
    intake_.OnTransforms({.transforms = {Stamped("odom", "base_link", Now(), {x_m, 0.0, 0.0})}},
                         false);
    ros::LaserScan scan;
    scan.header = {.stamp = ros::ToTime(Now()), .frame_id = "laser"};
    scan.angle_increment = 0.1F;
    scan.range_max = 8.0F;
    scan.ranges = {1.0F, 2.0F};
    intake_.OnScan(scan, steady_ns_);
    ros::GasSensor gas;
    gas.header = {.stamp = scan.header.stamp, .frame_id = "base_link"};
    gas.raw = 5.0;
    gas.raw_units = ros::GasSensor::kPpm;
    intake_.OnGas(gas, steady_ns_);
  }
  std::int64_t Now() const { return kStamp_ns + steady_ns_; }

  bool publishes_ = true;
  std::int64_t steady_ns_ = 0;
  std::vector<Twist> driven_;
  RobotIntake intake_{IntakeOptions{}};
  Ros2Driver driver_{intake_,
                     {.listen = [this](absl::Duration timeout) { Listen(timeout); },
                      .drive =
                          [this](const Twist& twist) {
                            driven_.push_back(twist);
                            return absl::OkStatus();
                          },
                      .steady_ns = [this] { return steady_ns_; }},
                     Ros2DriverOptions{}};
};

TEST_F(Ros2DriverTest, HandsOnTheNewestSampleAndWhereItsSensorWas) {
  ASSERT_TRUE(driver_.AwaitPlace(absl::Seconds(5), NeverStop()).ok());
  while (steady_ns_ < 11 * kStep_ns) ASSERT_TRUE(driver_.Advance(0.1).ok());
  EXPECT_EQ(driver_.now_ns(), Now());
  EXPECT_NEAR(driver_.pose().x_m, 1.1, 1e-9);
  const auto scan = driver_.TakeScan();
  ASSERT_TRUE(scan.ok()) << scan.status();
  EXPECT_EQ(driver_.sample_time_ns(), Now());
  EXPECT_NEAR(driver_.sample_pose().x_m, 1.3, 1e-9);
  const auto gas = driver_.ReadGas();
  ASSERT_TRUE(gas.ok()) << gas.status();
  EXPECT_NEAR(driver_.sample_pose().x_m, 1.1, 1e-9);
  EXPECT_TRUE(absl::IsUnavailable(driver_.TakeScan().status())) << "each once";
}

TEST_F(Ros2DriverTest, WaitsForAScanInTheSecondHalfAndNoLonger) {
  ASSERT_TRUE(driver_.AwaitPlace(absl::Seconds(5), NeverStop()).ok());
  const std::int64_t begin_ns = steady_ns_;
  ASSERT_TRUE(driver_.Advance(0.4).ok());
  EXPECT_EQ(steady_ns_ - begin_ns, 2 * kStep_ns);
  publishes_ = false;
  ASSERT_TRUE(driver_.Advance(0.4).ok());
  EXPECT_EQ(steady_ns_ - begin_ns, 6 * kStep_ns);
}

// As where transforms of the mounts come late.
TEST(Ros2DriverPlace, IsNotKnownBeforeThatOfTheScannerIs) {
  std::int64_t steady_ns = 0;
  RobotIntake intake{IntakeOptions{}};
  const Ros2Ports ports{.listen =
                            [&](absl::Duration timeout) {
                              steady_ns += absl::ToInt64Nanoseconds(timeout);
                              intake.OnTransforms(
                                  {.transforms = {Stamped("map", "odom", steady_ns, {}),
                                                  Stamped("odom", "base_link", steady_ns, {})}},
                                  false);
                            },
                        .steady_ns = [&] { return steady_ns; }};
  Ros2Driver driver(intake, ports, Ros2DriverOptions{});
  EXPECT_THAT(driver.AwaitPlace(absl::Seconds(3), NeverStop()).message(),
              HasSubstr("no scan that could be placed"));
  Ros2Driver blind(intake, ports, Ros2DriverOptions{.has_scanner = false});
  EXPECT_TRUE(blind.AwaitPlace(absl::Seconds(3), NeverStop()).ok());
}

TEST_F(Ros2DriverTest, ClockGoesOnBetweenStamps) {
  ASSERT_TRUE(driver_.AwaitPlace(absl::Seconds(5), NeverStop()).ok());
  publishes_ = false;
  const std::int64_t before_ns = driver_.now_ns();
  ASSERT_TRUE(driver_.Advance(0.3).ok());
  EXPECT_EQ(driver_.now_ns(), before_ns + 3 * kStep_ns);
}

TEST_F(Ros2DriverTest, RobotWhosePlaceIsNotKnownStands) {
  ASSERT_TRUE(driver_.AwaitPlace(absl::Seconds(5), NeverStop()).ok());
  ASSERT_TRUE(driver_.Drive({0.5, 0.1}).ok());
  EXPECT_EQ(driven_.back().forward_mps, 0.5);
  publishes_ = false;
  ASSERT_TRUE(driver_.Advance(1.5).ok());
  EXPECT_FALSE(driver_.knows_place());
  ASSERT_TRUE(driver_.Drive({0.5, 0.1}).ok());
  EXPECT_EQ(driven_.back().forward_mps, 0.0);
  EXPECT_EQ(driven_.back().turn_rad_per_s, 0.0);
  publishes_ = true;
  ASSERT_TRUE(driver_.Advance(0.1).ok());
  ASSERT_TRUE(driver_.Drive({0.5, 0.1}).ok());
  EXPECT_EQ(driven_.back().forward_mps, 0.5);
}

TEST_F(Ros2DriverTest, SilenceIsAnErrorThatSaysWhatIsMissing) {
  publishes_ = false;
  EXPECT_THAT(driver_.AwaitPlace(absl::Seconds(3), NeverStop()).message(),
              HasSubstr("no transform map → base_link yet"));
  EXPECT_TRUE(absl::IsCancelled(driver_.AwaitPlace(absl::Seconds(3), [] { return true; })));
  publishes_ = true;
  ASSERT_TRUE(driver_.AwaitPlace(absl::Seconds(5), NeverStop()).ok());
  publishes_ = false;
  EXPECT_TRUE(absl::IsUnavailable(driver_.Advance(11.0)));
}

TEST_F(Ros2DriverTest, JumpOfTheFrameIsACorrectionAndWhatWaitedIsDropped) {
  ASSERT_TRUE(driver_.AwaitPlace(absl::Seconds(5), NeverStop()).ok());
  ASSERT_TRUE(driver_.Advance(0.2).ok());
  ASSERT_TRUE(driver_.TakeScan().ok());
  const std::int64_t first_ns = driver_.sample_time_ns();
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(driver_.Advance(0.1).ok());
  EXPECT_FALSE(driver_.TakeCorrection().has_value());
  publishes_ = false;
  intake_.OnTransforms({.transforms = {Stamped("map", "odom", Now(), {0.0, 1.0, 0.0})}}, false);
  ASSERT_TRUE(driver_.Advance(0.1).ok());
  EXPECT_NEAR(driver_.pose().y_m, 1.0, 1e-9);
  EXPECT_TRUE(absl::IsUnavailable(driver_.TakeScan().status()));
  const auto correction = driver_.TakeCorrection();
  ASSERT_TRUE(correction.has_value());
  EXPECT_EQ(correction->anchors.front().sample_time_ns, first_ns)
      << "of scans before it nobody has heard";
  EXPECT_LT(correction->anchors.front().pose.y_m, 0.2);
  EXPECT_NEAR(correction->anchors.back().pose.y_m, 1.0, 1e-9);
  EXPECT_FALSE(driver_.TakeCorrection().has_value());
}

TEST_F(Ros2DriverTest, JumpBeforeAnythingWasTakenIsNoCorrection) {
  ASSERT_TRUE(driver_.AwaitPlace(absl::Seconds(5), NeverStop()).ok());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(driver_.Advance(0.1).ok());
  intake_.OnTransforms({.transforms = {Stamped("map", "odom", Now(), {0.0, 1.0, 0.0})}}, false);
  ASSERT_TRUE(driver_.Advance(0.1).ok());
  EXPECT_EQ(intake_.jumps(), 1);
  EXPECT_FALSE(driver_.TakeCorrection().has_value());
}

TEST_F(Ros2DriverTest, IsNotPlaced) {
  EXPECT_TRUE(absl::IsUnimplemented(driver_.PlaceAt({})));
  Ros2Driver others(intake_, {.listen = [](absl::Duration) {}}, Ros2DriverOptions{});
  EXPECT_TRUE(others.Drive({1.0, 0.0}).ok()) << "somebody else drives";
}

}  // namespace ros2_driver_test
}  // namespace plumescout::client
