// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/convert/status.h"

namespace plumescout {
namespace names_test {

using ::testing::ElementsAre;
using ::testing::Field;

TEST(NamesTest, NamesSurviveTheRoundTrip) {
  const RobotName robot{"hall-3", "r1"};
  const PlanName plan{"hall-3", 42};
  EXPECT_EQ(ParseMissionName("name", MissionResource("hall-3")).value(), "hall-3");
  EXPECT_EQ(ParseRobotName("robot", RobotResource(robot)).value(), robot);
  EXPECT_EQ(ParsePlanName("plan", PlanResource(plan)).value(), plan);
}

class BadNameTest : public testing::TestWithParam<const char*> {};

TEST_P(BadNameTest, IsRefusedByTheFieldThatHoldsIt) {
  for (const absl::Status& status :
       {ParseMissionName("f", GetParam()).status(), ParseRobotName("f", GetParam()).status(),
        ParsePlanName("f", GetParam()).status()}) {
    EXPECT_TRUE(absl::IsInvalidArgument(status));
    EXPECT_THAT(FieldViolations(status), ElementsAre(Field(&FieldViolation::field, "f")));
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadNameTest,
                         testing::Values("", "/", "missions", "missions/", "missions/A", "m/hall",
                                         "missions/../robots/r1", "missions/hall/robots/",
                                         "missions//robots/r1", "missions/hall/robots/r1/",
                                         "missions/hall/plans/0", "missions/hall/plans/-1",
                                         "missions/hall/plans/01", "missions/hall/plans/+1",
                                         "missions/hall/plans/9223372036854775808",
                                         "missions/hall/plans/1 "));

TEST(NamesTest, KindsAreNotMixed) {
  EXPECT_FALSE(ParseRobotName("f", "missions/hall/plans/1").ok());
  EXPECT_FALSE(ParsePlanName("f", "missions/hall/robots/r1").ok());
  EXPECT_FALSE(ParseMissionName("f", "missions/hall/robots/r1").ok());
}

}  // namespace names_test
}  // namespace plumescout
