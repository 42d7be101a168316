// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/grid_art.h"
#include "tests/support/random_grid.h"

namespace plumescout {
namespace distance_field_test {

// The definition: the least over all set cells.
Grid<std::int32_t> SlowDistances(const Grid<std::uint8_t>& set) {
  Grid<std::int32_t> distances(set.geometry(), kFarSquared);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Cell a = set.geometry().CellAtIndex(i);
    for (std::size_t j = 0; j < set.size(); ++j) {
      if (set[j] == 0) continue;
      const Cell b = set.geometry().CellAtIndex(j);
      distances[i] = std::min(distances[i], (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
    }
  }
  return distances;
}

Grid<std::int32_t> Capped(Grid<std::int32_t> distances, int cap_cells) {
  for (std::int32_t& d : distances.values()) {
    if (d > cap_cells * cap_cells) d = kFarSquared;
  }
  return distances;
}

class DistancesOnRandomMaps : public ::testing::TestWithParam<double> {};

TEST_P(DistancesOnRandomMaps, EqualTheLeastOverAllSetCells) {
  Rng rng(1);
  for (int trial = 0; trial < 20; ++trial) {
    const int width = 1 + static_cast<int>(rng.Below(40));
    const int height = 1 + static_cast<int>(rng.Below(40));
    const Grid<std::uint8_t> set = testing::RandomMask(width, height, GetParam(), rng);
    const Grid<std::int32_t> expected = SlowDistances(set);
    ASSERT_EQ(SquaredDistances_cells2(set), expected) << testing::ArtFromMask(set);
    for (const int cap_cells : {0, 1, 2, 5, 100}) {
      ASSERT_EQ(SquaredDistancesUpTo_cells2(set, cap_cells), Capped(expected, cap_cells))
          << cap_cells << "\n"
          << testing::ArtFromMask(set);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shares, DistancesOnRandomMaps,
                         ::testing::Values(0.0, 0.002, 0.02, 0.3, 1.0));

TEST(SquaredDistances, OfASingleCellAreThoseOfItsCentre) {
  Grid<std::uint8_t> set(GridGeometry{0.0, 0.0, 0.1, 7, 5});
  set[Cell{2, 1}] = 1;
  const Grid<std::int32_t> distances = SquaredDistances_cells2(set);
  EXPECT_EQ((distances[Cell{2, 1}]), 0);
  EXPECT_EQ((distances[Cell{6, 4}]), 16 + 9);
}

TEST(SquaredDistances, StayExactAcrossAWideRaster) {
  Grid<std::uint8_t> set(GridGeometry{0.0, 0.0, 0.1, 32767, 2});
  set[Cell{0, 0}] = 1;
  const Grid<std::int32_t> distances = SquaredDistances_cells2(set);
  EXPECT_EQ((distances[Cell{32766, 1}]), 32766 * 32766 + 1);
}

TEST(SquaredDistances, OfAnEmptyRasterAreEmpty) {
  EXPECT_EQ(SquaredDistances_cells2(Grid<std::uint8_t>()).size(), 0U);
  EXPECT_EQ(SquaredDistancesUpTo_cells2(Grid<std::uint8_t>(), 3).size(), 0U);
}

}  // namespace distance_field_test
}  // namespace plumescout
