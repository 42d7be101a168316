// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/quarter_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/grid/flood.h"

namespace plumescout::lab {
namespace quarter_plan_test {

constexpr std::uint64_t kSeeds = 40;

Grid<std::uint8_t> FreeCells(const QuarterPlan& plan) {
  Grid<std::uint8_t> free(plan.occupancy.geometry());
  for (std::size_t i = 0; i < free.size(); ++i) {
    free[i] = plan.occupancy[i] == CellState::kFree ? 1 : 0;
  }
  return free;
}

std::ptrdiff_t Count(const Grid<std::uint8_t>& mask) {
  return std::count(mask.values().begin(), mask.values().end(), 1);
}

TEST(QuarterPlanTest, HasTheSizeOfThePapersMap) {
  const QuarterPlan plan = MakeQuarterPlan(1);
  EXPECT_EQ(plan.occupancy.width(), 68);
  EXPECT_EQ(plan.occupancy.height(), 74);
  EXPECT_EQ(plan.occupancy.geometry().resolution_m, 13.0);
}

TEST(QuarterPlanTest, LeavesFourToFiveThousandCellsFree) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto free = Count(FreeCells(MakeQuarterPlan(seed)));
    EXPECT_TRUE(free >= 4000 && free <= 4800) << "seed " << seed << ": " << free;
  }
}

TEST(QuarterPlanTest, EveryStreetLeadsToEveryOther) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Grid<std::uint8_t> free = FreeCells(MakeQuarterPlan(seed));
    EXPECT_EQ(Count(ReachableCells(free, {{0, 0}}, Connectivity::kFour)), Count(free));
  }
}

TEST(QuarterPlanTest, TheLandAroundIsOpen) {
  const QuarterPlan plan = MakeQuarterPlan(5);
  for (std::size_t i = 0; i < plan.occupancy.size(); ++i) {
    if (plan.occupancy[i] == CellState::kFree) continue;
    const Cell cell = plan.occupancy.geometry().CellAtIndex(i);
    EXPECT_TRUE(cell.x >= 10 && cell.x < 58 && cell.y >= 8 && cell.y < 66);
  }
}

TEST(QuarterPlanTest, AboutHalfOfTheBuiltUpAreaIsHouses) {
  const QuarterPlan plan = MakeQuarterPlan(5);
  int inside = 0;
  int houses = 0;
  for (std::size_t i = 0; i < plan.occupancy.size(); ++i) {
    const GridGeometry& geometry = plan.occupancy.geometry();
    if (!plan.built_up.Holds(geometry.Center(geometry.CellAtIndex(i)))) continue;
    ++inside;
    houses += plan.occupancy[i] == CellState::kOccupied ? 1 : 0;
  }
  EXPECT_GT(houses, 0.3 * inside);
  EXPECT_LT(houses, 0.6 * inside);
}

TEST(QuarterPlanTest, TheSeedDecides) {
  EXPECT_EQ(MakeQuarterPlan(2).occupancy, MakeQuarterPlan(2).occupancy);
  EXPECT_NE(MakeQuarterPlan(2).occupancy, MakeQuarterPlan(3).occupancy);
}

}  // namespace quarter_plan_test
}  // namespace plumescout::lab
