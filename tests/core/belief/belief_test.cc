// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/belief.h"

#include <cmath>
#include <memory>

#include "gtest/gtest.h"

namespace plumescout {
namespace belief_test {

Goal At(double x_m, double y_m, GoalKind kind = GoalKind::kGasFrontier) {
  return {kind, {}, {x_m, y_m}, {x_m, y_m}, 5};
}

TEST(ClaimCovers, GoalsOfTheSameKindNearby) {
  EXPECT_TRUE(ClaimCovers(At(1.0, 1.0), At(1.3, 1.3)));
  EXPECT_FALSE(ClaimCovers(At(1.0, 1.0), At(1.5, 1.0)));
  EXPECT_FALSE(ClaimCovers(At(1.0, 1.0), At(1.0, 1.0, GoalKind::kOccupancyFrontier)));
}

TEST(SamePlace, IsNearerThanAClaim) {
  EXPECT_TRUE(SamePlace(At(1.0, 1.0), At(1.1, 1.1)));
  EXPECT_FALSE(SamePlace(At(1.0, 1.0), At(1.2, 1.0)));
  EXPECT_FALSE(SamePlace(At(1.0, 1.0), At(1.0, 1.0, GoalKind::kOccupancyFrontier)));
}

// A free corridor, 20 x 6 cells, whose right half is unknown; gas fills its left end.
Belief Corridor() {
  const GridGeometry geometry{0.0, 0.0, 0.1, 20, 6};
  auto occupancy = std::make_shared<Grid<CellState>>(geometry, CellState::kUnknown);
  auto traversable = std::make_shared<Grid<std::uint8_t>>(geometry, std::uint8_t{0});
  auto mean = std::make_shared<Grid<float>>(geometry, NAN);
  auto variance = std::make_shared<Grid<float>>(geometry, NAN);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 10; ++x) {
      const Cell cell{x, y};
      (*occupancy)[cell] = CellState::kFree;
      (*traversable)[cell] = 1;
      (*mean)[cell] = x < 4 ? 50.0f : 0.0f;
      (*variance)[cell] = x < 3 ? 0.01f : 5.0f;
    }
  }
  Belief belief;
  belief.revision = 9;
  belief.options = std::make_shared<MissionOptions>();
  belief.occupancy = occupancy;
  belief.traversable = traversable;
  belief.gas_mean_ppm = mean;
  belief.gas_variance_ppm2 = variance;
  RobotRecord& robot = belief.robots["a"];
  robot.state.id = "a";
  robot.state.has_pose = true;
  robot.state.pose = {0.25, 0.25, 0.0};
  return belief;
}

TEST(MakeMapSnapshot, FindsBothKindsOfFrontiersFromTheRobots) {
  const MapSnapshot map = MakeMapSnapshot(Corridor());
  EXPECT_EQ(map.revision, 9);
  EXPECT_DOUBLE_EQ(map.gas_threshold_ppm, 50.0);
  ASSERT_EQ(map.robots.size(), 1u);
  ASSERT_FALSE(map.frontiers.empty());
  const Frontier& occupancy = map.frontiers.front();
  EXPECT_EQ(occupancy.kind, FrontierKind::kOccupancy);
  for (const Cell& cell : occupancy.cells) EXPECT_EQ(cell.x, 10);
  const Frontier& gas = map.frontiers.back();
  EXPECT_EQ(gas.kind, FrontierKind::kGas);
  for (const Cell& cell : gas.cells) EXPECT_EQ(cell.x, 3);
}

TEST(MakeMapSnapshot, OfAnEmptyMapHasNoFrontiers) {
  Belief belief = Corridor();
  belief.occupancy = std::make_shared<Grid<CellState>>();
  belief.traversable = std::make_shared<Grid<std::uint8_t>>();
  belief.gas_mean_ppm = std::make_shared<Grid<float>>();
  belief.gas_variance_ppm2 = std::make_shared<Grid<float>>();
  EXPECT_TRUE(MakeMapSnapshot(belief).frontiers.empty());
}

}  // namespace belief_test
}  // namespace plumescout
