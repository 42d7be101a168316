// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/robot_arguments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace robot_arguments_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(RobotArguments, LatenessIsOfRobotsThatArePlaced) {
  RobotArguments arguments;
  arguments.most_late_s = 1.0;
  const auto planned = PlanEpisode(arguments, SmallWorld());
  ASSERT_TRUE(planned.ok()) << planned.status();
  EXPECT_EQ(planned->options.simulated.pace.most_late_s, 1.0);
  arguments.following = client::Following::kProportional;
  const absl::Status refused = PlanEpisode(arguments, SmallWorld()).status();
  EXPECT_TRUE(absl::IsInvalidArgument(refused));
  EXPECT_THAT(std::string(refused.message()),
              AllOf(HasSubstr("--late 1"), HasSubstr("--following")));
  arguments.most_late_s = 0.0;
  EXPECT_TRUE(PlanEpisode(arguments, SmallWorld()).ok());
}

TEST(RobotArguments, WrongClocksAreOfThoseWhoCanFindOut) {
  RobotArguments arguments;
  arguments.team.clock_offsets_s = {5.0};
  EXPECT_THAT(std::string(PlanEpisode(arguments, SmallWorld()).status().message()),
              HasSubstr("--clock-offset"));
  arguments.realtime = true;
  EXPECT_TRUE(PlanEpisode(arguments, SmallWorld()).ok());
}

TEST(RobotArguments, AMissionMayBeForSomething) {
  RobotArguments arguments;
  arguments.objective.kind = ObjectiveKind::kConfirmClean;
  EXPECT_THAT(std::string(PlanEpisode(arguments, SmallWorld()).status().message()),
              HasSubstr("threshold_ppm"));
  arguments.objective.threshold_ppm = 10.0;
  const auto planned = PlanEpisode(arguments, SmallWorld());
  ASSERT_TRUE(planned.ok()) << planned.status();
  EXPECT_EQ(planned->options.create->objective.kind, ObjectiveKind::kConfirmClean);
  EXPECT_EQ(planned->options.create->objective.threshold_ppm, 10.0);
}

}  // namespace robot_arguments_test
}  // namespace plumescout::lab
