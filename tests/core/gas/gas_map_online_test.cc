// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// A gas map over time: growth, epochs, ageing, coarser lattices.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/gas_map.h"
#include "tests/core/gas/dense_field.h"
#include "tests/core/gas/gas_map_peer.h"
#include "tests/support/grid_art.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace gas_map_online_test {

using ::plumescout::testing::DenseField;
using ::plumescout::testing::DenseReading;
using ::plumescout::testing::GridFromArt;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kObservationPrecision = 10.0;

// A building that is discovered little by little, and the readings taken in it.
class Discovery {
 public:
  explicit Discovery(std::uint64_t seed) : rng_(seed) {
    building_ = testing::RandomStates(kSide, kSide, 0.2, rng_);
    GridGeometry geometry = building_.geometry();
    geometry.width = geometry.height = 8;
    geometry.origin_x_m = geometry.origin_y_m = 1.0;
    known_ = Grid<CellState>(geometry, CellState::kUnknown);
  }

  const Grid<CellState>& known() const { return known_; }
  const std::vector<DenseReading>& readings() const { return readings_; }

  void Grow() {
    GridGeometry geometry = known_.geometry();
    const int side = static_cast<int>(rng_.Below(4));
    const int left = side == 0 && Corner(known_, 0).x > 1 ? 2 : 0;
    const int down = side == 1 && Corner(known_, 0).y > 1 ? 2 : 0;
    geometry.origin_x_m -= left * geometry.resolution_m;
    geometry.origin_y_m -= down * geometry.resolution_m;
    const Cell end = Corner(known_, known_.size() - 1);
    geometry.width += left + (side == 2 && end.x + 2 < kSide ? 2 : 0);
    geometry.height += down + (side == 3 && end.y + 2 < kSide ? 2 : 0);
    Grid<CellState> grown(geometry, CellState::kUnknown);
    for (std::size_t i = 0; i < known_.size(); ++i) {
      const Cell cell = known_.geometry().CellAtIndex(i);
      grown[Cell{cell.x + left, cell.y + down}] = known_[i];
    }
    known_ = grown;
  }
  void LookAround() {
    for (int k = 0; k < 12; ++k) {
      const std::size_t i = rng_.Below(known_.size());
      // Now and then a sensor sees what is not there.
      known_[i] = rng_.Below(20) == 0 ? CellState::kOccupied : building_[Corner(known_, i)];
    }
  }
  void Read(GasMap& map, std::int64_t time_ns) {
    const std::size_t i = rng_.Below(known_.size());
    if (known_[i] != CellState::kFree) return;
    const Cell cell = known_.geometry().CellAtIndex(i);
    const double concentration_ppm = rng_.Uniform(0.0, 40.0);
    map.Add(time_ns, known_.geometry().Center(cell), {concentration_ppm});
    readings_.push_back({Corner(known_, i), kObservationPrecision, concentration_ppm});
    times_ns_.push_back(time_ns);
  }

  // The exact field now, precisions as of `aged_to_ns`. Readings in cells that are not free are
  // left out; REQUIRES: no free cell next to those, else they would move.
  DenseField Exact(const GasOptions& options, std::int64_t aged_to_ns) const {
    std::vector<DenseReading> here = readings_;
    const Cell corner = Corner(known_, 0);
    for (std::size_t k = 0; k < here.size(); ++k) {
      here[k].cell = {here[k].cell.x - corner.x, here[k].cell.y - corner.y};
      if (options.ageing_half_life_s == 0.0) continue;
      const double age_s =
          std::max(0.0, static_cast<double>(aged_to_ns - times_ns_[k]) / kSecond_ns);
      here[k].precision /= 1.0 + age_s / options.ageing_half_life_s;
    }
    return DenseField(known_, here, options);
  }
  // Puts the truth back where readings were taken, so that none waits or moves.
  void FreeWhatWasRead() {
    const Cell corner = Corner(known_, 0);
    for (const DenseReading& r : readings_) {
      known_[Cell{r.cell.x - corner.x, r.cell.y - corner.y}] = CellState::kFree;
    }
  }

 private:
  static constexpr int kSide = 24;

  // Place of a cell of `grid` in the building.
  static Cell Corner(const Grid<CellState>& grid, std::size_t index) {
    GridGeometry building;
    building.width = building.height = kSide;
    return building.CellAt(grid.geometry().Center(grid.geometry().CellAtIndex(index)));
  }

  Rng rng_;
  Grid<CellState> building_;
  Grid<CellState> known_;
  std::vector<DenseReading> readings_;  // by place in the building
  std::vector<std::int64_t> times_ns_;
};

// `merged` is what merging readings of like age may add, as share.
void ExpectCertified(const GasMap& map, const DenseField& exact, double merged = 0.0) {
  constexpr double kFloat = 1e-7;
  const double largest_ppm = exact.mean_ppm().cwiseAbs().maxCoeff();
  for (std::size_t k = 0; k < exact.cells().size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const double mean_ppm = exact.mean_ppm()(row);
    const double variance_ppm2 = exact.variance_ppm2()(row);
    ASSERT_NEAR(map.mean_ppm()[exact.cells()[k]], mean_ppm,
                map.quality().mean_error_ppm + (kFloat + merged) * largest_ppm);
    ASSERT_NEAR(map.variance_ppm2()[exact.cells()[k]], variance_ppm2,
                (map.quality().variance_error_ratio + kFloat + merged) * variance_ppm2);
  }
}

// One step of a mission: map and readings change, epochs come and go as they are due.
void Step(Discovery& discovery, GasMap& map, std::int64_t time_ns) {
  if (time_ns % (3 * kSecond_ns) == 0) discovery.Grow();
  discovery.LookAround();
  discovery.Read(map, time_ns);
  discovery.FreeWhatWasRead();
  if (map.adoption_due(time_ns)) {
    ASSERT_TRUE(map.Adopt().ok());
  }
  ASSERT_TRUE(map.Refresh(discovery.known(), time_ns).ok());
  if (map.epoch_due(time_ns)) {
    ASSERT_TRUE(map.BeginEpoch(time_ns).ok());
  }
}

TEST(GasMapOnlineTest, StaysWithinItsCertificateWhileTheMapGrows) {
  Discovery discovery(1);
  const GasOptions options = PublishedGasOptions();
  GasMap map(options);
  for (int step = 0; step < 120; ++step) {
    Step(discovery, map, step * kSecond_ns / 2);
    if (step % 10 == 9) ExpectCertified(map, discovery.Exact(options, 0));
  }
  EXPECT_GT(map.quality().epochs, 3);
  EXPECT_LE(map.quality().mean_error_ppm, 1e-5 * 40.0);
  EXPECT_LE(map.quality().variance_error_ratio, 1e-5);
  EXPECT_LE(map.quality().drift_mean_ppm, 1e-5 * 40.0);
  EXPECT_LE(map.quality().drift_variance_ratio, 1e-5);
  EXPECT_EQ(map.quality().healed, 0);
  EXPECT_EQ(map.quality().refreshes, 120);
}

TEST(GasMapOnlineTest, AgesReadingsInEpochs) {
  constexpr double kMerged = 2 * kBucketError;

  Discovery discovery(2);
  GasOptions options = PublishedGasOptions();
  options.ageing_half_life_s = 120.0;
  GasMap map(options);
  for (int step = 0; step < 60; ++step) {
    const std::int64_t time_ns = step * kSecond_ns / 2;
    Step(discovery, map, time_ns);
    // Begun one second before it is adopted; the next one follows at once.
    if (step > 10) {
      EXPECT_LE(map.quality().ageing_error_ratio, 2.5 / 120.0);
    }
    EXPECT_GE(map.quality().aged_to_ns, time_ns - 5 * kSecond_ns / 2);
    if (step % 10 == 9) {
      ExpectCertified(map, discovery.Exact(options, map.quality().aged_to_ns), kMerged);
    }
  }
  EXPECT_GT(map.quality().epochs, 10);
}

TEST(GasMapOnlineTest, AgesAllAtOnceWhenItIsFarBehind) {
  GasOptions options = PublishedGasOptions();
  options.ageing_half_life_s = 60.0;
  GasMap map(options);
  const Grid<CellState> states = GridFromArt({"."});
  map.Add(0, {0.05, 0.05}, {20.0});
  ASSERT_TRUE(map.Refresh(states, 0).ok());
  ASSERT_TRUE(map.BeginEpoch(0).ok());
  ASSERT_TRUE(map.Refresh(states, 180 * kSecond_ns).ok());
  const double precision = kObservationPrecision / 4.0 + options.background_precision_per_ppm2;
  EXPECT_FLOAT_EQ(map.variance_ppm2()[0], static_cast<float>(1.0 / precision));
  EXPECT_EQ(map.quality().ageing_error_ratio, 0.0);
  ASSERT_TRUE(map.Adopt().ok());
  EXPECT_FLOAT_EQ(map.variance_ppm2()[0], static_cast<float>(1.0 / precision))
      << "an epoch that began earlier does not bring the old precisions back";
}

// A precise sensor, a standard deviation of 0.03 ppm, among others: a reading loses half its
// precision in a second. Neither does the field have to be made anew at once, nor do epochs cease.
TEST(GasMapOnlineTest, APreciseReadingLeavesAgeingToEpochs) {
  constexpr double kVariance_ppm2 = 0.03 * 0.03;
  constexpr double kHalfLife_s = 120.0;
  GasOptions options = PublishedGasOptions();
  options.ageing_half_life_s = kHalfLife_s;
  GasMap map(options);
  const Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, 12, 10}, CellState::kFree);
  struct Taken {
    double time_s;
    double variance_ppm2;
    DenseReading reading;
  };
  std::vector<Taken> taken;
  int made_at_once = 0;
  for (int step = 0; step < 80; ++step) {
    const std::int64_t time_ns = step * kSecond_ns / 2;
    const Cell cell{step % 12, step * 7 % 10};
    const bool precise = step < 8 || step % 16 == 0;
    const GasReading reading{5.0 + step, precise ? kVariance_ppm2 : 0.0};
    map.Add(time_ns, states.geometry().Center(cell), reading);
    taken.push_back({0.5 * step,
                     precise ? kVariance_ppm2 : 1.0 / kObservationPrecision,
                     {cell, 0.0, reading.concentration_ppm}});
    if (map.adoption_due(time_ns)) {
      ASSERT_TRUE(map.Adopt().ok());
    }
    const void* const engine = GasMapPeer::EngineOf(map);
    ASSERT_TRUE(map.Refresh(states, time_ns).ok());
    if (GasMapPeer::EngineOf(map) != engine) ++made_at_once;
    EXPECT_LE(map.quality().ageing_error_ratio, 0.1);
    if (map.epoch_due(time_ns)) {
      ASSERT_TRUE(map.BeginEpoch(time_ns).ok());
    }
    // All ageing but what the figure allows for is in the variances.
    std::vector<DenseReading> now;
    for (const Taken& t : taken) {
      const double growth_ppm2 = (0.5 * step - t.time_s) / kHalfLife_s / kObservationPrecision;
      now.push_back(t.reading);
      now.back().precision = 1.0 / (t.variance_ppm2 + growth_ppm2);
    }
    const DenseField exact(states, now, options);
    for (std::size_t k = 0; k < exact.cells().size(); ++k) {
      const double variance_ppm2 = exact.variance_ppm2()(static_cast<Eigen::Index>(k));
      ASSERT_LE(map.variance_ppm2()[exact.cells()[k]], 1.002 * variance_ppm2);
      ASSERT_GE(map.variance_ppm2()[exact.cells()[k]] * (1.002 + map.quality().ageing_error_ratio),
                variance_ppm2);
    }
  }
  EXPECT_EQ(made_at_once, 1) << "when there was no field yet";
  EXPECT_GT(map.quality().epochs, 10);
}

TEST(GasMapOnlineTest, GivesTheSameBytesWhereverAndWheneverAnEpochIsRecomputed) {
  for (const double half_life_s : {0.0, 120.0}) {
    GasOptions options = PublishedGasOptions();
    options.ageing_half_life_s = half_life_s;
    Discovery at_once_world(3), late_world(3);
    GasMap at_once(options), late(options);
    for (int step = 0; step < 60; ++step) {
      Step(at_once_world, at_once, step * kSecond_ns / 2);
      Step(late_world, late, step * kSecond_ns / 2);
      if (at_once.epoch() != nullptr) at_once.epoch()->Recompute();
      ASSERT_TRUE(support::SameBytes(at_once.mean_ppm(), late.mean_ppm()));
      ASSERT_TRUE(support::SameBytes(at_once.variance_ppm2(), late.variance_ppm2()));
      ASSERT_EQ(at_once.quality(), late.quality());
    }
  }
}

TEST(GasMapOnlineTest, AnEpochDoesNotForgetWhatCameMeanwhile) {
  GasMap map{PublishedGasOptions()};
  ASSERT_TRUE(map.Refresh(GridFromArt({"....", "...."}), 0).ok());
  ASSERT_TRUE(map.BeginEpoch(0).ok());
  const std::shared_ptr<GasEpoch> epoch = map.epoch();
  map.Add(0, {0.05, 0.05}, {20.0});
  const Grid<CellState> walled = GridFromArt({"..#.", "..#."});
  ASSERT_TRUE(map.Refresh(walled, 0).ok());
  epoch->Recompute();
  ASSERT_TRUE(map.Adopt().ok());
  EXPECT_EQ(map.epoch(), nullptr);
  EXPECT_EQ(map.quality().epochs, 1);
  ExpectCertified(map, DenseField(walled, {{{0, 0}, 10.0, 20.0}}, PublishedGasOptions()));
}

TEST(GasMapOnlineTest, AdoptsOnlyWhatWasBegun) {
  GasMap map{PublishedGasOptions()};
  EXPECT_FALSE(map.epoch_due(0));
  EXPECT_FALSE(map.adoption_due(1'000'000 * kSecond_ns));
  EXPECT_TRUE(absl::IsFailedPrecondition(map.Adopt()));
  EXPECT_TRUE(absl::IsFailedPrecondition(map.BeginEpoch(0)));
  ASSERT_TRUE(map.Refresh(GridFromArt({".."}), 0).ok());
  ASSERT_TRUE(map.BeginEpoch(5 * kSecond_ns).ok());
  EXPECT_TRUE(absl::IsFailedPrecondition(map.BeginEpoch(5 * kSecond_ns)));
  EXPECT_FALSE(map.epoch_due(100 * kSecond_ns)) << "one at a time";
  EXPECT_FALSE(map.adoption_due(6 * kSecond_ns - 1));
  EXPECT_TRUE(map.adoption_due(6 * kSecond_ns));
}

TEST(GasMapOnlineTest, OutgrownLatticeIsReplacedAtOnce) {
  GasMap map{PublishedGasOptions()};
  ASSERT_TRUE(map.Refresh(GridFromArt({"."}), 0).ok());
  map.Add(0, {0.05, 0.05}, {20.0});
  const Grid<CellState> hall = GridFromArt({std::string(120, '.'), std::string(120, '.')});
  ASSERT_TRUE(map.Refresh(hall, 0).ok());
  ExpectCertified(map, DenseField(hall, {{{0, 0}, 10.0, 20.0}}, PublishedGasOptions()));
}

// A chain of three gas cells of 2x2 in which a wall stands between the second and the third.
TEST(GasMapOnlineTest, CoarseLatticeHasNoLinkThroughAWall) {
  GasOptions options = PublishedGasOptions();
  options.lattice_factor = 2;
  GasMap map(options);
  map.Add(0, {0.05, 0.05}, {20.0});
  map.Add(0, {0.15, 0.15}, {10.0});
  ASSERT_TRUE(map.Refresh(GridFromArt({"....#.", "....#."}), 0).ok());
  const DenseField exact(GridFromArt({"..#."}), {{{0, 0}, 10.0, 20.0}, {{0, 0}, 10.0, 10.0}},
                         options);
  for (const auto& [coarse, fine] : {std::pair{0, 1}, {1, 3}, {2, 5}}) {
    EXPECT_FLOAT_EQ(map.mean_ppm()[(Cell{fine, 1})], static_cast<float>(exact.mean_ppm()(coarse)));
    EXPECT_FLOAT_EQ(map.variance_ppm2()[(Cell{fine, 0})],
                    static_cast<float>(exact.variance_ppm2()(coarse)));
  }
  EXPECT_TRUE(std::isnan(map.mean_ppm()[(Cell{4, 0})]));

  // A door opens.
  ASSERT_TRUE(map.Refresh(GridFromArt({"....#.", "......"}), 0).ok());
  EXPECT_GT(map.mean_ppm()[(Cell{5, 0})], 1.0F);
}

// A map of 5 x 4 cells, which then grows by one cell to the west and the south, is one of 2 x 2 gas
// cells of 3 x 3 that grows to 3 x 3 of them.
TEST(GasMapOnlineTest, GasCellsNeedNotDivideTheMap) {
  GasOptions options = PublishedGasOptions();
  options.lattice_factor = 3;
  GasMap map(options);
  map.Add(0, {0.45, 0.35}, {20.0});
  map.Add(0, {0.05, 0.05}, {10.0});
  map.Add(0, {-0.05, -0.05}, {30.0});
  Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, 5, 4}, CellState::kFree);
  ASSERT_TRUE(map.Refresh(states, 0).ok());
  // The third reading moves to the cell next to it, across the corner.
  const DenseField small(Grid<CellState>(GridGeometry{0.0, 0.0, 0.3, 2, 2}, CellState::kFree),
                         {{{1, 1}, 10.0, 20.0}, {{0, 0}, 10.0, 10.0}, {{0, 0}, 10.0, 30.0}},
                         options);
  const auto expect = [&map](const DenseField& exact, std::size_t gas_cell, Cell cell) {
    const auto row = static_cast<Eigen::Index>(gas_cell);
    EXPECT_FLOAT_EQ(map.mean_ppm()[cell], static_cast<float>(exact.mean_ppm()(row)));
    EXPECT_FLOAT_EQ(map.variance_ppm2()[cell], static_cast<float>(exact.variance_ppm2()(row)));
  };
  expect(small, 0, {2, 2});
  expect(small, 1, {3, 0});
  expect(small, 3, {4, 3});

  states = Grid<CellState>(GridGeometry{-0.1, -0.1, 0.1, 6, 5}, CellState::kFree);
  ASSERT_TRUE(map.Refresh(states, 0).ok());
  const DenseField grown(Grid<CellState>(GridGeometry{-0.3, -0.3, 0.3, 3, 3}, CellState::kFree),
                         {{{2, 2}, 10.0, 20.0}, {{1, 1}, 10.0, 10.0}, {{0, 0}, 10.0, 30.0}},
                         options);
  expect(grown, 0, {0, 0});
  expect(grown, 4, {1, 1});
  expect(grown, 8, {5, 4});
  EXPECT_EQ(map.counters(), (GasCounters{.readings = 3, .in_posterior = 3}));
}

// An epoch merges readings of like age, and what they say of errors changes with that.
TEST(GasMapOnlineTest, WhoLooksBeforeAnEpochChangesNothing) {
  GasOptions options;
  options.ageing_half_life_s = 10.0;
  GasMap seen(options, 0.5);
  GasMap unseen(options, 0.5);
  for (GasMap* const map : {&seen, &unseen}) {
    Rng rng(5);
    for (int i = 0; i < 200; ++i) {
      const Point2 place = {rng.Uniform(0.1, 4.9), rng.Uniform(0.1, 4.9)};
      map->Add(std::int64_t{50'000'000} * i, place, {rng.Uniform(0.0, 30.0), 0.0});
    }
    const Grid<CellState> states(GridGeometry{0.0, 0.0, 0.5, 10, 10}, CellState::kFree);
    ASSERT_TRUE(map->Refresh(states, 10'000'000'000).ok());
    if (map == &seen) map->quality();
    ASSERT_TRUE(map->BeginEpoch(100'000'000'000).ok());
  }
  EXPECT_EQ(seen.quality(), unseen.quality());
  EXPECT_TRUE(support::SameBytes(seen.error_variance_ppm2(), unseen.error_variance_ppm2()));
}

}  // namespace gas_map_online_test
}  // namespace plumescout
