// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/tf_buffer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/client/ros2/stamped.h"

namespace plumescout::client {
namespace tf_buffer_test {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// map → odom → base_link → laser, from 100 s on.
TfBuffer Robot() {
  TfBuffer tf;
  EXPECT_TRUE(tf.Add(Stamped("base_link", "laser", 0, {0.2, 0.0, M_PI}), true).ok());
  EXPECT_TRUE(tf.Add(Stamped("map", "odom", 100 * kSecond_ns, {10.0, 0.0, 0.0}), false).ok());
  EXPECT_TRUE(tf.Add(Stamped("map", "odom", 102 * kSecond_ns, {10.0, 0.0, 0.0}), false).ok());
  EXPECT_TRUE(tf.Add(Stamped("odom", "base_link", 100 * kSecond_ns, {0.0, 1.0, 0.0}), false).ok());
  EXPECT_TRUE(tf.Add(Stamped("odom", "base_link", 101 * kSecond_ns, {2.0, 1.0, 0.0}), false).ok());
  return tf;
}

TEST(TfBuffer, InterpolatesAlongTheChain) {
  const auto laser = Robot().Lookup("map", "laser", 100 * kSecond_ns + kSecond_ns / 4);
  ASSERT_TRUE(laser.ok()) << laser.status();
  EXPECT_NEAR(ToPlanar(*laser).x_m, 10.7, 1e-12);
  EXPECT_NEAR(ToPlanar(*laser).y_m, 1.0, 1e-12);
  EXPECT_NEAR(ToPlanar(*laser).yaw_rad, M_PI, 1e-12);
}

TEST(TfBuffer, LooksDownTheTreeToo) {
  const auto map = Robot().Lookup("laser", "/map", 100 * kSecond_ns);
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_NEAR(ToPlanar(*map).x_m, 10.2, 1e-12);
  EXPECT_NEAR(ToPlanar(*map).y_m, 1.0, 1e-12);
}

TEST(TfBuffer, SaysWhetherATransformMayStillCome) {
  const TfBuffer tf = Robot();
  const auto later = tf.Lookup("map", "laser", 102 * kSecond_ns).status();
  EXPECT_TRUE(absl::IsUnavailable(later));
  EXPECT_THAT(later.message(), HasSubstr("odom → base_link is known up to 101 s"));
  const auto earlier = tf.Lookup("map", "laser", 99 * kSecond_ns).status();
  EXPECT_TRUE(absl::IsOutOfRange(earlier));
  EXPECT_THAT(earlier.message(), HasSubstr("is known from 100 s on"));
  EXPECT_EQ(tf.NewestTime_ns("map", "laser"), 101 * kSecond_ns);
}

TEST(TfBuffer, NamesADeadEnd) {
  const TfBuffer tf = Robot();
  const auto gas = tf.Lookup("base_link", "gas_sensor", 100 * kSecond_ns).status();
  EXPECT_TRUE(absl::IsNotFound(gas));
  EXPECT_EQ(gas.message(),
            "no transform base_link → gas_sensor yet: nobody says where gas_sensor is, base_link "
            "hangs from map");
  EXPECT_EQ(tf.Lookup("map", "gas_sensor", 0).status().message(),
            "no transform map → gas_sensor yet: nobody says where gas_sensor is");
  EXPECT_EQ(tf.Lookup("earth", "laser", 0).status().message(),
            "no transform earth → laser yet: laser hangs from map, nothing hangs from earth");
  EXPECT_FALSE(tf.NewestTime_ns("map", "gas_sensor").has_value());
}

TEST(TfBuffer, NamesALoop) {
  TfBuffer tf;
  ASSERT_TRUE(tf.Add(Stamped("a", "b", 0, {}), false).ok());
  ASSERT_TRUE(tf.Add(Stamped("b", "c", 0, {}), false).ok());
  ASSERT_TRUE(tf.Add(Stamped("c", "a", 0, {}), false).ok());
  const auto loop = tf.Lookup("map", "b", 0).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(loop));
  EXPECT_THAT(loop.message(), HasSubstr("loop: b ← a ← c ← b"));
  EXPECT_THAT(tf.Add(Stamped("a", "/a", 0, {}), false).message(), HasSubstr("a → a is a loop"));
}

TEST(TfBuffer, HoldsTheNewestOfTheFrameThatIsCorrected) {
  TfBuffer tf = Robot();
  tf.HoldNewest("odom");
  ASSERT_TRUE(tf.Add(Stamped("map", "odom", 103 * kSecond_ns, {20.0, 0.0, 0.0}), false).ok());
  const auto base = tf.Lookup("map", "base_link", 101 * kSecond_ns);
  ASSERT_TRUE(base.ok()) << base.status();
  EXPECT_NEAR(ToPlanar(*base).x_m, 22.0, 1e-12);
}

TEST(TfBuffer, BeginsAnewWhenTimeIsSetBack) {
  TfBuffer tf = Robot();
  ASSERT_TRUE(tf.Add(Stamped("odom", "base_link", 5 * kSecond_ns, {7.0, 0.0, 0.0}), false).ok());
  EXPECT_EQ(tf.clocks_set_back(), 1);
  const auto base = tf.Lookup("odom", "base_link", 5 * kSecond_ns);
  ASSERT_TRUE(base.ok()) << base.status();
  EXPECT_NEAR(ToPlanar(*base).x_m, 7.0, 1e-12);
  EXPECT_FALSE(tf.Lookup("odom", "base_link", 100 * kSecond_ns).ok());
}

TEST(TfBuffer, KeepsWhatComesOutOfOrderButNotForEver) {
  TfBuffer tf = Robot();
  ASSERT_TRUE(
      tf.Add(Stamped("odom", "base_link", 100 * kSecond_ns + kSecond_ns / 2, {0.0, 3.0, 0.0}),
             false)
          .ok());
  EXPECT_NEAR(ToPlanar(*tf.Lookup("odom", "base_link", 100 * kSecond_ns + kSecond_ns / 2)).y_m, 3.0,
              1e-12);
  ASSERT_TRUE(tf.Add(Stamped("odom", "base_link", 120 * kSecond_ns, {}), false).ok());
  EXPECT_TRUE(absl::IsOutOfRange(tf.Lookup("odom", "base_link", 101 * kSecond_ns).status()));
}

TEST(TfBuffer, RefusesWhatIsNoTransform) {
  TfBuffer tf;
  ros::TransformStamped bad = Stamped("map", "odom", 0, {});
  bad.transform.position.x = std::numeric_limits<double>::infinity();
  EXPECT_THAT(tf.Add(bad, false).message(), HasSubstr("map → odom is not finite"));
  EXPECT_THAT(tf.Add(Stamped("map", "", 0, {}), false).message(), HasSubstr("lacks the name"));
  EXPECT_FALSE(tf.Has("odom"));
}

}  // namespace tf_buffer_test
}  // namespace plumescout::client
