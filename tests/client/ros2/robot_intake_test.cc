// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/robot_intake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/client/ros2/stamped.h"

namespace plumescout::client {
namespace robot_intake_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kBegin_ns = 100 * kSecond_ns;

class RobotIntakeTest : public ::testing::Test {
 protected:
  void PublishStatic() {
    intake_.OnTransforms({.transforms = {Stamped("base_link", "laser", 0, {0.2, 0.0, 0.0}),
                                         Stamped("base_link", "nose", 0, {0.0, 0.5, 0.0})}},
                         true);
    intake_.OnTransforms({.transforms = {Stamped("map", "odom", kBegin_ns, {10.0, 0.0, 0.0})}},
                         false);
  }
  void PublishOdometry(double time_s, double x_m) {
    intake_.OnTransforms(
        {.transforms = {Stamped("odom", "base_link", At(time_s), {x_m, 0.0, 0.0})}}, false);
  }
  static std::int64_t At(double time_s) {
    return kBegin_ns + static_cast<std::int64_t>(time_s * 1e9);
  }
  static ros::LaserScan ScanAt(double time_s, const std::string& frame = "laser") {
    ros::LaserScan scan;
    scan.header = {.stamp = ros::ToTime(At(time_s)), .frame_id = frame};
    scan.angle_increment = 0.1F;
    scan.range_max = 8.0F;
    scan.ranges = {1.0F, 2.0F};
    return scan;
  }
  static ros::GasSensor GasAt(double time_s) {
    ros::GasSensor gas;
    gas.header = {.stamp = ros::ToTime(At(time_s)), .frame_id = "nose"};
    gas.raw = 5.0;
    gas.raw_units = ros::GasSensor::kPpm;
    return gas;
  }

  std::vector<std::string> complaints_;
  RobotIntake intake_{IntakeOptions{}, [this](const std::string& about, const absl::Status& why) {
                        complaints_.push_back(about + ": " + std::string(why.message()));
                      }};
};

TEST_F(RobotIntakeTest, PlacesSamplesWhereTheirSensorsWere) {
  PublishStatic();
  PublishOdometry(0.0, 0.0);
  PublishOdometry(1.0, 2.0);
  intake_.OnScan(ScanAt(0.5), 0);
  intake_.OnGas(GasAt(0.25), 0);
  const auto scan = intake_.TakeScan(0);
  ASSERT_TRUE(scan.has_value());
  EXPECT_NEAR(scan->pose.x_m, 11.2, 1e-9);
  EXPECT_EQ(scan->time_ns, At(0.5));
  EXPECT_THAT(scan->reading.ranges_m, ElementsAre(1.0F, 2.0F));
  const auto gas = intake_.TakeGas(0);
  ASSERT_TRUE(gas.has_value());
  EXPECT_NEAR(gas->pose.x_m, 10.5, 1e-9);
  EXPECT_NEAR(gas->pose.y_m, 0.5, 1e-9);
  EXPECT_EQ(gas->reading.concentration_ppm, 5.0);
  EXPECT_FALSE(intake_.TakeScan(0).has_value());
  EXPECT_THAT(complaints_, IsEmpty());
}

TEST_F(RobotIntakeTest, WaitsForTransformsThatAreLateButNotForEver) {
  PublishStatic();
  PublishOdometry(0.0, 0.0);
  intake_.OnScan(ScanAt(0.1), 0);
  intake_.OnScan(ScanAt(0.2), 0);
  EXPECT_FALSE(intake_.TakeScan(kSecond_ns / 10).has_value());
  EXPECT_THAT(intake_.Waiting().message(), HasSubstr("odom → base_link is known up to 100 s"));
  PublishOdometry(0.1, 0.1);
  EXPECT_TRUE(intake_.TakeScan(kSecond_ns / 5).has_value());
  EXPECT_FALSE(intake_.TakeScan(kSecond_ns).has_value());  // the other has waited too long
  EXPECT_EQ(intake_.counters().unplaced, 1);
  EXPECT_THAT(complaints_, ElementsAre(HasSubstr("scan: transform odom → base_link")));
  EXPECT_TRUE(intake_.Waiting().ok());
}

TEST_F(RobotIntakeTest, SaysWhichTransformIsMissing) {
  EXPECT_THAT(intake_.LatestPose().status().message(),
              HasSubstr("no transform map → base_link yet"));
  PublishStatic();
  PublishOdometry(0.0, 1.0);
  const auto pose = intake_.LatestPose();
  ASSERT_TRUE(pose.ok()) << pose.status();
  EXPECT_NEAR(pose->pose.x_m, 11.0, 1e-9);
  intake_.OnScan(ScanAt(0.0, "lidar"), 0);
  intake_.TakeScan(0);
  EXPECT_THAT(intake_.Waiting().message(), HasSubstr("no transform map → lidar yet"));
}

TEST_F(RobotIntakeTest, AScanThatCanBePlacedDoesNotHideThatAReadingCannot) {
  PublishStatic();
  PublishOdometry(0.0, 1.0);
  intake_.OnScan(ScanAt(0.0), 0);
  ros::GasSensor gas = GasAt(0.0);
  gas.header.frame_id = "gas_sensor";
  intake_.OnGas(gas, 0);
  EXPECT_THAT(intake_.Waiting().message(), HasSubstr("nobody says where gas_sensor is"));
}

TEST_F(RobotIntakeTest, TakesThePoseOfOdometryIfNobodyPublishesTheTransform) {
  PublishStatic();
  ros::Odometry odometry;
  odometry.header = {.stamp = ros::ToTime(kBegin_ns), .frame_id = "odom"};
  odometry.child_frame_id = "base_link";
  odometry.pose = FromPlanar({3.0, 0.0, 0.0});
  intake_.OnOdometry(odometry);
  EXPECT_NEAR(intake_.LatestPose()->pose.x_m, 13.0, 1e-9);
  PublishOdometry(1.0, 4.0);
  odometry.header.stamp = ros::ToTime(At(2.0));
  intake_.OnOdometry(odometry);  // the transform goes first
  EXPECT_NEAR(intake_.LatestPose()->pose.x_m, 14.0, 1e-9);
}

TEST_F(RobotIntakeTest, ReportsAJumpOfTheFrameAsACorrection) {
  PublishStatic();
  for (int i = 0; i <= 4; ++i) {
    PublishOdometry(i, i);
    intake_.OnScan(ScanAt(i), 0);
    ASSERT_TRUE(intake_.TakeScan(0).has_value());
  }
  EXPECT_FALSE(intake_.TakeCorrection().has_value());
  intake_.OnTransforms({.transforms = {Stamped("map", "odom", At(4.0), {10.0, 1.0, 0.0})}}, false);
  intake_.OnScan(ScanAt(4.0 + 1e-3), 0);
  PublishOdometry(5.0, 5.0);
  const auto correction = intake_.TakeCorrection();
  ASSERT_TRUE(correction.has_value());
  ASSERT_EQ(correction->anchors.size(), 5u);
  EXPECT_NEAR(correction->anchors[2].pose.x_m, 12.2, 1e-9);
  EXPECT_NEAR(correction->anchors[2].pose.y_m, 0.5, 1e-9);
  EXPECT_EQ(correction->anchors[2].sample_time_ns, At(2.0));
  // What is taken from now on is in the frame as it is now.
  EXPECT_NEAR(intake_.TakeScan(0)->pose.y_m, 1.0, 1e-9);
}

TEST_F(RobotIntakeTest, RefusesWhatMakesNoSenseAndGoesOn) {
  PublishStatic();
  PublishOdometry(0.0, 0.0);
  PublishOdometry(1.0, 0.0);
  intake_.OnScan(ScanAt(0.5), 0);
  intake_.OnScan(ScanAt(0.4), 0);
  ros::LaserScan bad = ScanAt(0.6);
  bad.angle_increment = 0.0F;
  intake_.OnScan(bad, 0);
  intake_.OnScan(ScanAt(0.7, ""), 0);
  ros::GasSensor ohm = GasAt(0.5);
  ohm.raw_units = ros::GasSensor::kOhm;
  intake_.OnGas(ohm, 0);
  ros::Anemometer wind;
  intake_.OnWind(wind);
  wind.wind_speed = -1.0F;
  intake_.OnWind(wind);
  intake_.OnTransforms({.transforms = {Stamped("map", "map", 0, {})}}, false);
  EXPECT_THAT(
      complaints_,
      ElementsAre(HasSubstr("scan: time runs backwards"), HasSubstr("scan: angle_increment is 0"),
                  HasSubstr("scan: header.frame_id is empty"), HasSubstr("gas: raw_units is OHM"),
                  HasSubstr("wind: wind_speed is -1"),
                  HasSubstr("/tf: transform map → map is a loop")));
  EXPECT_EQ(intake_.counters().bad, 6);
  EXPECT_EQ(intake_.counters().winds, 1);
  EXPECT_TRUE(intake_.TakeScan(0).has_value());
}

TEST_F(RobotIntakeTest, GoesOnWithAClockThatWasSetBack) {
  PublishStatic();
  PublishOdometry(50.0, 0.0);
  intake_.OnScan(ScanAt(50.0), 0);
  ASSERT_TRUE(intake_.TakeScan(0).has_value());
  EXPECT_EQ(intake_.newest_ns(), At(50.0));
  PublishOdometry(1.0, 0.0);
  intake_.OnScan(ScanAt(1.0), 0);
  EXPECT_TRUE(intake_.TakeScan(0).has_value());
  EXPECT_EQ(intake_.newest_ns(), At(1.0));
}

TEST_F(RobotIntakeTest, RefusesAScannerThatIsNotLevel) {
  PublishStatic();
  ros::TransformStamped mount = Stamped("base_link", "tilted", 0, {});
  mount.transform.orientation = {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)};
  intake_.OnTransforms({.transforms = {mount}}, true);
  PublishOdometry(0.0, 0.0);
  intake_.OnScan(ScanAt(0.0, "tilted"), 0);
  EXPECT_FALSE(intake_.TakeScan(0).has_value());
  EXPECT_THAT(complaints_, ElementsAre(HasSubstr("frame tilted is not level")));
}

TEST_F(RobotIntakeTest, KeepsABoundedNumberOfSamples) {
  PublishStatic();
  for (int i = 0; i < 40; ++i) intake_.OnScan(ScanAt(0.1 * i), 0);
  EXPECT_EQ(intake_.counters().overrun, 8);
}

}  // namespace robot_intake_test
}  // namespace plumescout::client
