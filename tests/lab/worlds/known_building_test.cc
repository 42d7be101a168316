// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/known_building.h"

#include <gtest/gtest.h>

#include "core/grid/flood.h"
#include "tests/support/same_bytes.h"

namespace plumescout::lab {
namespace known_building_test {

TEST(KnownBuilding, HasGoalsThatItsRobotCanReach) {
  const auto world = MakeKnownBuilding(160, 200, 3, 5);
  ASSERT_TRUE(world.ok()) << world.status();
  const Belief& belief = world->belief;
  const Cell start = belief.geometry().CellAt(belief.robots.at(world->robot).state.pose.position());
  const Grid<std::uint8_t> reachable = ReachableCells(*belief.traversable, {start});
  EXPECT_EQ(world->goals.size(), 5u);
  for (const Goal& goal : world->goals) EXPECT_EQ(reachable[goal.cell], 1);
  EXPECT_NE(belief.gas_what_if, nullptr);
}

TEST(KnownBuilding, IsTheSameForTheSameSeed) {
  const auto first = MakeKnownBuilding(80, 60, 3, 2);
  const auto second = MakeKnownBuilding(80, 60, 3, 2);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_TRUE(support::SameBytes(*first->belief.gas_mean_ppm, *second->belief.gas_mean_ppm));
  EXPECT_EQ(first->goals, second->goals);
}

}  // namespace known_building_test
}  // namespace plumescout::lab
