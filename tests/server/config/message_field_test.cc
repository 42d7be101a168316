// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/message_field.h"

#include <gtest/gtest.h>

#include "plumescout/v1/options.pb.h"

namespace plumescout::server {
namespace {

TEST(MessageFieldTest, EveryKindOfFieldIsSet) {
  v1::MissionOptions options;
  EXPECT_TRUE(SetMessageField(options, "pose_limit_m", "50.5").ok());
  EXPECT_TRUE(SetMessageField(options, "seed", "-9223372036854775808").ok());
  EXPECT_TRUE(SetMessageField(options, "planning.sample_count", "77").ok());
  EXPECT_TRUE(SetMessageField(options, "planning.grid_guard", "false").ok());
  EXPECT_TRUE(SetMessageField(options, "planning.strategy", "xit_f").ok());
  EXPECT_TRUE(SetMessageField(options, "planning.goal_policy", "occupancy_first").ok());
  EXPECT_EQ(options.pose_limit_m(), 50.5);
  EXPECT_EQ(options.seed(), INT64_MIN);
  EXPECT_EQ(options.planning().sample_count(), 77);
  EXPECT_TRUE(options.planning().has_grid_guard());
  EXPECT_FALSE(options.planning().grid_guard());
  EXPECT_EQ(options.planning().strategy(), "xit_f");
  EXPECT_EQ(options.planning().goal_policy(), v1::GOAL_POLICY_OCCUPANCY_FIRST);
}

TEST(MessageFieldTest, UnknownPathsAreNotFound) {
  v1::MissionOptions options;
  for (const char* path : {"", "sead", "planning", "seed.x", "planning.", "planning.seed"}) {
    EXPECT_TRUE(absl::IsNotFound(SetMessageField(options, path, "1"))) << path;
  }
}

TEST(MessageFieldTest, ElementsOfListsAreSetAndAddedAtTheEnd) {
  v1::MissionOptions options;
  EXPECT_TRUE(SetMessageField(options, "keep_out[0].vertices[0].x_m", "1").ok());
  EXPECT_TRUE(SetMessageField(options, "keep_out[0].vertices[1].x_m", "2").ok());
  EXPECT_TRUE(SetMessageField(options, "keep_out[0].vertices[0].x_m", "3").ok());
  ASSERT_EQ(options.keep_out_size(), 1);
  ASSERT_EQ(options.keep_out(0).vertices_size(), 2);
  EXPECT_EQ(options.keep_out(0).vertices(0).x_m(), 3.0);
  for (const char* path :
       {"keep_out", "keep_out.vertices", "keep_out[0]", "keep_out[2].vertices",
        "keep_out[-1].vertices[0].x_m", "keep_out[x].vertices[0].x_m", "keep_out[0.vertices[0].x_m",
        "seed[0]", "planning[0].beta", "keep_out[99999999999].vertices[0].x_m"}) {
    EXPECT_TRUE(absl::IsNotFound(SetMessageField(options, path, "1"))) << path;
  }
}

TEST(MessageFieldTest, TextThatIsNoValueIsRefused) {
  v1::MissionOptions options;
  EXPECT_TRUE(absl::IsInvalidArgument(SetMessageField(options, "pose_limit_m", "far")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetMessageField(options, "seed", "1.5")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetMessageField(options, "max_robot_count", "3000000000")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetMessageField(options, "planning.grid_guard", "yes")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetMessageField(options, "planning.cost", "free")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetMessageField(options, "planning.cost", "unspecified")));
}

}  // namespace
}  // namespace plumescout::server
