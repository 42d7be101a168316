// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/frontier_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plumescout::lab {
namespace frontier_world_test {

const FrontierWorld& World() {
  static const FrontierWorld world = MakeFrontierWorld();
  return world;
}

TEST(FrontierWorld, GasIsSteady) {
  const Grid<float>& gas_ppm = World().gas_ppm;
  const GridGeometry& geometry = gas_ppm.geometry();
  const Cell leak = geometry.CellAt(World().source);
  int checked = 0;
  for (std::size_t i = 0; i < gas_ppm.size(); ++i) {
    const Cell cell = geometry.CellAtIndex(i);
    if (World().occupancy[i] != CellState::kFree || cell == leak || gas_ppm[i] == 0.0F) continue;
    double sum_ppm = 0.0;
    int neighbours = 0;
    for (const Cell next : {Cell{cell.x + 1, cell.y}, Cell{cell.x - 1, cell.y},
                            Cell{cell.x, cell.y + 1}, Cell{cell.x, cell.y - 1}}) {
      if (World().occupancy.At(next, CellState::kOccupied) != CellState::kFree) continue;
      sum_ppm += static_cast<double>(gas_ppm[next]);
      ++neighbours;
    }
    EXPECT_NEAR(gas_ppm[i], sum_ppm / neighbours, 1e-3);
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

TEST(FrontierWorld, TheLeakIsTheMostAndWallsHoldNone) {
  const Grid<float>& gas_ppm = World().gas_ppm;
  const float leak_ppm = gas_ppm[gas_ppm.geometry().CellAt(World().source)];
  for (std::size_t i = 0; i < gas_ppm.size(); ++i) {
    EXPECT_LE(gas_ppm[i], leak_ppm);
    if (World().occupancy[i] == CellState::kOccupied) {
      EXPECT_EQ(gas_ppm[i], 0.0F);
    }
  }
}

// The caption of [XIT] Fig. 5.
TEST(FrontierWorld, TheStoryOfTheFigureHappensWhateverTheNoise) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto walk = WalkFrontiers(World(), WgfdScope::kReachable, seed);
    ASSERT_TRUE(walk.ok()) << walk.status();
    ASSERT_EQ(walk->steps.size(), 3u);
    const auto mean_ppm = [&](std::size_t i) {
      const FrontierStep& step = walk->steps[i];
      return step.map.gas_mean_ppm[step.map.occupancy.geometry().CellAt(step.robot.position())];
    };
    EXPECT_EQ(GasFrontiers(walk->steps[0].map).size(), 2u);  // (a)
    EXPECT_GE(mean_ppm(0), walk->steps[0].map.gas_threshold_ppm);
    EXPECT_EQ(GasFrontiers(walk->steps[1].map).size(), 1u);  // (b)
    EXPECT_LT(mean_ppm(1), walk->steps[1].map.gas_threshold_ppm);
    EXPECT_GE(GasFrontiers(walk->steps[2].map).size(), 1u);  // (c)
    EXPECT_GT(mean_ppm(2), 1.5F * mean_ppm(0));
    for (const FrontierStep& step : walk->steps) {
      ASSERT_GE(step.plan.chosen, 0);
      EXPECT_EQ(step.plan.candidates[static_cast<std::size_t>(step.plan.chosen)].goal.kind,
                GoalKind::kGasFrontier);
    }
  }
}

TEST(FrontierWorld, Algorithm2ForgetsTheOtherFrontier) {
  const auto walk = WalkFrontiers(World(), WgfdScope::kLocal, 1);
  ASSERT_TRUE(walk.ok()) << walk.status();
  EXPECT_EQ(GasFrontiers(walk->steps[0].map).size(), 2u);
  EXPECT_TRUE(GasFrontiers(walk->steps[1].map).empty());
}

TEST(FrontierWorld, CellsAreWhatTheDefinitionsSay) {
  const FrontierWalk walk = *WalkFrontiers(World(), WgfdScope::kReachable, 1);
  const FrontierStep& step = walk.steps.front();
  const Grid<GasMark> cells = ClassifyGas(step);
  const GridGeometry& geometry = cells.geometry();
  for (const Frontier* frontier : GasFrontiers(step.map)) {
    for (const Cell cell : frontier->cells) {
      EXPECT_EQ(cells[cell], GasMark::kUnobserved);  // Eq. (20): unobserved, beside a critical one
      bool beside = false;
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          beside |= cells.At({cell.x + dx, cell.y + dy}, GasMark::kUnknown) == GasMark::kCritical;
        }
      }
      EXPECT_TRUE(beside);
    }
  }
  EXPECT_EQ(cells[geometry.CellAt(step.robot.position())], GasMark::kCritical);
  EXPECT_EQ(cells[Cell{geometry.CellAt(World().entry.front())}], GasMark::kObserved);
  EXPECT_GT(std::count(cells.values().begin(), cells.values().end(), GasMark::kWall), 20);
}

TEST(FrontierWorld, RepeatsFromItsSeed) {
  const auto readings = [](std::uint64_t seed) {
    std::vector<double> values;
    const FrontierWalk walk = *WalkFrontiers(World(), WgfdScope::kReachable, seed);
    for (const FrontierReading& reading : walk.readings) values.push_back(reading.reading_ppm);
    return values;
  };
  EXPECT_EQ(readings(3), readings(3));
  EXPECT_NE(readings(3), readings(4));
}

}  // namespace frontier_world_test
}  // namespace plumescout::lab
