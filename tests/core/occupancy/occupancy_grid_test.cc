// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/occupancy_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/types/rng.h"

namespace plumescout {
namespace occupancy_grid_test {

// Log-odds are stored as floats of magnitude up to 3.5 and summed a few times.
constexpr double kTolerance = 1e-6;

double ProbabilityOf(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

// A grid of one tile, cell (0,0) at the origin of frame map.
OccupancyGrid OneTile(const OccupancyOptions& options = {}) {
  OccupancyGrid grid(options);
  EXPECT_TRUE(grid.GrowToContain({1.0, 1.0}, {2.0, 2.0}).ok());
  return grid;
}

TEST(OccupancyGrid, StartsEmpty) {
  const OccupancyGrid grid((OccupancyOptions()));
  EXPECT_EQ(grid.geometry().size(), 0U);
  EXPECT_EQ(grid.geometry().resolution_m, 0.1);
  EXPECT_EQ(grid.State({0, 0}), CellState::kUnknown);
  EXPECT_EQ(grid.Probability({0, 0}), 0.5);
}

TEST(OccupancyGrid, GrowsByWholeTilesAnchoredAtTheOriginOfTheMapFrame) {
  OccupancyGrid grid = OneTile();
  EXPECT_EQ(grid.geometry(), (GridGeometry{0.0, 0.0, 0.1, 64, 64}));
  ASSERT_TRUE(grid.GrowToContain({-0.5, 3.0}, {7.0, 3.0}).ok());
  EXPECT_EQ(grid.geometry(), (GridGeometry{-64 * 0.1, 0.0, 0.1, 192, 64}));
}

TEST(OccupancyGrid, KeepsACellOfMarginAroundWhatItContains) {
  OccupancyGrid grid = OneTile();
  ASSERT_TRUE(grid.GrowToContain({0.15, 0.15}, {6.25, 6.25}).ok());
  EXPECT_EQ(grid.geometry().width, 64);
  ASSERT_TRUE(grid.GrowToContain({0.05, 0.15}, {6.25, 6.35}).ok());
  EXPECT_EQ(grid.geometry(), (GridGeometry{-64 * 0.1, 0.0, 0.1, 128, 128}));
}

TEST(OccupancyGrid, KeepsEveryCellInItsPlaceWhileItGrows) {
  Rng rng(1);
  OccupancyGrid grid((OccupancyOptions()));
  std::map<Cell, double> written;  // by cell of the lattice anchored at (0,0)
  const GridGeometry lattice = {0.0, 0.0, 0.1, 0, 0};
  for (int step = 0; step < 200; ++step) {
    const double reach_m = 0.2 * step;
    const Cell place =
        lattice.CellAt({rng.Uniform(-reach_m, reach_m), rng.Uniform(-reach_m, reach_m)});
    const Point2 point = lattice.Center(place);
    ASSERT_TRUE(grid.GrowToContain(point, point).ok());
    const double log_odds = rng.Uniform(-1.0, 1.0);
    grid.Add(grid.geometry().CellAt(point), log_odds);
    written[place] += log_odds;
    ASSERT_EQ(grid.geometry().width % OccupancyGrid::kTileCells, 0);
    ASSERT_EQ(grid.geometry().height % OccupancyGrid::kTileCells, 0);
  }
  for (const auto& [place, log_odds] : written) {
    const Cell cell = grid.geometry().CellAt(lattice.Center(place));
    EXPECT_NEAR(grid.Probability(cell), ProbabilityOf(log_odds), kTolerance);
  }
}

TEST(OccupancyGrid, ContainsPointsThatLieAHairBesideEdgesOfTiles) {
  Rng rng(2);
  for (int trial = 0; trial < 2000; ++trial) {
    OccupancyOptions options;
    options.resolution_m = rng.Uniform(0.01, 0.5);
    OccupancyGrid grid(options);
    const double tile_m = options.resolution_m * OccupancyGrid::kTileCells;
    const double edge_m = tile_m * (static_cast<double>(rng.Below(7)) - 3.0);
    const double x_m = edge_m + options.resolution_m * rng.Uniform(-2e-9, 2e-9);
    ASSERT_TRUE(grid.GrowToContain({x_m, 0.0}, {x_m, 0.0}).ok());
    ASSERT_TRUE(grid.geometry().Contains(grid.geometry().CellAt({x_m, 0.0})));
  }
}

TEST(OccupancyGrid, LearnsAMapAsSurelyAsItCan) {
  Grid<CellState> map({-0.3, 12.7, 0.1, 3, 1});
  map[Cell{0, 0}] = CellState::kFree;
  map[Cell{2, 0}] = CellState::kOccupied;
  OccupancyGrid grid((OccupancyOptions()));
  ASSERT_TRUE(grid.Learn(map).ok());
  const GridGeometry& geometry = grid.geometry();
  EXPECT_NEAR(grid.Probability(geometry.CellAt({-0.25, 12.75})), ProbabilityOf(-3.5), kTolerance);
  EXPECT_NEAR(grid.Probability(geometry.CellAt({-0.05, 12.75})), ProbabilityOf(3.5), kTolerance);
  EXPECT_EQ(grid.Probability(geometry.CellAt({-0.15, 12.75})), 0.5);
  EXPECT_EQ(
      std::count(grid.States().values().begin(), grid.States().values().end(), CellState::kUnknown),
      static_cast<std::ptrdiff_t>(geometry.size()) - 2);
}

TEST(OccupancyGrid, AMapThatItCannotHoldTeachesItNothing) {
  OccupancyGrid grid((OccupancyOptions()));
  const Grid<CellState> map({0.05, 0.0, 0.1, 3, 1}, CellState::kFree);
  EXPECT_EQ(grid.Learn(map).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(grid.geometry().size(), 0U);
}

TEST(OccupancyGrid, RefusesToGrowBeyondItsExtentAndStaysAsItWas) {
  OccupancyOptions options;
  options.max_extent_m = 2 * 6.4;
  OccupancyGrid grid = OneTile(options);
  grid.Add(Cell{3, 4}, 1.0);
  EXPECT_TRUE(grid.GrowToContain({1.0, 1.0}, {12.0, 1.0}).ok());
  const GridGeometry before = grid.geometry();
  EXPECT_EQ(grid.GrowToContain({1.0, 1.0}, {13.0, 1.0}).code(),
            absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(grid.geometry(), before);
  EXPECT_NEAR(grid.Probability({3, 4}), ProbabilityOf(1.0), kTolerance);
}

TEST(OccupancyGrid, RefusesToGrowBeyondItsNumberOfCells) {
  OccupancyOptions options;
  options.max_cell_count = 2 * 64 * 64;
  OccupancyGrid grid = OneTile(options);
  EXPECT_TRUE(grid.GrowToContain({1.0, 1.0}, {7.0, 1.0}).ok());
  EXPECT_EQ(grid.GrowToContain({1.0, 1.0}, {1.0, 7.0}).code(),
            absl::StatusCode::kResourceExhausted);
}

TEST(OccupancyGrid, RefusesPlacesBeyondAnyMap) {
  OccupancyGrid grid = OneTile();
  EXPECT_EQ(grid.GrowToContain({-1e300, 0.0}, {1e300, 0.0}).code(),
            absl::StatusCode::kResourceExhausted);
}

TEST(OccupancyGrid, RefusesARectangleThatIsNone) {
  OccupancyGrid grid = OneTile();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(grid.GrowToContain({nan, 0.0}, {1.0, 1.0}).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(grid.GrowToContain({0.0, 0.0}, {infinity, 1.0}).code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(grid.GrowToContain({2.0, 0.0}, {1.0, 1.0}).code(), absl::StatusCode::kInvalidArgument);
}

TEST(OccupancyGrid, ClampsLogOdds) {
  OccupancyGrid grid = OneTile();
  for (int i = 0; i < 100; ++i) {
    grid.Add(Cell{0, 0}, 0.85);
    grid.Add(Cell{1, 0}, -0.4);
  }
  EXPECT_NEAR(grid.Probability({0, 0}), ProbabilityOf(3.5), kTolerance);
  EXPECT_NEAR(grid.Probability({1, 0}), ProbabilityOf(-3.5), kTolerance);
}

TEST(OccupancyGrid, CallsACellFreeOrOccupiedAtItsThresholds) {
  OccupancyOptions options;
  OccupancyGrid grid = OneTile(options);
  const auto log_odds = [](double p) { return std::log(p / (1.0 - p)); };
  constexpr double kHair = 1e-5;
  grid.Add(Cell{0, 0}, log_odds(options.free_threshold_probability));
  grid.Add(Cell{1, 0}, log_odds(options.free_threshold_probability) + kHair);
  grid.Add(Cell{2, 0}, log_odds(options.occupied_threshold_probability));
  grid.Add(Cell{3, 0}, log_odds(options.occupied_threshold_probability) - kHair);
  EXPECT_EQ(grid.State({0, 0}), CellState::kFree);
  EXPECT_EQ(grid.State({1, 0}), CellState::kUnknown);
  EXPECT_EQ(grid.State({2, 0}), CellState::kOccupied);
  EXPECT_EQ(grid.State({3, 0}), CellState::kUnknown);
}

TEST(OccupancyGrid, CallsACellFreeAfterThreePassesAndOccupiedAfterOneHitByDefault) {
  const OccupancyOptions options;
  OccupancyGrid grid = OneTile();
  grid.Add(Cell{0, 0}, options.miss_log_odds);
  grid.Add(Cell{0, 0}, options.miss_log_odds);
  EXPECT_EQ(grid.State({0, 0}), CellState::kUnknown);
  grid.Add(Cell{0, 0}, options.miss_log_odds);
  EXPECT_EQ(grid.State({0, 0}), CellState::kFree);
  grid.Add(Cell{1, 0}, options.hit_log_odds);
  EXPECT_EQ(grid.State({1, 0}), CellState::kOccupied);
}

TEST(OccupancyGrid, AKnownCellChangesOnlyAtTheOtherThreshold) {
  const OccupancyOptions options;
  OccupancyGrid grid = OneTile();
  const Cell cell{0, 0};
  const auto raise_to = [&](double p) {
    const double now = grid.Probability(cell);
    grid.Add(cell, std::log(p / (1.0 - p)) - std::log(now / (1.0 - now)));
  };
  raise_to(options.free_threshold_probability - 0.01);
  EXPECT_EQ(grid.State(cell), CellState::kFree);
  raise_to(options.occupied_threshold_probability - 0.01);
  EXPECT_EQ(grid.State(cell), CellState::kFree);
  raise_to(options.occupied_threshold_probability + 0.01);
  EXPECT_EQ(grid.State(cell), CellState::kOccupied);
  raise_to(options.free_threshold_probability + 0.01);
  EXPECT_EQ(grid.State(cell), CellState::kOccupied);
  raise_to(options.free_threshold_probability - 0.01);
  EXPECT_EQ(grid.State(cell), CellState::kFree);
}

TEST(OccupancyGrid, StatesStayWithTheirCellsWhileItGrows) {
  OccupancyGrid grid = OneTile();
  const Point2 place = grid.geometry().Center({3, 5});
  grid.Add(Cell{3, 5}, -3.0);
  grid.Add(Cell{3, 5}, 3.0);  // between the thresholds, and still free
  ASSERT_TRUE(grid.GrowToContain({-20.0, -9.0}, {20.0, 9.0}).ok());
  EXPECT_EQ(grid.State(grid.geometry().CellAt(place)), CellState::kFree);
  EXPECT_EQ(grid.State({3, 5}), CellState::kUnknown);
}

TEST(OccupancyGrid, StatesAreTheStatesOfItsCells) {
  Rng rng(3);
  OccupancyGrid grid = OneTile();
  for (std::size_t i = 0; i < grid.geometry().size(); ++i) grid.Add(i, rng.Uniform(-3.0, 3.0));
  const Grid<CellState> states = grid.States();
  ASSERT_EQ(states.geometry(), grid.geometry());
  for (std::size_t i = 0; i < states.size(); ++i) {
    ASSERT_EQ(states[i], grid.State(states.geometry().CellAtIndex(i)));
  }
}

TEST(OccupancyGrid, GrowsNoFurtherThanItsMemoryAllows) {
  OccupancyGrid grid = OneTile();
  grid.LimitCells(2 * 64 * 64);
  EXPECT_TRUE(grid.GrowToContain({1.0, 1.0}, {7.0, 2.0}).ok());
  const OccupancyGrid before = grid;
  const absl::Status refused = grid.GrowToContain({1.0, 1.0}, {14.0, 2.0});
  EXPECT_TRUE(absl::IsResourceExhausted(refused));
  EXPECT_EQ(refused.message().find("BUDGET_REACHED: a map of 192 x 64 cells"), 0U) << refused;
  EXPECT_EQ(grid.States(), before.States());
  grid.LimitCells(0);
  EXPECT_TRUE(grid.GrowToContain({1.0, 1.0}, {7.0, 2.0}).ok()) << "it need not grow";
}

}  // namespace occupancy_grid_test
}  // namespace plumescout
