// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/grid_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/grid/grid_search.h"
#include "tests/support/plan_map.h"

namespace plumescout::lab {
namespace grid_oracle_test {

InformationMap UniformInformation(const Grid<std::uint8_t>& open) {
  Rng rng(1);
  InformationMap information = testing::WavyInformation(open, rng);
  for (float& penalty : information.penalty.values()) {
    if (std::isfinite(penalty)) penalty = 1.0F;
  }
  return information;
}

TEST(OracleCosts, OfLengthAreTheTravelDistancesOfTheGrid) {
  Rng rng(2);
  const Grid<std::uint8_t> open = testing::RandomObstacles(40, 30, 20, rng);
  const InformationMap information = UniformInformation(open);
  const Cell start = testing::RandomOpenCell(open, rng);
  const Grid<double> costs =
      OracleCosts(EdgeCost(information, CostKind::kEuclidean, 1.0), start, 8);
  const Grid<double> travel_m = TravelDistances_m(open, std::vector<Cell>{start});
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (travel_m[i] == kUnreached_m) {
      EXPECT_FALSE(std::isfinite(costs[i]));
    } else {
      EXPECT_NEAR(costs[i], travel_m[i], 1e-5);  // distances are kept in single precision
    }
  }
}

TEST(OracleCosts, FallWithMoreDirections) {
  const Grid<std::uint8_t> open(GridGeometry{0.0, 0.0, 0.1, 20, 20}, 1);
  const InformationMap information = UniformInformation(open);
  const EdgeCost cost(information, CostKind::kUcb, 0.0);
  // To (6, 2): 4 straight and 2 diagonal steps; two knight's moves and two straight; straight.
  EXPECT_NEAR((OracleCosts(cost, {0, 0}, 8)[Cell{6, 2}]), 4.0 + 2.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR((OracleCosts(cost, {0, 0}, 16)[Cell{6, 2}]), 2.0 + 2.0 * std::sqrt(5.0), 1e-9);
  EXPECT_NEAR((OracleCosts(cost, {0, 0}, 32)[Cell{6, 2}]), 2.0 * std::sqrt(10.0), 1e-9);
}

}  // namespace grid_oracle_test
}  // namespace plumescout::lab
