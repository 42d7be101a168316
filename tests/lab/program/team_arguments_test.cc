// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/team_arguments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace plumescout::lab {
namespace team_arguments_test {

using ::testing::HasSubstr;

std::string Refusal(const TeamArguments& arguments, int robots = 3) {
  const absl::Status status = MakeTraits(arguments, robots).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  return std::string(status.message());
}

TEST(TeamArguments, ListsBeginAgain) {
  TeamArguments arguments;
  arguments.speeds_mps = {1.0, 0.5};
  arguments.clock_offsets_s = {-3600.0};
  const auto traits = MakeTraits(arguments, 3);
  ASSERT_TRUE(traits.ok()) << traits.status();
  ASSERT_EQ(traits->size(), 3u);
  EXPECT_EQ((*traits)[0].top_speed_mps, 1.0);
  EXPECT_EQ((*traits)[1].top_speed_mps, 0.5);
  EXPECT_EQ((*traits)[2].top_speed_mps, 1.0);
  EXPECT_EQ((*traits)[2].clock, (ClockErrorOptions{-3600.0, 0.0}));
  EXPECT_TRUE(HasWrongClocks(arguments));
  arguments.clock_offsets_s = {0.0, 0.0};
  EXPECT_FALSE(HasWrongClocks(arguments));
  arguments.clock_drifts_ppm = {0.0, 20.0};
  EXPECT_TRUE(HasWrongClocks(arguments));
}

TEST(TeamArguments, NothingIsSetUnlessAskedFor) {
  const auto traits = MakeTraits({}, 2);
  ASSERT_TRUE(traits.ok()) << traits.status();
  EXPECT_EQ((*traits)[1].top_speed_mps, std::nullopt);
  EXPECT_EQ((*traits)[1].clock, ClockErrorOptions{});
  EXPECT_TRUE((*traits)[1].outages.empty());
  EXPECT_EQ((*traits)[1].jump, std::nullopt);
}

TEST(TeamArguments, OutagesAreOfOneRobotAndComeInOrder) {
  TeamArguments arguments;
  arguments.dropouts = {"2:100:20", "3:7"};
  arguments.link_losses = {"2:60:20"};
  arguments.leaves = {"1:30:5"};
  const auto traits = MakeTraits(arguments, 3);
  ASSERT_TRUE(traits.ok()) << traits.status();
  EXPECT_EQ((*traits)[0].outages, (std::vector<Outage>{{OutageKind::kLeaves, 30.0, 5.0}}));
  EXPECT_EQ((*traits)[1].outages, (std::vector<Outage>{{OutageKind::kLinkLost, 60.0, 20.0},
                                                       {OutageKind::kSilent, 100.0, 20.0}}));
  EXPECT_EQ((*traits)[2].outages, (std::vector<Outage>{{OutageKind::kSilent, 7.0, std::nullopt}}));
}

TEST(TeamArguments, JumpsAreInMetresAndDegrees) {
  TeamArguments arguments;
  arguments.pose_jumps = {"1:60:2:20:45", "2:10:-0.5:0"};
  const auto traits = MakeTraits(arguments, 2);
  ASSERT_TRUE(traits.ok()) << traits.status();
  ASSERT_TRUE((*traits)[0].jump.has_value());
  EXPECT_EQ((*traits)[0].jump->at_s, 60.0);
  EXPECT_EQ((*traits)[0].jump->east_m, 2.0);
  EXPECT_NEAR((*traits)[0].jump->turn_rad, M_PI / 9.0, 1e-12);
  EXPECT_EQ((*traits)[0].jump->corrected_after_s, 45.0);
  EXPECT_EQ((*traits)[1].jump->east_m, -0.5);
  EXPECT_EQ((*traits)[1].jump->corrected_after_s, std::nullopt);
}

TEST(TeamArguments, NamesWhatIsWrong) {
  TeamArguments arguments;
  arguments.speeds_mps = {1.0, 1.0, 1.0, 1.0};
  EXPECT_THAT(Refusal(arguments), HasSubstr("--speeds has 4 values for --robots 3"));
  const auto dropout = [](const char* text) {
    TeamArguments wrong;
    wrong.dropouts = {text};
    return Refusal(wrong);
  };
  EXPECT_THAT(dropout("4:10"), HasSubstr("--dropout 4:10 is of robot 4, of 3"));
  EXPECT_THAT(dropout("0:10"), HasSubstr("is of robot 0, of 3"));
  EXPECT_THAT(dropout("1"), HasSubstr("must be WHO:AT[:FOR]"));
  EXPECT_THAT(dropout("1:soon"), HasSubstr("must be WHO:AT[:FOR]"));
  EXPECT_THAT(dropout("1:nan"), HasSubstr("must be WHO:AT[:FOR]"));
  EXPECT_THAT(dropout("1:2:3:4"), HasSubstr("must be WHO:AT[:FOR]"));
  EXPECT_THAT(dropout("1:-5"), HasSubstr("outage.at_s = -5"));
  arguments = {};
  arguments.link_losses = {"1:60"};
  EXPECT_THAT(Refusal(arguments), HasSubstr("--link-loss 1:60 must be WHO:AT:FOR"));
  arguments = {};
  arguments.dropouts = {"2:10:20"};
  arguments.leaves = {"2:15"};
  EXPECT_THAT(Refusal(arguments), HasSubstr("of robot 2: outage.at_s = 15"));
  arguments = {};
  arguments.pose_jumps = {"1:10:500:0"};
  EXPECT_THAT(Refusal(arguments), HasSubstr("pose_error.jump.east_m = 500"));
  arguments.pose_jumps = {"1:10:1:0", "1:20:1:0"};
  EXPECT_THAT(Refusal(arguments), HasSubstr("second jump"));
}

TEST(TeamArguments, AreReadFromTheCommandLine) {
  CLI::App app;
  app.option_defaults()->always_capture_default();
  TeamArguments arguments;
  AddTeamOptions(app, arguments);
  app.parse("--speeds 1.25,0.5 --clock-offset=-3600,0 --dropout 1:5 --dropout 2:6:7");
  EXPECT_EQ(arguments.speeds_mps, (std::vector<double>{1.25, 0.5}));
  EXPECT_EQ(arguments.clock_offsets_s, (std::vector<double>{-3600.0, 0.0}));
  EXPECT_EQ(arguments.dropouts, (std::vector<std::string>{"1:5", "2:6:7"}));
  EXPECT_THROW(app.parse("--speeds 1,-1"), CLI::ValidationError);
}

}  // namespace team_arguments_test
}  // namespace plumescout::lab
