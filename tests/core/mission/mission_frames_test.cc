// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Robots that register again with a frame that lies elsewhere.
#include <gtest/gtest.h>

#include "core/mission/mission.h"

namespace plumescout {
namespace mission_frames_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(MissionFrames, ARobotWhoseFrameIsPutElsewhereTellsAnewWhereItIs) {
  const auto mission = *Mission::Create({});
  RobotRegistered registration{"a", 0.2, 1};
  ASSERT_TRUE(mission->Apply(registration).ok());
  const auto read_at = [&](std::int64_t sequence, double x_m) {
    const Observation reading{sequence, sequence * kSecond_ns, {x_m, 0, 0}, GasReading{1.0, 0.0}};
    const auto applied = mission->Apply(ObservationReceived{"a", reading});
    return applied.ok() && applied->observation.ok();
  };
  ASSERT_TRUE(read_at(1, 0.0) && read_at(2, 1.0));
  Plan plan;
  plan.robot = "a";
  plan.candidates.resize(1);
  plan.chosen = 0;
  ASSERT_TRUE(mission->Apply(PlanIssued{plan}).ok());
  registration.lease_token = 2;
  registration.frame.position_stddev_m = 0.1;
  ASSERT_TRUE(mission->Apply(registration).ok());
  EXPECT_TRUE(mission->Snapshot()->robots.at("a").state.has_pose) << "it is where it was";
  EXPECT_TRUE(mission->HasWay("a"));
  registration.lease_token = 3;
  registration.frame.mission_from_robot = {10.0, 0.0, 0.0};
  ASSERT_TRUE(mission->Apply(registration).ok());
  EXPECT_FALSE(mission->Snapshot()->robots.at("a").state.has_pose);
  EXPECT_FALSE(mission->HasWay("a"));
  ASSERT_TRUE(read_at(3, 1.0));
  const RobotRecord record = mission->Snapshot()->robots.at("a");
  EXPECT_EQ(record.state.pose.position(), (Point2{11.0, 0.0}));
  EXPECT_EQ(record.travelled_m, 1.0) << "it did not drive from frame to frame";
  EXPECT_EQ(record.first_place, (Point2{0.0, 0.0}));
}

}  // namespace mission_frames_test
}  // namespace plumescout
