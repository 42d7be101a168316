// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/option_path.h"

#include <gtest/gtest.h>

#include <string>

#include "plumescout/v1/options.pb.h"

namespace plumescout::server {
namespace option_path_test {

TEST(OptionPathTest, EveryKindOfFieldIsSet) {
  v1::MissionOptions options;
  EXPECT_TRUE(SetOption(options, "pose_limit_m", "50.5").ok());
  EXPECT_TRUE(SetOption(options, "seed", "-9223372036854775808").ok());
  EXPECT_TRUE(SetOption(options, "planning.sample_count", "77").ok());
  EXPECT_TRUE(SetOption(options, "planning.grid_guard", "false").ok());
  EXPECT_TRUE(SetOption(options, "planning.strategy", "xit_f").ok());
  EXPECT_TRUE(SetOption(options, "planning.goal_policy", "occupancy_first").ok());
  EXPECT_EQ(options.pose_limit_m(), 50.5);
  EXPECT_EQ(options.seed(), INT64_MIN);
  EXPECT_EQ(options.planning().sample_count(), 77);
  EXPECT_TRUE(options.planning().has_grid_guard());
  EXPECT_FALSE(options.planning().grid_guard());
  EXPECT_EQ(options.planning().strategy(), "xit_f");
  EXPECT_EQ(options.planning().goal_policy(), v1::GOAL_POLICY_OCCUPANCY_FIRST);
}

TEST(OptionPathTest, UnknownPathsAreNotFound) {
  v1::MissionOptions options;
  for (const char* path : {"", "sead", "planning", "seed.x", "planning.", "planning.seed"}) {
    EXPECT_TRUE(absl::IsNotFound(SetOption(options, path, "1"))) << path;
  }
}

TEST(OptionPathTest, ElementsOfListsAreSetAndAddedAtTheEnd) {
  v1::MissionOptions options;
  EXPECT_TRUE(SetOption(options, "keep_out[0].vertices[0].x_m", "1").ok());
  EXPECT_TRUE(SetOption(options, "keep_out[0].vertices[1].x_m", "2").ok());
  EXPECT_TRUE(SetOption(options, "keep_out[0].vertices[0].x_m", "3").ok());
  ASSERT_EQ(options.keep_out_size(), 1);
  ASSERT_EQ(options.keep_out(0).vertices_size(), 2);
  EXPECT_EQ(options.keep_out(0).vertices(0).x_m(), 3.0);
  for (const char* path :
       {"keep_out", "keep_out.vertices", "keep_out[0]", "keep_out[2].vertices",
        "keep_out[-1].vertices[0].x_m", "keep_out[x].vertices[0].x_m", "keep_out[0.vertices[0].x_m",
        "seed[0]", "planning[0].beta", "keep_out[99999999999].vertices[0].x_m"}) {
    EXPECT_TRUE(absl::IsNotFound(SetOption(options, path, "1"))) << path;
  }
}

TEST(OptionPathTest, TextThatIsNoValueIsRefused) {
  v1::MissionOptions options;
  EXPECT_TRUE(absl::IsInvalidArgument(SetOption(options, "pose_limit_m", "far")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetOption(options, "seed", "1.5")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetOption(options, "max_robot_count", "3000000000")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetOption(options, "planning.grid_guard", "yes")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetOption(options, "planning.cost", "free")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetOption(options, "planning.cost", "unspecified")));
}

TEST(OptionPathTest, EnumsAreWrittenInFullWithoutTheirPrefix) {
  v1::MissionOptions options;
  // Ends of values, which are no values.
  EXPECT_TRUE(absl::IsInvalidArgument(SetOption(options, "planning.paths", "star")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetOption(options, "planning.selection_rule", "ucb")));
  EXPECT_TRUE(absl::IsInvalidArgument(SetOption(options, "planning.paths", "RRT")));
  EXPECT_TRUE(SetOption(options, "planning.paths", "xit").ok());
  EXPECT_EQ(options.planning().paths(), v1::PATH_KIND_XIT);
  EXPECT_EQ(EnumText(*v1::PathKind_descriptor()->FindValueByNumber(v1::PATH_KIND_ANYTIME_XIT)),
            "anytime_xit");
  EXPECT_EQ(EnumText(*v1::PathKind_descriptor()->FindValueByNumber(0)), "");
  EXPECT_EQ(SetOption(options, "planning.cost", "free").message(),
            "= free must be one of ucb, euclidean, vertices");
}

TEST(OptionPathTest, MapsOfTheBuildingAreNoOptions) {
  v1::MissionOptions options;
  for (const char* path :
       {"prior_map.files.yaml", "prior_map.files.pgm", "prior_map.cells.deflated_data",
        "prior_map.cells.geometry.column_count"}) {
    EXPECT_TRUE(absl::IsNotFound(SetOption(options, path, "1"))) << path;
  }
}

}  // namespace option_path_test
}  // namespace plumescout::server
