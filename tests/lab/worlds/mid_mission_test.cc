// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/mid_mission.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumescout::lab {
namespace mid_mission_test {

TEST(RunToMidMission, HasAMomentForEachPlanOfTheLaterHalf) {
  const auto moments =
      RunToMidMission({.width_cells = 80, .height_cells = 100, .robots = 2, .rounds = 4});
  ASSERT_TRUE(moments.ok()) << moments.status();
  ASSERT_EQ(moments->size(), 4U);
  EXPECT_EQ((*moments)[0].robot, "a");
  EXPECT_EQ((*moments)[1].robot, "b");
  for (const PlanMoment& moment : *moments) {
    EXPECT_NE(moment.belief->gas_what_if, nullptr);
    EXPECT_GT(moment.belief->gas_counters.readings, 0);
    const auto& states = moment.belief->occupancy->values();
    EXPECT_GT(std::count(states.begin(), states.end(), CellState::kFree), 2000)
        << "of the 4000 cells of the half that is known from the start";
  }
}

TEST(RunToMidMission, IsTheSameForTheSameSeed) {
  const MidMissionOptions options{.width_cells = 80, .height_cells = 80, .rounds = 2, .seed = 3};
  const auto first = RunToMidMission(options);
  const auto second = RunToMidMission(options);
  ASSERT_TRUE(first.ok() && second.ok());
  ASSERT_EQ(first->size(), 1U);
  EXPECT_EQ(first->back().belief->revision, second->back().belief->revision);
  EXPECT_EQ(first->back().belief->robots.at("a").state.pose.x_m,
            second->back().belief->robots.at("a").state.pose.x_m);
}

}  // namespace mid_mission_test
}  // namespace plumescout::lab
