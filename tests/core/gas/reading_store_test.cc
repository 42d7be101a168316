// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_store.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "tests/support/grid_art.h"

namespace plumescout {
namespace {

using ::plumescout::testing::GridFromArt;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

GasOptions Options(double half_life_s = 0.0) {
  GasOptions options;
  options.background_mean_ppm = 2.0;
  options.ageing_half_life_s = half_life_s;
  return options;
}

PlacedReadings PlaceOn(ReadingStore& store, const Grid<CellState>& states,
                       std::int64_t time_ns = 0) {
  return store.PlaceAll(GmrfGraph(states), time_ns).value();
}

TEST(ReadingStoreTest, MergesReadingsOfACell) {
  ReadingStore store(Options());
  store.Add(0, {0.05, 0.05}, {12.0});
  store.Add(0, {0.02, 0.09}, {7.0, 0.5});
  const PlacedReadings placed = PlaceOn(store, GridFromArt({".."}));
  EXPECT_DOUBLE_EQ(placed.evidence[0].precision, 10.0 + 2.0);
  EXPECT_DOUBLE_EQ(placed.evidence[0].weighted_deviation, 10.0 * 10.0 + 2.0 * 5.0);
  EXPECT_EQ(placed.evidence[1].precision, 0.0);
  EXPECT_EQ(placed.counters, (GasCounters{.readings = 2, .in_posterior = 2}));
}

TEST(ReadingStoreTest, SumsOverRefreshes) {
  ReadingStore store(Options());
  for (int round = 1; round <= 3; ++round) {
    store.Add(0, {0.05, 0.05}, {3.0});
    const PlacedReadings placed = PlaceOn(store, GridFromArt({"."}));
    EXPECT_DOUBLE_EQ(placed.evidence[0].precision, 10.0 * round);
    EXPECT_EQ(placed.counters.in_posterior, round);
  }
}

TEST(ReadingStoreTest, AgesEachReadingByItsOwnTime) {
  ReadingStore store(Options(60.0));
  store.Add(0, {0.05, 0.05}, {12.0});
  store.Add(60 * kSecond_ns, {0.05, 0.05}, {7.0, 0.5});
  const PlacedReadings placed = PlaceOn(store, GridFromArt({"."}), 120 * kSecond_ns);
  const double first = 1.0 / (1.0 / 10.0 + 120.0 / (60.0 * 10.0));
  const double second = 1.0 / (0.5 + 60.0 / (60.0 * 10.0));
  EXPECT_DOUBLE_EQ(placed.evidence[0].precision, first + second);
  EXPECT_DOUBLE_EQ(placed.evidence[0].weighted_deviation, first * 10.0 + second * 5.0);
}

TEST(ReadingStoreTest, CanAgeToAnEarlierTimeAgain) {
  ReadingStore store(Options(60.0));
  store.Add(0, {0.05, 0.05}, {12.0});
  const double now = PlaceOn(store, GridFromArt({"."}), 0).evidence[0].precision;
  EXPECT_LT(PlaceOn(store, GridFromArt({"."}), kSecond_ns).evidence[0].precision, now);
  EXPECT_EQ(PlaceOn(store, GridFromArt({"."}), 0).evidence[0].precision, now);
}

TEST(ReadingStoreTest, CountsWhatMovedAndWhatWaits) {
  ReadingStore store(Options());
  store.Add(0, {0.05, 0.05}, {1.0});  // free
  store.Add(0, {0.15, 0.05}, {1.0});  // beside
  store.Add(0, {0.35, 0.05}, {1.0});  // in the dark
  store.Add(0, {9.0, 9.0}, {1.0});    // beyond the grid
  const PlacedReadings placed = PlaceOn(store, GridFromArt({".#??"}));
  EXPECT_EQ(placed.counters,
            (GasCounters{.readings = 4, .in_posterior = 2, .moved_to_neighbour = 1, .waiting = 2}));
}

TEST(ReadingStoreTest, KeepsReadingsUntilTheirCellIsFree) {
  ReadingStore store(Options());
  store.Add(0, {0.35, 0.05}, {12.0});
  EXPECT_EQ(PlaceOn(store, GridFromArt({"..??"})).counters.waiting, 1);
  const PlacedReadings placed = PlaceOn(store, GridFromArt({"...."}));
  EXPECT_EQ(placed.counters, (GasCounters{.readings = 1, .in_posterior = 1}));
  EXPECT_DOUBLE_EQ(placed.evidence[3].precision, 10.0);
}

TEST(ReadingStoreTest, BringsReadingsBackWhenTheirCellReappears) {
  ReadingStore store(Options());
  store.Add(0, {0.25, 0.05}, {12.0});
  const Grid<CellState> free = GridFromArt({"....."});
  const double precision = PlaceOn(store, free).evidence[2].precision;
  EXPECT_EQ(PlaceOn(store, GridFromArt({".###."})).counters.waiting, 1);
  EXPECT_EQ(PlaceOn(store, free).evidence[2].precision, precision);
}

TEST(ReadingStoreTest, FindsReadingsAgainWhenTheGridGrows) {
  Grid<CellState> small = GridFromArt({"..", ".."});
  ReadingStore store(Options());
  store.Add(0, {0.15, 0.05}, {12.0});
  PlaceOn(store, small);
  for (const auto& [west, south] : {std::pair{4, 0}, {0, 4}, {4, 4}, {0, 0}, {-1, 0}}) {
    GridGeometry geometry = small.geometry();
    geometry.origin_x_m -= 0.1 * west;
    geometry.origin_y_m -= 0.1 * south;
    geometry.width = 8;
    geometry.height = 8;
    const Grid<CellState> grown(geometry, CellState::kFree);
    const PlacedReadings placed = PlaceOn(store, grown);
    const VariableIndex expected = GmrfGraph(grown).At({west + 1, south});
    EXPECT_DOUBLE_EQ(placed.evidence[ToSize(expected)].precision, 10.0);
  }
}

TEST(ReadingStoreTest, RefusesAnotherLattice) {
  ReadingStore store(Options());
  PlaceOn(store, GridFromArt({"."}));
  GridGeometry geometry = GridFromArt({"."}).geometry();
  geometry.origin_x_m = 0.05;
  EXPECT_EQ(store.PlaceAll(GmrfGraph(Grid<CellState>(geometry)), 0).status().code(),
            absl::StatusCode::kInvalidArgument);
  geometry.origin_x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(store.PlaceAll(GmrfGraph(Grid<CellState>(geometry)), 0).status().code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(store.PlaceAll(GmrfGraph(GridFromArt({"."}, 0.2)), 0).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(ReadingStoreTest, LetsReadingsWaitForTheFirstGrid) {
  ReadingStore store(Options());
  store.Add(0, {0.05, 0.05}, {12.0});
  EXPECT_EQ(PlaceOn(store, Grid<CellState>()).counters, (GasCounters{.readings = 1, .waiting = 1}));
  GridGeometry geometry = GridFromArt({"."}).geometry();
  geometry.origin_x_m = -0.03;
  EXPECT_EQ(PlaceOn(store, Grid<CellState>(geometry, CellState::kFree)).counters.in_posterior, 1);
}

TEST(ReadingStoreTest, LetsUnusableReadingsWaitForEver) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ReadingStore store(Options());
  store.Add(0, {kNan, 0.05}, {1.0});
  store.Add(0, {0.05, kInfinity}, {1.0});
  store.Add(0, {0.05, 0.05}, {kNan});
  store.Add(0, {0.05, 0.05}, {1e300});
  store.Add(0, {0.05, 0.05}, {1.0, -1.0});
  store.Add(0, {0.05, 0.05}, {1.0, kInfinity});
  const PlacedReadings placed = PlaceOn(store, GridFromArt({"."}));
  EXPECT_EQ(placed.counters, (GasCounters{.readings = 6, .waiting = 6}));
  EXPECT_EQ(placed.evidence[0].precision, 0.0);
}

}  // namespace
}  // namespace plumescout
