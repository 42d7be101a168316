// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Readings that wait, and come faster than anybody places them.
#include <gtest/gtest.h>

#include <vector>

#include "core/gas/reading_store.h"
#include "core/types/rng.h"

namespace plumescout {
namespace reading_store_waiting_test {

constexpr double kResolution_m = 0.1;
constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr int kMany = static_cast<int>(3 * ReadingStore::kMostArrivals);

Grid<CellState> Ground() {
  return Grid<CellState>(
      GridGeometry{-64 * kResolution_m, 64 * kResolution_m, kResolution_m, 64, 64},
      CellState::kFree);
}

struct Taken {
  Point2 place;
  double concentration_ppm;
};

// In few cells, some of them at the edge of the ground.
std::vector<Taken> Readings(int count, Rng& rng) {
  std::vector<Taken> readings;
  for (int k = 0; k < count; ++k) {
    readings.push_back({{rng.Uniform(-0.5, 0.2), rng.Uniform(8.0, 8.5)}, rng.Uniform(0.0, 9.0)});
  }
  return readings;
}

TEST(ReadingStoreWaitingTest, ManyOfFewCellsAreMergedBeforeTheFirstMap) {
  Rng rng(1);
  ReadingStore store(PublishedGasOptions(), kResolution_m);
  for (const Taken& taken : Readings(kMany, rng))
    store.Add(0, taken.place, {taken.concentration_ppm});
  EXPECT_LE(store.arrivals(), ReadingStore::kMostArrivals + 8 * 6 * kSitesPerCell);
  EXPECT_EQ(store.counters().waiting, kMany);
}

// Merged or not, they say the same wherever they come to lie.
TEST(ReadingStoreWaitingTest, MergedReadingsSayWhatAllSay) {
  for (const double half_life_s : {0.0, 5.0}) {
    Rng rng(2);
    GasOptions options = PublishedGasOptions();
    options.ageing_half_life_s = half_life_s;
    ReadingStore merged(options, kResolution_m);
    ReadingStore single(options);  // cannot merge before the first map
    const std::vector<Taken> readings = Readings(kMany, rng);
    for (int k = 0; k < kMany; ++k) {
      const auto& [place, concentration_ppm] = readings[static_cast<std::size_t>(k)];
      merged.Add(k * kMillisecond_ns, place, {concentration_ppm});
      single.Add(k * kMillisecond_ns, place, {concentration_ppm});
    }
    EXPECT_LT(merged.arrivals(), single.arrivals());
    ASSERT_TRUE(merged.Place(Ground(), {}).ok());
    ASSERT_TRUE(single.Place(Ground(), {}).ok());
    merged.AgeTo(kMany * kMillisecond_ns);
    single.AgeTo(kMany * kMillisecond_ns);
    EXPECT_EQ(merged.counters(), single.counters());
    EXPECT_GT(merged.counters().moved_to_neighbour, 0);
    const auto all = single.AllEvidence();
    const auto some = merged.AllEvidence();
    ASSERT_EQ(some.size(), all.size());
    const double tolerance = half_life_s == 0.0 ? 1e-12 : kBucketError;
    for (std::size_t i = 0; i < all.size(); ++i) {
      ASSERT_EQ(some[i].cell, all[i].cell);
      EXPECT_NEAR(some[i].evidence.precision / all[i].evidence.precision, 1.0, tolerance);
      EXPECT_NEAR(some[i].evidence.weighted_deviation / all[i].evidence.weighted_deviation, 1.0,
                  2.0 * tolerance);
    }
  }
}

TEST(ReadingStoreWaitingTest, BucketsOfOneCellAreBoundedWhileSampleTimeStandsStill) {
  GasOptions options = PublishedGasOptions();
  options.ageing_half_life_s = 5.0;
  ReadingStore store(options, kResolution_m);
  ASSERT_TRUE(store.Place(Ground(), {}).ok());
  for (int round = 0; round < 5; ++round) {
    for (int k = 0; k < kMany; ++k) {
      store.Add(0, {-1.05, 8.05}, {1.0});  // free
      store.Add(0, {50.05, 8.05}, {1.0});  // unknown
    }
    ASSERT_TRUE(store.Place(Ground(), {}).ok());
    EXPECT_LT(store.buckets(), 2U * 4096U);
  }
  EXPECT_EQ(store.counters().in_posterior, 5 * kMany);
  EXPECT_EQ(store.counters().waiting, 5 * kMany);
}

TEST(ReadingStoreWaitingTest, PlacesThatWaitAreBounded) {
  Rng rng(3);
  ReadingStore store(PublishedGasOptions(), kResolution_m);
  std::size_t taken = 0;
  Point2 first;
  for (std::size_t k = 0; k < ReadingStore::kMostWaitingSites + 5000; ++k) {
    const Point2 place{rng.Uniform(-1000.0, 1000.0), rng.Uniform(-1000.0, 1000.0)};
    if (k == 0) first = place;
    if (!store.HasRoomFor(place)) continue;
    store.Add(0, place, {1.0});
    ++taken;
  }
  EXPECT_LE(taken, ReadingStore::kMostWaitingSites + 100);
  EXPECT_LE(store.arrivals(), ReadingStore::kMostWaitingSites);
  EXPECT_TRUE(store.HasRoomFor(first)) << "it is merged";
  // With a map the few that lie on it wait no more.
  ASSERT_TRUE(store.Place(Ground(), {}).ok());
  EXPECT_EQ(store.counters().readings, static_cast<std::int64_t>(taken));
  EXPECT_LE(store.sites(), ReadingStore::kMostWaitingSites);
}

}  // namespace reading_store_waiting_test
}  // namespace plumescout
