// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/random_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/grid/flood.h"

namespace plumescout::lab {
namespace random_world_test {

class RandomWorldTest : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  RandomWorld world_ = MakeRandomWorld(GetParam(), 5);
  const Belief& belief_ = world_.belief;
};

TEST_P(RandomWorldTest, HasGoalsThatTheRobotCanReach) {
  const Point2 at = belief_.robots.at(world_.robot).state.pose.position();
  const Grid<std::uint8_t> reachable =
      ReachableCells(*belief_.traversable, {belief_.geometry().CellAt(at)});
  std::set<Cell> cells;
  for (const Goal& goal : world_.goals) {
    EXPECT_NE(reachable[goal.cell], 0);
    EXPECT_EQ(goal.position, belief_.geometry().Center(goal.cell));
    cells.insert(goal.cell);
  }
  EXPECT_EQ(cells.size(), 5U);
}

TEST_P(RandomWorldTest, IsPartlyKnownAndHasGasWhereItIsFree) {
  const auto& states = belief_.occupancy->values();
  EXPECT_GT(std::count(states.begin(), states.end(), CellState::kUnknown), 1000);
  EXPECT_GE(std::count(states.begin(), states.end(), CellState::kFree), 8000);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const bool is_free = states[i] == CellState::kFree;
    EXPECT_EQ(std::isfinite((*belief_.gas_mean_ppm)[i]), is_free);
    EXPECT_EQ(std::isfinite((*belief_.gas_variance_ppm2)[i]), is_free);
    EXPECT_LE((*belief_.traversable)[i], is_free ? 1 : 0);
  }
}

TEST_P(RandomWorldTest, IsTheSameForTheSameSeed) {
  const RandomWorld again = MakeRandomWorld(GetParam(), 5);
  EXPECT_EQ(*again.belief.occupancy, *belief_.occupancy);
  EXPECT_EQ(again.goals, world_.goals);
  EXPECT_NE(*MakeRandomWorld(GetParam() + 1000, 5).belief.occupancy, *belief_.occupancy);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomWorldTest, ::testing::Values(1, 2, 3));

}  // namespace random_world_test
}  // namespace plumescout::lab
