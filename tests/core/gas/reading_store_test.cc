// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/types/rng.h"
#include "tests/support/grid_art.h"

namespace plumescout {

void PrintTo(AnchorCell cell, std::ostream* out) { *out << "(" << cell.x << ", " << cell.y << ")"; }

namespace reading_store_test {

using ::plumescout::testing::GridArt;
using ::plumescout::testing::GridFromArt;

using Cells = std::vector<AnchorCell>;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kWeek_s = 7 * 24 * 3600;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

GasOptions Options(double half_life_s = 0.0) {
  GasOptions options = PublishedGasOptions();
  options.background_mean_ppm = 2.0;
  options.ageing_half_life_s = half_life_s;
  return options;
}

// As if every cell of `states` had changed.
absl::Status PlaceAll(ReadingStore& store, const Grid<CellState>& states) {
  std::vector<std::size_t> all(states.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return store.Place(states, all);
}

Grid<CellState> GridAt(int west, int south, int width, int height) {
  return Grid<CellState>(GridGeometry{-0.1 * west, -0.1 * south, 0.1, width, height},
                         CellState::kFree);
}

ReadingStore StoreWith(std::initializer_list<std::pair<Point2, GasReading>> readings,
                       const GridArt& art, double half_life_s = 0.0) {
  ReadingStore store(Options(half_life_s));
  for (const auto& [position, reading] : readings) store.Add(0, position, reading);
  EXPECT_TRUE(store.Place(GridFromArt(art), {}).ok());
  return store;
}

bool SameBits(const Evidence& a, const Evidence& b) {
  return a.precision == b.precision && a.weighted_deviation == b.weighted_deviation;
}

TEST(ReadingStoreTest, MergesReadingsOfACell) {
  const ReadingStore store =
      StoreWith({{{0.05, 0.05}, {12.0}}, {{0.02, 0.09}, {7.0, 0.5}}}, {".."});
  EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).precision, 10.0 + 2.0);
  EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).weighted_deviation, 10.0 * 10.0 + 2.0 * 5.0);
  EXPECT_EQ(store.EvidenceAt({1, 0}).precision, 0.0);
  EXPECT_EQ(store.counters(), (GasCounters{.readings = 2, .in_posterior = 2}));
}

TEST(ReadingStoreTest, KeepsConcentrationsAsTheyAre) {
  const ReadingStore store =
      StoreWith({{{0.05, 0.05}, {-5.0}}, {{0.15, 0.05}, {1e6}}, {{0.25, 0.05}, {0.0}}}, {"..."});
  EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).weighted_deviation, 10.0 * -7.0);
  EXPECT_DOUBLE_EQ(store.EvidenceAt({1, 0}).weighted_deviation, 10.0 * (1e6 - 2.0));
  EXPECT_DOUBLE_EQ(store.EvidenceAt({2, 0}).weighted_deviation, 10.0 * -2.0);
}

TEST(ReadingStoreTest, ReportsCellsThatChangedOnceAndAscending) {
  ReadingStore store = StoreWith(
      {{{0.25, 0.15}, {1.0}}, {{0.15, 0.15}, {1.0}}, {{0.25, 0.15}, {2.0}}, {{0.35, 0.05}, {1.0}}},
      {"....", "...."});
  EXPECT_EQ(store.TakeChanged(), (Cells{{3, 0}, {1, 1}, {2, 1}}));
  EXPECT_EQ(store.TakeChanged(), Cells());
  store.Add(0, {0.15, 0.15}, {1.0});
  EXPECT_EQ(store.TakeChanged(), Cells());
  ASSERT_TRUE(store.Place(GridFromArt({"....", "...."}), {}).ok());
  EXPECT_EQ(store.TakeChanged(), (Cells{{1, 1}}));
}

TEST(ReadingStoreTest, CountsAtAnyTimeWhatMovedAndWhatWaits) {
  ReadingStore store(Options());
  store.Add(0, {0.05, 0.05}, {1.0});  // free
  store.Add(0, {0.15, 0.05}, {1.0});  // beside
  store.Add(0, {0.35, 0.05}, {1.0});  // in the dark
  store.Add(0, {9.0, 9.0}, {1.0});    // beyond the grid
  store.Add(0, {0.05, 0.05}, {kNan});
  EXPECT_EQ(store.counters(), (GasCounters{.readings = 5, .waiting = 5}));
  ASSERT_TRUE(store.Place(GridFromArt({".#??"}), {}).ok());
  EXPECT_EQ(store.counters(),
            (GasCounters{.readings = 5, .in_posterior = 2, .moved_to_neighbour = 1, .waiting = 3}));
}

TEST(ReadingStoreTest, PlacesAnewWhatLiesAroundACellThatChanged) {
  ReadingStore store = StoreWith(
      {{{0.05, 0.05}, {1.0}}, {{0.21, 0.05}, {1.0}}, {{0.75, 0.05}, {1.0}}, {{0.95, 0.05}, {1.0}}},
      {"..?......."});
  EXPECT_EQ(store.TakeChanged(), (Cells{{0, 0}, {1, 0}, {7, 0}, {9, 0}}));
  const std::size_t freed = 2;
  ASSERT_TRUE(store.Place(GridFromArt({".........."}), {&freed, 1}).ok());
  EXPECT_EQ(store.TakeChanged(), (Cells{{1, 0}, {2, 0}}));
  EXPECT_EQ(store.counters(), (GasCounters{.readings = 4, .in_posterior = 4}));
}

TEST(ReadingStoreTest, KeepsReadingsUntilTheirCellIsFree) {
  ReadingStore store = StoreWith({{{0.35, 0.05}, {12.0}}}, {"..??"});
  EXPECT_EQ(store.counters().waiting, 1);
  ASSERT_TRUE(PlaceAll(store, GridFromArt({"...."})).ok());
  EXPECT_EQ(store.counters(), (GasCounters{.readings = 1, .in_posterior = 1}));
  EXPECT_DOUBLE_EQ(store.EvidenceAt({3, 0}).precision, 10.0);
}

TEST(ReadingStoreTest, BringsReadingsBackWhenTheirCellReappears) {
  ReadingStore store = StoreWith({{{0.25, 0.05}, {12.0}}}, {"....."});
  const Evidence before = store.EvidenceAt({2, 0});
  ASSERT_TRUE(PlaceAll(store, GridFromArt({".###."})).ok());
  EXPECT_EQ(store.counters().waiting, 1);
  EXPECT_EQ(store.EvidenceAt({2, 0}).precision, 0.0);
  ASSERT_TRUE(PlaceAll(store, GridFromArt({"....."})).ok());
  EXPECT_TRUE(SameBits(store.EvidenceAt({2, 0}), before));
}

// A huge reading that is subtracted again would leave its rounding behind.
TEST(ReadingStoreTest, KeepsNoTraceOfWhatLeft) {
  ReadingStore store = StoreWith({{{0.05, 0.05}, {3.1, 0.7}}}, {".#"});
  const Evidence alone = store.EvidenceAt({0, 0});
  store.Add(0, {0.15, 0.05}, {1e9, 1e-9});
  ASSERT_TRUE(store.Place(GridFromArt({".#"}), {}).ok());
  EXPECT_GT(store.EvidenceAt({0, 0}).precision, 1e8);
  ASSERT_TRUE(PlaceAll(store, GridFromArt({".."})).ok());
  EXPECT_TRUE(SameBits(store.EvidenceAt({0, 0}), alone));
}

TEST(ReadingStoreTest, FindsReadingsAgainWhenTheGridGrowsOrItsOriginMoves) {
  ReadingStore store = StoreWith({{{0.15, 0.05}, {12.0}}}, {"..", ".."});
  for (const auto& [west, south] : {std::pair{4, 0}, {0, 4}, {4, 4}, {0, 0}, {-1, 0}}) {
    ASSERT_TRUE(PlaceAll(store, GridAt(west, south, 8, 8)).ok());
    EXPECT_DOUBLE_EQ(store.EvidenceAt({1, 0}).precision, 10.0);
    EXPECT_EQ(store.counters(), (GasCounters{.readings = 1, .in_posterior = 1}));
  }
}

TEST(ReadingStoreTest, LetsReadingsWaitThatTheGridNoLongerCovers) {
  ReadingStore store = StoreWith({{{0.05, 0.05}, {12.0}}, {{0.75, 0.05}, {12.0}}}, {"........"});
  ASSERT_TRUE(store.Place(GridAt(-4, 0, 8, 1), {}).ok());
  EXPECT_EQ(store.counters(), (GasCounters{.readings = 2, .in_posterior = 1, .waiting = 1}));
  EXPECT_EQ(store.EvidenceAt({0, 0}).precision, 0.0);
  ASSERT_TRUE(store.Place(GridAt(0, 0, 0, 0), {}).ok());
  EXPECT_EQ(store.counters().waiting, 2);
}

TEST(ReadingStoreTest, RefusesAnotherLatticeAndChangesNothing) {
  ReadingStore store = StoreWith({{{0.05, 0.05}, {12.0}}}, {"."});
  EXPECT_EQ(store.TakeChanged().size(), 1U);
  const Evidence before = store.EvidenceAt({0, 0});
  store.Add(0, {0.05, 0.05}, {12.0});
  const GasCounters counters = store.counters();
  GridGeometry between = store.anchor();
  between.origin_x_m = 0.05;
  GridGeometry nowhere = store.anchor();
  nowhere.origin_x_m = kNan;
  for (const Grid<CellState>& states :
       {Grid<CellState>(between), Grid<CellState>(nowhere), GridFromArt({"#"}, 0.2)}) {
    EXPECT_EQ(PlaceAll(store, states).code(), absl::StatusCode::kInvalidArgument);
  }
  EXPECT_EQ(store.TakeChanged(), Cells());
  EXPECT_EQ(store.counters(), counters);
  EXPECT_TRUE(SameBits(store.EvidenceAt({0, 0}), before));
  ASSERT_TRUE(store.Place(GridFromArt({"."}), {}).ok());
  EXPECT_EQ(store.counters().in_posterior, 2);
}

TEST(ReadingStoreTest, RefusesAFirstGridThatIsNowhere) {
  ReadingStore store(Options());
  store.Add(0, {0.05, 0.05}, {12.0});
  GridGeometry nowhere = GridFromArt({"."}).geometry();
  nowhere.origin_y_m = kInfinity;
  EXPECT_FALSE(store.Place(Grid<CellState>(nowhere, CellState::kFree), {}).ok());
  EXPECT_TRUE(store.Place(GridFromArt({"."}), {}).ok());
  EXPECT_EQ(store.counters().in_posterior, 1);
}

TEST(ReadingStoreTest, LetsReadingsWaitForTheFirstGrid) {
  ReadingStore store(Options());
  store.Add(0, {0.05, 0.05}, {12.0});
  ASSERT_TRUE(store.Place(Grid<CellState>(), {}).ok());
  EXPECT_EQ(store.counters(), (GasCounters{.readings = 1, .waiting = 1}));
  EXPECT_EQ(store.anchor().size(), 0U);
  GridGeometry geometry = GridFromArt({"."}).geometry();
  geometry.origin_x_m = -0.03;
  ASSERT_TRUE(store.Place(Grid<CellState>(geometry, CellState::kFree), {}).ok());
  EXPECT_EQ(store.counters().in_posterior, 1);
  EXPECT_EQ(store.anchor(), geometry);
}

TEST(ReadingStoreTest, LetsUnusableReadingsWaitForEver) {
  const std::initializer_list<std::pair<Point2, GasReading>> unusable = {
      {{kNan, 0.05}, {1.0}},       {{0.05, kInfinity}, {1.0}},      {{0.05, 0.05}, {kNan}},
      {{0.05, 0.05}, {kInfinity}}, {{0.05, 0.05}, {1e300}},         {{0.05, 0.05}, {1.0, -1.0}},
      {{0.05, 0.05}, {1.0, kNan}}, {{0.05, 0.05}, {1.0, kInfinity}}};
  for (const double half_life_s : {0.0, 60.0}) {
    const ReadingStore store = StoreWith(unusable, {"."}, half_life_s);
    EXPECT_EQ(store.counters(), (GasCounters{.readings = 8, .waiting = 8}));
    EXPECT_EQ(store.EvidenceAt({0, 0}).precision, 0.0);
  }
}

TEST(ReadingStoreTest, LetsReadingsWaitWhereverTheyCannotBePlaced) {
  const std::initializer_list<std::pair<Point2, GasReading>> far = {
      {{1e300, 0.05}, {1.0}}, {{-1e300, 1e300}, {1.0}}, {{1e9, -1e9}, {1.0}}, {{5.0, 0.05}, {1.0}}};
  EXPECT_EQ(StoreWith(far, {"..."}).counters(), (GasCounters{.readings = 4, .waiting = 4}));
  EXPECT_EQ(StoreWith({{{0.05, 0.05}, {1.0}}}, {"#?#"}).counters().waiting, 1);
}

TEST(ReadingStoreTest, GathersReadingsAroundAnIsolatedFreeCell) {
  const ReadingStore store = StoreWith(
      {{{0.05, 0.05}, {1.0}}, {{0.15, 0.15}, {1.0}}, {{0.25, 0.15}, {1.0}}}, {"#?#", "?.?", "###"});
  EXPECT_DOUBLE_EQ(store.EvidenceAt({1, 1}).precision, 30.0);
  EXPECT_EQ(store.counters(),
            (GasCounters{.readings = 3, .in_posterior = 3, .moved_to_neighbour = 2}));
}

TEST(ReadingStoreTest, TakesAnyFiniteVariance) {
  for (const double half_life_s : {0.0, 60.0}) {
    ReadingStore store(Options(half_life_s));
    for (const double variance_ppm2 : {0.0, 5e-324, 1.0, 1e300}) {
      store.Add(0, {0.05, 0.05}, {-1e9, variance_ppm2});
    }
    ASSERT_TRUE(store.Place(GridFromArt({"."}), {}).ok());
    store.Compact(0);
    EXPECT_EQ(store.counters().in_posterior, 4);
    EXPECT_NEAR(store.EvidenceAt({0, 0}).precision, 1e9, 100.0);  // of the second alone
    EXPECT_NEAR(store.EvidenceAt({0, 0}).weighted_deviation, -1e18, 1e12);
  }
}

TEST(ReadingStoreAgeingTest, AgesEachReadingByItsOwnTime) {
  ReadingStore store(Options(60.0));
  store.Add(0, {0.05, 0.05}, {12.0});
  store.Add(60 * kSecond_ns, {0.05, 0.05}, {7.0, 0.5});
  ASSERT_TRUE(store.Place(GridFromArt({"."}), {}).ok());
  store.AgeTo(120 * kSecond_ns);
  const double first = 1.0 / (1.0 / 10.0 + 120.0 / (60.0 * 10.0));
  const double second = 1.0 / (0.5 + 60.0 / (60.0 * 10.0));
  EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).precision, first + second);
  EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).weighted_deviation, first * 10.0 + second * 5.0);
}

TEST(ReadingStoreAgeingTest, ReportsEveryCellWithEvidence) {
  ReadingStore store = StoreWith({{{0.35, 0.05}, {1.0}}, {{0.05, 0.05}, {1.0}}}, {"...."}, 60.0);
  EXPECT_EQ(store.TakeChanged().size(), 2U);
  ASSERT_TRUE(PlaceAll(store, GridFromArt({"..??"})).ok());
  EXPECT_EQ(store.TakeChanged(), (Cells{{3, 0}}));
  store.AgeTo(kSecond_ns);
  EXPECT_EQ(store.TakeChanged(), (Cells{{0, 0}}));
}

TEST(ReadingStoreAgeingTest, DoesNothingWithoutAHalfLife) {
  ReadingStore store = StoreWith({{{0.05, 0.05}, {1.0}}}, {"."});
  store.TakeChanged();
  const Evidence before = store.EvidenceAt({0, 0});
  store.Compact(kWeek_s * kSecond_ns);
  store.AgeTo(kWeek_s * kSecond_ns);
  EXPECT_EQ(store.TakeChanged(), Cells());
  EXPECT_TRUE(SameBits(store.EvidenceAt({0, 0}), before));
  EXPECT_TRUE(SameBits(store.EvidenceAsOf(kWeek_s * kSecond_ns)[0].evidence, before));
}

TEST(ReadingStoreAgeingTest, DependsOnTimeNotOnHowOftenItIsApplied) {
  ReadingStore once = StoreWith({{{0.05, 0.05}, {12.0}}}, {"."}, 60.0);
  ReadingStore often = once;
  for (int k = 1; k <= 100; ++k) often.AgeTo(k * kSecond_ns);
  once.AgeTo(100 * kSecond_ns);
  EXPECT_TRUE(SameBits(once.EvidenceAt({0, 0}), often.EvidenceAt({0, 0})));
}

TEST(ReadingStoreAgeingTest, CanGoBackToAnEarlierTime) {
  ReadingStore store = StoreWith({{{0.05, 0.05}, {12.0}}}, {"."}, 60.0);
  const Evidence before = store.EvidenceAt({0, 0});
  store.AgeTo(kSecond_ns);
  EXPECT_LT(store.EvidenceAt({0, 0}).precision, before.precision);
  store.AgeTo(0);
  EXPECT_TRUE(SameBits(store.EvidenceAt({0, 0}), before));
}

TEST(ReadingStoreAgeingTest, TakesReadingsFromTheFutureAndFromBeforeTheMission) {
  ReadingStore store(Options(60.0));
  store.Add(1000 * kSecond_ns, {0.05, 0.05}, {12.0});
  store.Add(-60 * kSecond_ns, {0.15, 0.05}, {12.0});
  store.Add(std::numeric_limits<std::int64_t>::min(), {0.25, 0.05}, {12.0});
  ASSERT_TRUE(store.Place(GridFromArt({"..."}), {}).ok());
  store.Compact(0);
  EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).precision, 10.0);
  EXPECT_DOUBLE_EQ(store.EvidenceAt({1, 0}).precision, 5.0);
  EXPECT_GT(store.EvidenceAt({2, 0}).precision, 0.0);
  EXPECT_LT(store.EvidenceAt({2, 0}).precision, 1e-6);  // 292 years
  EXPECT_EQ(store.counters().in_posterior, 3);
}

TEST(ReadingStoreAgeingTest, NeverForgetsAReading) {
  ReadingStore store = StoreWith({{{0.05, 0.05}, {12.0}}}, {"."}, 1.0);
  store.AgeTo(kWeek_s * kSecond_ns);
  EXPECT_GT(store.EvidenceAt({0, 0}).precision, 0.0);
  EXPECT_EQ(store.counters().in_posterior, 1);
}

// What an epoch was made of is what the store says when the epoch is adopted.
TEST(ReadingStoreAgeingTest, GivesTheBitsOfTheEpochLater) {
  ReadingStore store(Options(60.0));
  for (int k = 0; k < 500; ++k) {
    store.Add(k * kSecond_ns, {0.003 * (k % 200), 0.05 + 0.0001 * k}, {1.0 * k, 0.01 * (k % 7)});
  }
  ASSERT_TRUE(store.Place(GridFromArt({".#...."}), {}).ok());
  store.AgeTo(100 * kSecond_ns);
  const std::int64_t epoch_ns = 500 * kSecond_ns;
  store.Compact(epoch_ns);
  const std::vector<CellEvidence> epoch = store.EvidenceAsOf(epoch_ns);
  ASSERT_EQ(epoch.size(), 5U);
  store.Add(501 * kSecond_ns, {0.55, 0.05}, {3.0});
  ASSERT_TRUE(store.Place(GridFromArt({".#...."}), {}).ok());
  store.AgeTo(epoch_ns);
  EXPECT_EQ(store.TakeChanged().size(), epoch.size());
  for (std::size_t k = 0; k + 1 < epoch.size(); ++k) {
    EXPECT_TRUE(SameBits(store.EvidenceAt(epoch[k].cell), epoch[k].evidence));
    EXPECT_LT(epoch[k].cell, epoch[k + 1].cell);
  }
  EXPECT_FALSE(SameBits(store.EvidenceAt(epoch.back().cell), epoch.back().evidence));
}

TEST(ReadingStoreAgeingTest, KeepsAWeekInOneCellSmall) {
  ReadingStore store(Options(120.0));
  std::size_t most_buckets = 0;
  for (std::int64_t second = 0; second < kWeek_s; second += 6) {
    store.Add(second * kSecond_ns, {0.05, 0.05}, {12.0});
    if (second % 120 != 0) continue;
    ASSERT_TRUE(store.Place(GridFromArt({"."}), {}).ok());
    store.Compact(second * kSecond_ns);
    most_buckets = std::max(most_buckets, store.buckets());
  }
  EXPECT_LE(most_buckets, 44U);  // MergeAlike's bound for this ratio of variances
  ASSERT_TRUE(store.Place(GridFromArt({"."}), {}).ok());
  EXPECT_EQ(store.counters().in_posterior, kWeek_s / 6);
}

TEST(ReadingStoreAgeingTest, ForgetsWithAgeWhereInAFreeCellAReadingWas) {
  const std::initializer_list<std::pair<Point2, GasReading>> west = {{{0.11, 0.05}, {12.0}}};
  const std::int64_t halved_ns = 61 * kSecond_ns;
  ReadingStore store = StoreWith(west, {"..."}, 60.0);
  store.TakeChanged();
  store.Compact(59 * kSecond_ns);
  ASSERT_TRUE(PlaceAll(store, GridFromArt({".#."})).ok());
  EXPECT_GT(store.EvidenceAt({0, 0}).precision, 0.0);  // still known to have been in the west
  store.Compact(halved_ns);                            // not in a free cell: not forgotten
  ASSERT_TRUE(PlaceAll(store, GridFromArt({"..."})).ok());
  store.TakeChanged();
  const double precision = store.EvidenceAt({1, 0}).precision;
  store.Compact(halved_ns);
  EXPECT_EQ(store.TakeChanged(), Cells());
  EXPECT_EQ(store.EvidenceAt({1, 0}).precision, precision);
  EXPECT_EQ(store.counters(), (GasCounters{.readings = 1, .in_posterior = 1}));
  ASSERT_TRUE(PlaceAll(store, GridFromArt({".#."})).ok());
  EXPECT_EQ(store.TakeChanged(), (Cells{{1, 0}, {2, 0}}));  // of equal ones the east comes first
  EXPECT_EQ(store.counters(),
            (GasCounters{.readings = 1, .in_posterior = 1, .moved_to_neighbour = 1}));
}

TEST(ReadingStoreAgeingTest, KeepsAWeekAnywhereInACellSmall) {
  ReadingStore store(Options(120.0));
  std::size_t most_buckets = 0;
  for (std::int64_t second = 0; second < kWeek_s; second += 10) {
    const double k = static_cast<double>(second / 10);
    store.Add(second * kSecond_ns, {0.1 * std::fmod(0.618 * k, 1.0), 0.1 * std::fmod(0.414 * k, 1)},
              {12.0});
    if (second % 120 != 0) continue;
    ASSERT_TRUE(store.Place(GridFromArt({"."}), {}).ok());
    store.Compact(second * kSecond_ns);
    most_buckets = std::max(most_buckets, store.buckets());
  }
  // MergeAlike's bound for the centre, and the 24 readings of less than two periods.
  EXPECT_LT(most_buckets, 44U + 24U);
}

TEST(ReadingStoreTest, KeepsAWeekAnywhereInACellWithoutAgeingAsFewSums) {
  for (const auto& [width_m, most_sites] : {std::pair{0.0, std::size_t{1}}, {0.1, kSitesPerCell}}) {
    ReadingStore store(Options());
    Rng rng(9);
    for (std::int64_t second = 0; second < kWeek_s; second += 6) {
      store.Add(second * kSecond_ns, {rng.Uniform(0.0, width_m), rng.Uniform(0.0, width_m)}, {});
    }
    ASSERT_TRUE(store.Place(GridFromArt({"."}), {}).ok());
    EXPECT_LE(store.sites(), most_sites);
    EXPECT_EQ(store.buckets(), 0U);
    EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).precision, 10.0 * static_cast<double>(kWeek_s / 6));
  }
}

}  // namespace reading_store_test
}  // namespace plumescout
