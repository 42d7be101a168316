// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Fields of which all readings are replaced.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "core/gas/gas_map.h"
#include "core/types/rng.h"
#include "tests/core/gas/timed_readings.h"
#include "tests/support/grid_art.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace gas_map_replace_test {

using ::plumescout::testing::GridArt;
using ::plumescout::testing::GridFromArt;
using ::plumescout::testing::kSecond_ns;
using ::plumescout::testing::RandomTimedReadings;
using ::plumescout::testing::TimedReading;

TEST(GasMapReplaceTest, OtherReadingsMakeTheFieldAnew) {
  Rng rng(11);
  const Grid<CellState> states = GridFromArt(GridArt{{"......", "......", "......"}, {}});
  const double resolution_m = states.geometry().resolution_m;
  const std::vector<TimedReading> wrong = RandomTimedReadings(states, 20, rng);
  const std::vector<TimedReading> right = RandomTimedReadings(states, 15, rng);
  GasMap gas(GasOptions(), resolution_m);
  for (const TimedReading& r : wrong) gas.Add(r.time_ns, r.position, r.reading);
  ASSERT_TRUE(gas.Refresh(states, kSecond_ns).ok());
  ASSERT_TRUE(gas.BeginEpoch(kSecond_ns).ok());
  ReadingStore store(GasOptions(), resolution_m);
  for (const TimedReading& r : right) store.Add(r.time_ns, r.position, r.reading);
  gas.ReplaceReadings(std::move(store), SensorOffsets(GasOptions(), 0.0));
  EXPECT_TRUE(gas.replaced());
  EXPECT_TRUE(gas.stale());
  EXPECT_EQ(gas.epoch(), nullptr);
  EXPECT_EQ(gas.what_if(), nullptr);
  ASSERT_TRUE(gas.Refresh(states, kSecond_ns).ok());
  EXPECT_FALSE(gas.replaced());
  GasMap expected(GasOptions(), resolution_m);
  for (const TimedReading& r : right) expected.Add(r.time_ns, r.position, r.reading);
  ASSERT_TRUE(expected.Refresh(states, kSecond_ns).ok());
  EXPECT_TRUE(support::SameBytes(gas.mean_ppm(), expected.mean_ppm()));
  EXPECT_TRUE(support::SameBytes(gas.variance_ppm2(), expected.variance_ppm2()));
  EXPECT_EQ(gas.counters(), expected.counters());
}

TEST(GasMapReplaceTest, NothingIsLeftOfAFieldThatSomebodySaw) {
  Rng rng(12);
  const Grid<CellState> states = GridFromArt(GridArt{{"......", "......", "......"}, {}});
  const std::vector<TimedReading> readings = RandomTimedReadings(states, 20, rng);
  GasMap seen{GasOptions()};
  GasMap unseen{GasOptions()};
  for (GasMap* const gas : {&seen, &unseen}) {
    for (const TimedReading& r : readings) gas->Add(r.time_ns, r.position, r.reading);
    ASSERT_TRUE(gas->Refresh(states, kSecond_ns).ok());
    if (gas == &seen) gas->quality();
    gas->ReplaceReadings(ReadingStore(GasOptions(), 0.0), SensorOffsets(GasOptions(), 0.0));
  }
  EXPECT_EQ(seen.quality(), unseen.quality());
}

}  // namespace gas_map_replace_test
}  // namespace plumescout
