// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Readings that are placed anew, on another map.
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "core/gas/reading_store.h"
#include "core/types/rng.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace reading_store_unplaced_test {

using ::plumescout::testing::GridArt;
using ::plumescout::testing::GridFromArt;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

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

TEST(ReadingStoreUnplacedTest, UnplacedReadingsCanBePlacedElsewhere) {
  for (const double half_life_s : {0.0, 300.0}) {
    const Grid<CellState> states = GridFromArt(GridArt{{"....", "....", "...."}, {}});
    const double resolution_m = states.geometry().resolution_m;
    ReadingStore store(Options(half_life_s), resolution_m);
    ReadingStore fresh(Options(half_life_s), resolution_m);
    Rng rng(5);
    for (int i = 0; i < 40; ++i) {
      const Point2 place{rng.Uniform(0.0, 4.0) * resolution_m,
                         rng.Uniform(0.0, 3.0) * resolution_m};
      const GasReading reading{rng.Uniform(0.0, 9.0), 0.0};
      store.Add(i * kSecond_ns, place, reading);
      fresh.Add(i * kSecond_ns, place, reading);
      if (i == 20) {
        ASSERT_TRUE(PlaceAll(store, states).ok());
      }
    }
    ReadingStore again = store.Unplaced();
    EXPECT_EQ(again.counters(), (GasCounters{.readings = 40, .waiting = 40}));
    EXPECT_EQ(again.arrival_buckets(), half_life_s > 0.0 ? 21u : 0u) << "of those placed before";
    ASSERT_TRUE(PlaceAll(again, states).ok());
    EXPECT_EQ(again.arrival_buckets(), 0u);
    ASSERT_TRUE(PlaceAll(fresh, states).ok());
    EXPECT_EQ(again.counters(), fresh.counters());
    const auto evidence = again.AllEvidence();
    const auto expected = fresh.AllEvidence();
    ASSERT_EQ(evidence.size(), expected.size());
    for (std::size_t i = 0; i < evidence.size(); ++i) {
      EXPECT_EQ(evidence[i].cell, expected[i].cell);
      EXPECT_NEAR(evidence[i].evidence.precision, expected[i].evidence.precision, 1e-6);
    }
  }
}

}  // namespace reading_store_unplaced_test
}  // namespace plumescout
