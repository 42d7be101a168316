// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/core/gas/dense_field.h"
#include "tests/core/gas/field/field_case.h"
#include "tests/core/gas/gas_map_peer.h"
#include "tests/core/gas/timed_readings.h"
#include "tests/support/grid_art.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace gas_map_test {

using ::plumescout::testing::DenseField;
using ::plumescout::testing::DenseReading;
using ::plumescout::testing::GridArt;
using ::plumescout::testing::GridFromArt;
using ::plumescout::testing::kSecond_ns;
using ::plumescout::testing::RandomTimedReadings;
using ::plumescout::testing::TimedReading;

// Rounding to float comes on top of what is certified.
constexpr double kFloat = 1e-7;
constexpr double kLargest_ppm = 40.0;  // of the readings below

GasMap MapOf(const std::vector<TimedReading>& readings, const Grid<CellState>& states,
             std::int64_t time_ns, const GasOptions& options = PublishedGasOptions()) {
  GasMap map(options);
  for (const TimedReading& r : readings) map.Add(r.time_ns, r.position, r.reading);
  EXPECT_TRUE(map.Refresh(states, time_ns).ok());
  return map;
}

float At(const Grid<float>& grid, int x, int y) { return grid[Cell{x, y}]; }

// Lets an epoch age all readings to `time_ns`.
void Age(GasMap& map, std::int64_t time_ns) {
  EXPECT_TRUE(map.BeginEpoch(time_ns).ok());
  EXPECT_TRUE(map.Adopt().ok());
}

// `merged` is what merging readings of like age may add, as share.
void ExpectSameWithinCertificate(const GasMap& map, const GasMap& exact, double merged = 0.0) {
  ASSERT_EQ(map.mean_ppm().geometry(), exact.mean_ppm().geometry());
  for (std::size_t i = 0; i < map.mean_ppm().size(); ++i) {
    ASSERT_EQ(std::isnan(map.mean_ppm()[i]), std::isnan(exact.mean_ppm()[i]));
    if (std::isnan(map.mean_ppm()[i])) continue;
    const double mean_ppm = exact.mean_ppm()[i];
    const double variance_ppm2 = exact.variance_ppm2()[i];
    EXPECT_NEAR(map.mean_ppm()[i], mean_ppm,
                map.quality().mean_error_ppm + (2 * kFloat + merged) * kLargest_ppm);
    EXPECT_NEAR(map.variance_ppm2()[i], variance_ppm2,
                (map.quality().variance_error_ratio + 2 * kFloat + merged) * variance_ppm2);
  }
}

TEST(GasMapTest, PublishesTheExactPosteriorRoundedToFloat) {
  Rng rng(1);
  const Grid<CellState> states = testing::RandomStates(14, 12, 0.2, rng);
  std::vector<DenseReading> readings = testing::RandomReadings(states, 25, rng);
  GasOptions options = PublishedGasOptions();
  options.background_mean_ppm = 3.0;
  GasMap map(options);
  for (const DenseReading& r : readings) {
    map.Add(0, states.geometry().Center(r.cell), {r.concentration_ppm, 1.0 / r.precision});
  }
  ASSERT_TRUE(map.Refresh(states, 0).ok());

  const DenseField oracle(states, readings, options);
  for (std::size_t k = 0; k < oracle.cells().size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    // Within one unit of the last place of a float: rounding, and 1e-9 of double before it.
    EXPECT_FLOAT_EQ(map.mean_ppm()[oracle.cells()[k]], static_cast<float>(oracle.mean_ppm()(row)));
    EXPECT_FLOAT_EQ(map.variance_ppm2()[oracle.cells()[k]],
                    static_cast<float>(oracle.variance_ppm2()(row)));
  }
}

// Neither square nor of the shape of the lattice that it is computed on.
TEST(GasMapTest, EveryVarianceIsThatOfTheDenseInverseAt40By50Cells) {
  Rng rng(5);
  const Grid<CellState> states = testing::RandomStates(40, 50, 0.15, rng);
  GasMap map{PublishedGasOptions()};
  std::vector<CellInput> cells(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    cells[i].active = states[i] == CellState::kFree;
    if (!cells[i].active || rng.Below(20) != 0) continue;
    const double concentration_ppm = rng.Uniform(0.0, kLargest_ppm);
    map.Add(0, states.geometry().Center(states.geometry().CellAtIndex(i)), {concentration_ppm});
    cells[i].precision = PublishedGasOptions().observation_precision_per_ppm2;
    cells[i].weighted_deviation = cells[i].precision * concentration_ppm;
  }
  ASSERT_TRUE(map.Refresh(states, 0).ok());
  const testing::DenseTruth dense(40, cells, PublishedGasOptions());
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!cells[i].active) continue;
    const Eigen::Index row = dense.variable(i);
    EXPECT_NEAR(map.variance_ppm2()[i] / dense.covariance()(row, row), 1.0, kFloat);
    EXPECT_NEAR(map.mean_ppm()[i], dense.mean_ppm()(row), kFloat * kLargest_ppm);
  }
}

// Two cells apart from each other and from everything.
TEST(GasMapTest, NeitherClampsMeansNorCapsVariances) {
  const Grid<CellState> states = GridFromArt({".#.#."});
  const GasMap map = MapOf({{0, {0.05, 0.05}, {5e5}}, {0, {0.25, 0.05}, {-3.0}}}, states, 0);
  const GasOptions options = PublishedGasOptions();
  const double precision =
      options.observation_precision_per_ppm2 + options.background_precision_per_ppm2;
  const double share = options.observation_precision_per_ppm2 / precision;
  EXPECT_FLOAT_EQ(At(map.mean_ppm(), 0, 0), static_cast<float>(5e5 * share));
  EXPECT_FLOAT_EQ(At(map.mean_ppm(), 2, 0), static_cast<float>(-3.0 * share));
  EXPECT_FLOAT_EQ(At(map.variance_ppm2(), 0, 0), static_cast<float>(1.0 / precision));
  EXPECT_EQ(At(map.mean_ppm(), 4, 0), 0.0F);
  EXPECT_FLOAT_EQ(At(map.variance_ppm2(), 4, 0),
                  static_cast<float>(1.0 / options.background_precision_per_ppm2));
}

TEST(GasMapTest, IsNanOffTheFreeCells) {
  const GridArt art = {".#?"};
  const GasMap map = MapOf({}, GridFromArt(art), 0);
  EXPECT_TRUE(std::isfinite(At(map.variance_ppm2(), 0, 0)));
  for (const Cell cell : {Cell{1, 0}, Cell{2, 0}}) {
    EXPECT_TRUE(std::isnan(map.mean_ppm()[cell]));
    EXPECT_TRUE(std::isnan(map.variance_ppm2()[cell]));
  }
}

TEST(GasMapTest, AReadingDoesNotCrossAWall) {
  const GridArt art = {"..#..", "..#..", "..#.."};
  const Grid<CellState> states = GridFromArt(art);
  const GasMap without = MapOf({}, states, 0);
  const GasMap with = MapOf({{0, {0.05, 0.15}, {30.0}}}, states, 0);
  for (int y = 0; y < 3; ++y) {
    EXPECT_GT(At(with.mean_ppm(), 1, y), 1.0F);
    EXPECT_LT(At(with.variance_ppm2(), 1, y), At(without.variance_ppm2(), 1, y));
    for (const int x : {3, 4}) {
      EXPECT_EQ(At(with.mean_ppm(), x, y), 0.0F);
      EXPECT_EQ(At(with.variance_ppm2(), x, y), At(without.variance_ppm2(), x, y));
    }
  }
}

TEST(GasMapTest, AReadingGoesThroughADoor) {
  const Grid<CellState> states = GridFromArt({"..#..", ".....", "..#.."});
  EXPECT_GT(At(MapOf({{0, {0.05, 0.15}, {30.0}}}, states, 0).mean_ppm(), 4, 1), 1.0F);
}

TEST(GasMapTest, OldReadingsWeighLess) {
  GasOptions options = PublishedGasOptions();
  options.ageing_half_life_s = 60.0;
  const Grid<CellState> states = GridFromArt({"."});
  const GasMap map = MapOf({{0, {0.05, 0.05}, {20.0}}}, states, 180 * kSecond_ns, options);
  const double lambda = 1.0 / (1.0 / 10.0 + 180.0 / 600.0);
  const double total = lambda + options.background_precision_per_ppm2;
  EXPECT_FLOAT_EQ(At(map.variance_ppm2(), 0, 0), static_cast<float>(1.0 / total));
  EXPECT_FLOAT_EQ(At(map.mean_ppm(), 0, 0), static_cast<float>(20.0 * lambda / total));
}

TEST(GasMapTest, GivesTheSameBytesAgain) {
  Rng rng(2);
  const Grid<CellState> states = testing::RandomStates(30, 20, 0.25, rng);
  const std::vector<TimedReading> readings = RandomTimedReadings(states, 60, rng);
  const GasMap first = MapOf(readings, states, 0);
  const GasMap second = MapOf(readings, states, 0);
  EXPECT_TRUE(support::SameBytes(first.mean_ppm(), second.mean_ppm()));
  EXPECT_TRUE(support::SameBytes(first.variance_ppm2(), second.variance_ppm2()));
}

TEST(GasMapTest, IsTheSameHoweverOftenItWasRefreshedBefore) {
  Rng rng(3);
  const Grid<CellState> states = testing::RandomStates(20, 20, 0.25, rng);
  const std::vector<TimedReading> readings = RandomTimedReadings(states, 60, rng);
  for (const double half_life_s : {0.0, 30.0}) {
    GasOptions options = PublishedGasOptions();
    options.ageing_half_life_s = half_life_s;
    GasMap often(options);
    for (const TimedReading& r : readings) {
      often.Add(r.time_ns, r.position, r.reading);
      ASSERT_TRUE(often.Refresh(states, r.time_ns).ok());
    }
    Age(often, readings.back().time_ns);
    const GasMap once = MapOf(readings, states, readings.back().time_ns, options);
    ExpectSameWithinCertificate(often, once, half_life_s > 0.0 ? 2 * kBucketError : 0.0);
    EXPECT_EQ(once.counters(), often.counters());
  }
}

TEST(GasMapTest, DoesNotCareInWhichOrderReadingsArrive) {
  Rng rng(4);
  const Grid<CellState> states = testing::RandomStates(12, 12, 0.3, rng);
  std::vector<TimedReading> readings = RandomTimedReadings(states, 80, rng);
  const GasMap forward = MapOf(readings, states, 0);
  std::reverse(readings.begin(), readings.end());
  const GasMap backward = MapOf(readings, states, 0);
  EXPECT_EQ(forward.counters(), backward.counters());
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] != CellState::kFree) continue;
    EXPECT_FLOAT_EQ(forward.mean_ppm()[i], backward.mean_ppm()[i]);
    EXPECT_FLOAT_EQ(forward.variance_ppm2()[i], backward.variance_ppm2()[i]);
  }
}

TEST(GasMapTest, CountsMovedAndWaitingReadings) {
  const Grid<CellState> states = GridFromArt({".#??"});
  const GasMap map = MapOf(
      {{0, {0.05, 0.05}, {1.0}}, {0, {0.15, 0.05}, {1.0}}, {0, {0.35, 0.05}, {1.0}}}, states, 0);
  EXPECT_EQ(map.counters(),
            (GasCounters{.readings = 3, .in_posterior = 2, .moved_to_neighbour = 1, .waiting = 1}));
}

TEST(GasMapTest, CountsEachReadingBeforeTheNextRefresh) {
  GasMap map{PublishedGasOptions()};
  EXPECT_FALSE(map.stale());
  map.Add(0, {0.05, 0.05}, {1.0});
  EXPECT_TRUE(map.stale());
  EXPECT_EQ(map.counters(), (GasCounters{.readings = 1, .waiting = 1}));
  ASSERT_TRUE(map.Refresh(GridFromArt({"."}), 0).ok());
  EXPECT_FALSE(map.stale());
  EXPECT_EQ(map.counters(), (GasCounters{.readings = 1, .in_posterior = 1}));
}

TEST(GasMapTest, ReturnsToTheSamePosteriorWhenACellComesBack) {
  const Grid<CellState> open = GridFromArt({"....", "....", "...."});
  const Grid<CellState> blocked = GridFromArt({"###.", "###.", "###."});
  GasMap map = MapOf({{0, {0.05, 0.15}, {25.0}}}, open, 0);
  ASSERT_TRUE(map.Refresh(blocked, 0).ok());
  EXPECT_EQ(map.counters().waiting, 1);
  EXPECT_EQ(At(map.mean_ppm(), 3, 1), 0.0F);
  ASSERT_TRUE(map.Refresh(open, 0).ok());
  EXPECT_EQ(map.counters().in_posterior, 1);
  ExpectSameWithinCertificate(map, MapOf({{0, {0.05, 0.15}, {25.0}}}, open, 0));
}

TEST(GasMapTest, TakesInWaitingReadingsWhenTheMapReachesThem) {
  GasMap map = MapOf({{0, {0.75, 0.05}, {25.0}}}, GridFromArt({"..??"}), 0);
  EXPECT_EQ(map.counters().waiting, 1);
  const Grid<CellState> grown = GridFromArt({"........"});
  ASSERT_TRUE(map.Refresh(grown, 0).ok());
  ExpectSameWithinCertificate(map, MapOf({{0, {0.75, 0.05}, {25.0}}}, grown, 0));
}

// Each way alone, and far enough to outgrow the lattice, with one reading on each side of the
// anchor.
TEST(GasMapTest, KeepsReadingsWhenItGrowsInAnyDirection) {
  const std::vector<TimedReading> readings = {{0, {0.05, 0.05}, {25.0}}, {0, {0.35, 0.15}, {5.0}}};
  GridGeometry start = GridFromArt({"....", "...."}).geometry();
  for (const int cells : {3, 50}) {
    for (const Cell way : {Cell{-1, 0}, Cell{1, 0}, Cell{0, -1}, Cell{0, 1}, Cell{-1, -1}}) {
      GasMap map = MapOf(readings, Grid<CellState>(start, CellState::kFree), 0);
      GridGeometry grown = start;
      grown.origin_x_m += std::min(way.x, 0) * cells * grown.resolution_m;
      grown.origin_y_m += std::min(way.y, 0) * cells * grown.resolution_m;
      grown.width += std::abs(way.x) * cells;
      grown.height += std::abs(way.y) * cells;
      const Grid<CellState> states(grown, CellState::kFree);
      ASSERT_TRUE(map.Refresh(states, 0).ok());
      EXPECT_EQ(map.counters(), (GasCounters{.readings = 2, .in_posterior = 2}));
      ExpectSameWithinCertificate(map, MapOf(readings, states, 0));
    }
  }
}

TEST(GasMapTest, SurvivesTheLossOfEveryFreeCell) {
  const std::vector<TimedReading> readings = {{0, {0.05, 0.05}, {5.0}}};
  const Grid<CellState> states = GridFromArt({"..", ".."});
  GasMap map = MapOf(readings, states, 0);
  ASSERT_TRUE(map.Refresh(GridFromArt({"##", "??"}), 0).ok());
  EXPECT_EQ(map.counters(), (GasCounters{.readings = 1, .waiting = 1}));
  EXPECT_TRUE(std::isnan(At(map.mean_ppm(), 0, 0)));
  ASSERT_TRUE(map.BeginEpoch(0).ok());
  ASSERT_TRUE(map.Adopt().ok());
  ASSERT_TRUE(map.Refresh(states, 0).ok());
  ExpectSameWithinCertificate(map, MapOf(readings, states, 0));
}

TEST(GasMapTest, WorksWithoutCellsAndWithoutFreeCells) {
  GasMap map{PublishedGasOptions()};
  map.Add(0, {0.05, 0.05}, {5.0});
  ASSERT_TRUE(map.Refresh(Grid<CellState>(), 0).ok());
  EXPECT_EQ(map.mean_ppm().size(), 0U);
  ASSERT_TRUE(map.Refresh(GridFromArt({"?"}), 0).ok());
  EXPECT_TRUE(std::isnan(At(map.mean_ppm(), 0, 0)));
  EXPECT_EQ(map.counters().waiting, 1);
}

TEST(GasMapTest, KeepsTheOldPosteriorWhenTheLatticeDoesNotMatch) {
  GasMap map = MapOf({{0, {0.05, 0.05}, {5.0}}}, GridFromArt({"."}), 0);
  const Grid<float> before = map.mean_ppm();
  EXPECT_EQ(map.Refresh(GridFromArt({".."}, 0.2), 0).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_TRUE(support::SameBytes(map.mean_ppm(), before));
  EXPECT_EQ(map.counters().in_posterior, 1);
}

bool ShowsNothing(const GasMap& map) {
  const auto is_nan = [](float value) { return std::isnan(value); };
  return std::all_of(map.mean_ppm().values().begin(), map.mean_ppm().values().end(), is_nan) &&
         std::all_of(map.variance_ppm2().values().begin(), map.variance_ppm2().values().end(),
                     is_nan) &&
         map.what_if() == nullptr;
}

TEST(GasMapTest, ShowsNoFieldThatCannotBeComputed) {
  const Grid<CellState> states = GridFromArt({"...", "..."});
  GasMap map{PublishedGasOptions()};
  GasMapPeer::LosePrior(map);
  map.Add(0, {0.05, 0.05}, {5.0});
  if (GasMapPeer::kStopsAtDefects) {
    EXPECT_DEATH(map.Refresh(states, 0).IgnoreError(), GasMapPeer::kDefect);
    return;
  }
  EXPECT_EQ(map.Refresh(states, 0).code(), absl::StatusCode::kInternal);
  EXPECT_TRUE(ShowsNothing(map));
  EXPECT_TRUE(map.stale());
  EXPECT_EQ(map.counters().in_posterior, 1);
  EXPECT_EQ(map.quality().failures, 1);
  EXPECT_FALSE(map.epoch_due(0));
  EXPECT_TRUE(absl::IsFailedPrecondition(map.BeginEpoch(0)));

  GasMapPeer::FindPrior(map);
  ASSERT_TRUE(map.Refresh(states, 0).ok());
  EXPECT_FALSE(map.stale());
  ExpectSameWithinCertificate(map, MapOf({{0, {0.05, 0.05}, {5.0}}}, states, 0));
}

TEST(GasMapTest, ShowsNoFieldAfterAnEpochThatCannotBeComputed) {
  const Grid<CellState> states = GridFromArt({"...", "..."});
  const std::vector<TimedReading> readings = {{0, {0.05, 0.05}, {5.0}}};
  GasMap map = MapOf(readings, states, 0);
  GasMapPeer::LosePrior(map);
  ASSERT_TRUE(map.BeginEpoch(0).ok());
  if (GasMapPeer::kStopsAtDefects) {
    EXPECT_DEATH(map.Adopt().IgnoreError(), GasMapPeer::kDefect);
    return;
  }
  EXPECT_EQ(map.Adopt().code(), absl::StatusCode::kInternal);
  EXPECT_TRUE(ShowsNothing(map));
  EXPECT_TRUE(map.stale());
  EXPECT_EQ(map.epoch(), nullptr);
  EXPECT_EQ(map.quality().failures, 1);
  EXPECT_EQ(map.quality().epochs, 0);

  GasMapPeer::FindPrior(map);
  ASSERT_TRUE(map.Refresh(states, 0).ok());
  ExpectSameWithinCertificate(map, MapOf(readings, states, 0));
}

TEST(GasMapTest, NoPrecisionIsTooExtreme) {
  GasOptions options = PublishedGasOptions();
  options.prior_precision_per_ppm2 = 1e9;
  options.background_precision_per_ppm2 = 1e-9;  // 1e9 + 1e-9 rounds to 1e9
  GasMap map = MapOf({}, GridFromArt({".#"}), 0, options);
  ASSERT_TRUE(map.Refresh(GridFromArt({".."}), 0).ok());
  EXPECT_FLOAT_EQ(At(map.variance_ppm2(), 0, 0), 0.5e9F);
  EXPECT_FLOAT_EQ(At(map.variance_ppm2(), 1, 0), 0.5e9F);
}

TEST(GasMapTest, IsNotPoisonedByReadingsThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const GasMap map =
      MapOf({{0, {0.05, 0.05}, {nan}}, {0, {nan, nan}, {1.0}}}, GridFromArt({".."}), 0);
  EXPECT_EQ(At(map.mean_ppm(), 0, 0), 0.0F);
  EXPECT_EQ(map.counters().waiting, 2);
}

}  // namespace gas_map_test
}  // namespace plumescout
