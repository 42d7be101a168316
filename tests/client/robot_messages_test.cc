// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_messages.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "proto/convert/status.h"

namespace plumescout::client {
namespace robot_messages_test {

v1::Robot Scout() {
  v1::Robot proto;
  proto.mutable_on_map()->set_robot("missions/house/robots/scout");
  proto.set_link(v1::ROBOT_LINK_IDLE);
  return proto;
}

TEST(RobotMessagesTest, ARegistrationSaysHowItTakesPart) {
  const v1::RegisterRobotRequest plain = RegistrationOf({.mission = "house", .robot = "scout"});
  EXPECT_EQ(plain.mission(), "missions/house");
  EXPECT_EQ(plain.robot_id(), "scout");
  EXPECT_FALSE(plain.has_frame()) << "it is the mission's";
  const v1::RegisterRobotRequest outfit =
      RegistrationOf({.mission = "house",
                      .robot = "scout",
                      .radius_m = 0.3,
                      .take_over = true,
                      .log_epoch = 9,
                      .frame = {.mission_from_robot = {1.0, 0.0, 0.0}},
                      .sensors = std::vector<GasSensor>(1)});
  EXPECT_EQ(outfit.radius_m(), 0.3);
  EXPECT_TRUE(outfit.take_over());
  EXPECT_EQ(outfit.log_epoch(), 9);
  EXPECT_EQ(outfit.frame().mission_from_robot().x_m(), 1.0);
  ASSERT_EQ(outfit.gas_sensors_size(), 1);
}

TEST(RobotMessagesTest, ARobotIsReadWhole) {
  v1::Robot proto = Scout();
  proto.set_leased(true);
  proto.set_battery_share(0.5);
  proto.set_battery_low(true);
  proto.set_last_heard_age_s(2.0);
  proto.set_ingest_lag_s(0.5);
  proto.set_live_plan("missions/house/plans/7");
  proto.set_progress_s(3.0);
  proto.set_lateness_s(1.0);
  proto.set_arrival_time_ns(99);
  proto.mutable_home()->set_x_m(4.0);
  const auto robot = DetailsFromProto(proto);
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_EQ(robot->state.id, "scout");
  EXPECT_EQ(robot->state.battery_share, 0.5);
  EXPECT_EQ(robot->link, RobotLink::kIdle);
  EXPECT_TRUE(robot->leased);
  EXPECT_TRUE(robot->battery_low);
  EXPECT_EQ(robot->last_heard_age_s, 2.0);
  EXPECT_EQ(robot->ingest_lag_s, 0.5);
  EXPECT_EQ(robot->live_plan, (PlanProgress{7, 3.0, 1.0, 99}));
  EXPECT_EQ(robot->home, (Point2{4.0, 0.0}));
}

TEST(RobotMessagesTest, ALinkThatIsNotKnownIsUnknown) {
  v1::Robot proto = Scout();
  constexpr int kOfAnotherDay = 99;
  proto.set_link(static_cast<v1::RobotLink>(kOfAnotherDay));
  const auto robot = DetailsFromProto(proto);
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_EQ(robot->link, RobotLink::kUnknown);
  EXPECT_EQ(robot->clock_offset_ns, std::nullopt);
}

TEST(RobotMessagesTest, AnOffsetOfNothingIsAnOffset) {
  v1::Robot proto = Scout();
  proto.set_clock_offset_s(0.0);
  EXPECT_EQ(DetailsFromProto(proto)->clock_offset_ns, 0);
  proto.set_clock_offset_s(1e12);
  EXPECT_EQ(FieldViolations(DetailsFromProto(proto).status()).at(0).field, "robot.clock_offset_s");
}

}  // namespace robot_messages_test
}  // namespace plumescout::client
