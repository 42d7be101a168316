// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/expected_information.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/gas/gas_map.h"
#include "core/types/rng.h"

namespace plumescout {
namespace expected_information_test {

using ::testing::ElementsAre;
using ::testing::SizeIs;

const GridGeometry kLattice{0.0, 0.0, 0.1, 40, 30};

PlanningOptions Reading(double rate_hz, double speed_mps, double dwell_s = 0.0) {
  PlanningOptions options;
  options.reading_rate_hz = rate_hz;
  options.speed_mps = speed_mps;
  options.dwell_s = dwell_s;
  return options;
}

TEST(ReadingCells, FollowEachOtherAtTheSpacingOfSpeedAndRate) {
  // Every 0.5 m along one metre east, then half a metre north.
  EXPECT_THAT(ReadingCells({{0.05, 0.05}, {1.05, 0.05}, {1.05, 0.62}}, kLattice, Reading(2.0, 1.0)),
              ElementsAre(Cell{5, 0}, Cell{10, 0}, Cell{10, 5}));
}

TEST(ReadingCells, AreTakenAtVerticesWhileTheRobotStands) {
  EXPECT_THAT(
      ReadingCells({{0.05, 0.05}, {0.25, 0.05}, {0.25, 0.25}}, kLattice, Reading(1.0, 1.0, 2.0)),
      ElementsAre(Cell{2, 0}, Cell{2, 0}, Cell{2, 2}, Cell{2, 2}));
}

TEST(ReadingCells, OfNoWayAreNone) {
  EXPECT_THAT(ReadingCells({}, kLattice, Reading(2.0, 1.0)), SizeIs(0));
  EXPECT_THAT(ReadingCells({{1.0, 1.0}}, kLattice, Reading(2.0, 1.0, 5.0)), SizeIs(0));
}

TEST(ReadingCells, AreThinnedEvenlyBeyondABound) {
  const std::vector<Cell> cells =
      ReadingCells({{0.05, 0.05}, {3.95, 0.05}}, kLattice, Reading(1000.0, 1.0, 3600.0));
  EXPECT_LE(cells.size(), kMaxReadings);
  EXPECT_GT(cells.size(), kMaxReadings - 3);
}

Grid<CellState> RandomStates(Rng& rng) {
  constexpr double kBlockedShare = 0.2;
  Grid<CellState> states(GridGeometry{-1.0, 2.0, 0.1, 24, 18}, CellState::kFree);
  for (CellState& state : states.values()) {
    if (rng.Uniform(0.0, 1.0) < kBlockedShare) state = CellState::kOccupied;
  }
  return states;
}

// A map with gas, and the belief that a mission would make of it.
struct World {
  explicit World(std::uint64_t seed) : rng(seed), states(RandomStates(rng)) {
    for (int k = 0; k < 20; ++k) Read(FreeCell(), rng.Uniform(0.0, 30.0));
    EXPECT_TRUE(gas.Refresh(states, 0).ok());
  }

  Cell FreeCell() {
    while (true) {
      const Cell cell = states.geometry().CellAtIndex(rng.Below(states.size()));
      if (states[cell] == CellState::kFree) return cell;
    }
  }
  void Read(Cell cell, double concentration_ppm) {
    gas.Add(0, states.geometry().Center(cell), {concentration_ppm, {}});
  }
  Belief MakeBelief() const {
    Belief belief;
    belief.options = std::make_shared<const MissionOptions>();
    belief.occupancy = std::make_shared<const Grid<CellState>>(states);
    belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm());
    belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2());
    belief.gas_what_if = gas.what_if();
    return belief;
  }

  Rng rng;
  Grid<CellState> states;
  GasMap gas{GasOptions()};
};

// The formula of core/plan/cost/relevance.h, in double precision, for the default thresholds.
double RelevanceOf(double gas_ppm, double greatest_ppm) {
  const double sure_ppm = 2.0 * FrontierOptions().min_gas_threshold_ppm;
  const double gas = std::max(0.0, gas_ppm);
  return 0.05 + 0.95 * std::pow(std::min(1.0, gas / sure_ppm), 2) +
         0.5 * gas / std::max(sure_ppm, greatest_ppm);
}

// The entropy that was lost between two fields, [XIT] Eq. (24) cell by cell, weighted by relevance.
double LostEntropy(const Grid<float>& mean_ppm, const Grid<float>& before,
                   const Grid<float>& after) {
  double greatest_ppm = 0.0;
  for (const float mean : mean_ppm.values()) {
    if (std::isfinite(mean)) greatest_ppm = std::max(greatest_ppm, static_cast<double>(mean));
  }
  constexpr double kTwoPiE = 17.079468445347132;
  const auto entropy = [](float variance) { return 0.5 * std::log(kTwoPiE * variance); };
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!std::isfinite(before[i])) continue;
    sum += RelevanceOf(static_cast<double>(mean_ppm[i]), greatest_ppm) *
           (entropy(before[i]) - entropy(after[i]));
  }
  return sum;
}

TEST(ExpectedInformation, IsWhatReallyTakingTheReadingsBrings) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    World world(seed);
    const Belief belief = world.MakeBelief();
    std::vector<Cell> cells;
    for (int k = 0; k < 12; ++k) cells.push_back(world.FreeCell());
    cells.push_back(cells.front());  // read twice
    const auto expected = ExpectedInformation(belief).Of(cells);
    ASSERT_TRUE(expected.has_value());

    for (const Cell cell : cells) world.Read(cell, world.rng.Uniform(0.0, 30.0));
    ASSERT_TRUE(world.gas.Refresh(world.states, 0).ok());
    const double lost =
        LostEntropy(*belief.gas_mean_ppm, *belief.gas_variance_ppm2, world.gas.variance_ppm2());
    // 432 variances in single precision, each the share of the engine's tolerance off.
    EXPECT_NEAR(*expected, lost, 2e-3) << "seed " << seed;
    EXPECT_GT(*expected, 1.0);
  }
}

TEST(ExpectedInformation, FindsTheFieldAgainOnAMapThatHasGrown) {
  World world(3);
  const Belief belief = world.MakeBelief();
  const std::vector<Cell> cells = {world.FreeCell(), world.FreeCell()};
  const auto expected = ExpectedInformation(belief).Of(cells);

  constexpr int kGrowth = 5;
  const GridGeometry& old = belief.geometry();
  const GridGeometry grown{old.origin_x_m - kGrowth * old.resolution_m,
                           old.origin_y_m - kGrowth * old.resolution_m, old.resolution_m,
                           old.width + kGrowth, old.height + kGrowth};
  const auto moved = [&]<typename T>(const Grid<T>& grid, T fill) {
    auto result = std::make_shared<Grid<T>>(grown, fill);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const Cell cell = old.CellAtIndex(i);
      (*result)[Cell{cell.x + kGrowth, cell.y + kGrowth}] = grid[i];
    }
    return result;
  };
  Belief larger = belief;
  larger.occupancy = moved(*belief.occupancy, CellState::kUnknown);
  larger.gas_mean_ppm = moved(*belief.gas_mean_ppm, std::numeric_limits<float>::quiet_NaN());
  larger.gas_variance_ppm2 =
      moved(*belief.gas_variance_ppm2, std::numeric_limits<float>::quiet_NaN());
  std::vector<Cell> shifted;
  for (const Cell cell : cells) shifted.push_back({cell.x + kGrowth, cell.y + kGrowth});
  EXPECT_EQ(ExpectedInformation(larger).Of(shifted), expected);
}

TEST(ExpectedInformation, OfNoReadingsIsNothing) {
  World world(2);
  const Belief belief = world.MakeBelief();
  EXPECT_EQ(ExpectedInformation(belief).Of({}), 0.0);
  EXPECT_EQ(ExpectedInformation(belief).Of({{-5, 2}, {1000, 1000}}), 0.0) << "off the map";
}

TEST(ExpectedInformation, IsUnknownBeforeThereIsAField) {
  World world(2);
  Belief belief = world.MakeBelief();
  belief.gas_what_if = nullptr;
  EXPECT_EQ(ExpectedInformation(belief).Of({{1, 1}}), std::nullopt);
  EXPECT_EQ(ExpectedInformation(belief).AtMost({{1, 1}}), std::nullopt);
}

}  // namespace expected_information_test
}  // namespace plumescout
