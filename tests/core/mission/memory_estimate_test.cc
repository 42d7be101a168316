// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/memory_estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/gas/field_bytes.h"
#include "core/types/error_reason.h"

namespace plumescout {
namespace memory_estimate_test {

constexpr std::int64_t kMegabyte = 1'000'000;

MissionOptions Knowing(int side_cells, std::int64_t budget_bytes) {
  MissionOptions options;
  options.occupancy.max_extent_m = 2000.0;
  options.occupancy.max_cell_count = 16'000'000;
  options.memory_budget_bytes = budget_bytes;
  options.prior_map = std::make_shared<const Grid<CellState>>(
      GridGeometry{0.0, 0.0, 0.1, side_cells, side_cells}, CellState::kFree);
  return options;
}

TEST(MemoryEstimateTest, FieldAndRestShareTheBudget) {
  MemoryUse use;
  const std::int64_t budget_bytes = 800 * kMegabyte;
  EXPECT_EQ(RoomForField_bytes(budget_bytes, use), 500 * kMegabyte);
  EXPECT_EQ(RoomBesideField_bytes(budget_bytes, use), 700 * kMegabyte - kMissionBytes);
  use.field_bytes = 500 * kMegabyte;
  EXPECT_EQ(RoomBesideField_bytes(budget_bytes, use), 300 * kMegabyte - kMissionBytes);
  use.field_bytes = 0;
  use.map_cells = 600 * kMegabyte / kMapCellBytes;
  EXPECT_EQ(RoomForField_bytes(budget_bytes, use),
            budget_bytes - kMissionBytes - kMapCellBytes * use.map_cells);
  use.reading_sites = 100;
  use.reading_buckets = 10;
  use.visited_tiles = 1;
  EXPECT_EQ(use.Total_bytes(), kMissionBytes + kMapCellBytes * use.map_cells +
                                   100 * kReadingSiteBytes + 10 * kReadingBucketBytes +
                                   kVisitedTileBytes);
}

TEST(MemoryEstimateTest, WithoutAKnownMapOptionsStayAsTheyAre) {
  MissionOptions options;
  options.memory_budget_bytes = 40 * kMegabyte;
  EXPECT_EQ(FitToBudget(options)->gas.lattice_factor, 1);
}

TEST(MemoryEstimateTest, ASmallMapKeepsTheFullLattice) {
  EXPECT_EQ(FitToBudget(Knowing(160, 512 * kMegabyte))->gas.lattice_factor, 1);
}

TEST(MemoryEstimateTest, TheLatticeIsAsCoarseAsTheBudgetDemands) {
  // Five eighths of which are what half the lattice takes, with its margins.
  const std::int64_t budget_bytes = (FieldBytes(250 * 250, 320 * 320) / 5 + 1) * 8;
  const MissionOptions options = Knowing(500, budget_bytes);
  ASSERT_TRUE(CountsAsVisited(options.prior_map->geometry(), options.gas));
  const auto fitted = FitToBudget(options);
  ASSERT_TRUE(fitted.ok()) << fitted.status();
  EXPECT_EQ(fitted->gas.lattice_factor, 2);
  EXPECT_EQ(FitToBudget(*fitted)->gas.lattice_factor, 2) << "and stays";
}

TEST(MemoryEstimateTest, OfALargeMapOnlyWhatARobotReachesCounts) {
  const MissionOptions options = Knowing(2900, 2000 * kMegabyte);
  EXPECT_FALSE(CountsAsVisited(options.prior_map->geometry(), options.gas));
  const auto fitted = FitToBudget(options);
  ASSERT_TRUE(fitted.ok()) << fitted.status();
  MissionOptions everywhere = options;
  everywhere.gas.field_reach_m = 0.0;
  EXPECT_LT(fitted->gas.lattice_factor, FitToBudget(everywhere)->gas.lattice_factor);
}

TEST(MemoryEstimateTest, AMapBeyondTheBudgetIsRefused) {
  const absl::Status refused = FitToBudget(Knowing(2900, 300 * kMegabyte)).status();
  EXPECT_EQ(ErrorReason(refused), reason::kBudgetReached);
  EXPECT_TRUE(absl::IsResourceExhausted(refused));
  EXPECT_THAT(std::string(refused.message()), ::testing::HasSubstr("memory_budget_bytes"));
}

TEST(MemoryEstimateTest, ReadingsTakeSitesAndBuckets) {
  GasOptions ageing;
  ageing.ageing_half_life_s = 60.0;
  for (const GasOptions& options : {GasOptions(), ageing}) {
    ReadingStore store(options, 0.1);
    for (int i = 0; i < 3; ++i) store.Add(i, {0.05, 0.05}, {1.0, 0.0});
    EXPECT_EQ(ReadingBytes(store), 3 * kReadingSiteBytes) << "each by itself until it is placed";
    const Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, 4, 4}, CellState::kFree);
    ASSERT_TRUE(store.Place(states, {}).ok());
    const std::int64_t buckets = options.ageing_half_life_s > 0.0 ? 3 : 0;
    EXPECT_EQ(ReadingBytes(store), kReadingSiteBytes + buckets * kReadingBucketBytes);
    EXPECT_EQ(ReadingBytes(store.Unplaced()), ReadingBytes(store));
  }
}

}  // namespace memory_estimate_test
}  // namespace plumescout
