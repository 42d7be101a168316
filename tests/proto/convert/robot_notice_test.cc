// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/robot_notice.h"

#include <gtest/gtest.h>

#include <vector>

#include "proto/convert/status.h"

namespace plumescout {
namespace robot_notice_test {

TEST(RobotNoticeTest, EveryNoticeReturns) {
  const std::vector<RobotNotice> notices = {
      RobotStanding{},
      RobotStanding{.paused = true},
      RobotStanding{.finished = true},
      RobotStanding{.ordered_home = true},
      RobotStanding{.frame_suspect = true},
      RobotStanding{.silent = true},
      RobotStanding{.leased = true},
      PlanInvalidated{.plan = 7, .reason = InvalidationReason::kWayBlocked, .detail = "a wall"},
      PlanInvalidated{.plan = 8,
                      .reason = InvalidationReason::kMeetsRobot,
                      .robot = "r2",
                      .meets_in_s = 2.5,
                      .place = Point2{1.0, -2.0}},
      PlanAssigned{9}};
  for (const RobotNotice& notice : notices) {
    const v1::WatchRobotResponse proto = ToProto(notice, "hall");
    const auto back = FromProto(proto);
    ASSERT_TRUE(back.ok()) << back.status();
    EXPECT_EQ(*back, notice) << proto.DebugString();
  }
}

TEST(RobotNoticeTest, NamesAreWhole) {
  const auto proto = ToProto(PlanInvalidated{.plan = 8, .robot = "r2", .place = Point2{}}, "hall");
  EXPECT_EQ(proto.plan_invalidated().plan(), "missions/hall/plans/8");
  EXPECT_EQ(proto.plan_invalidated().robot(), "missions/hall/robots/r2");
  EXPECT_EQ(ToProto(PlanAssigned{9}, "hall").plan_assigned().plan(), "missions/hall/plans/9");
}

TEST(RobotNoticeTest, WhatIsNoneIsRefused) {
  EXPECT_TRUE(absl::IsInvalidArgument(FromProto(v1::WatchRobotResponse()).status()));
  v1::WatchRobotResponse proto;
  proto.mutable_plan_invalidated()->set_plan("8");
  EXPECT_TRUE(absl::IsInvalidArgument(FromProto(proto).status()));
  proto.mutable_plan_invalidated()->set_plan("missions/hall/plans/8");
  EXPECT_TRUE(absl::IsInvalidArgument(FromProto(proto).status()));  // no reason
  proto.mutable_plan_invalidated()->set_reason(v1::PlanInvalidated::REASON_KEPT_OUT);
  EXPECT_TRUE(FromProto(proto).ok());
  proto.mutable_plan_invalidated()->set_robot("r2");
  EXPECT_TRUE(absl::IsInvalidArgument(FromProto(proto).status()));
  proto.mutable_plan_assigned();
  EXPECT_TRUE(absl::IsInvalidArgument(FromProto(proto).status()));
}

}  // namespace robot_notice_test
}  // namespace plumescout
