// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/sampled_cells.h"

#include <gtest/gtest.h>

#include <numeric>

namespace plumescout {
namespace sampled_cells_test {

int Sum(const Grid<std::uint8_t>& raster) {
  return std::accumulate(raster.values().begin(), raster.values().end(), 0);
}

TEST(SampledCells, KnowACellOnce) {
  SampledCells cells(0.1);
  EXPECT_TRUE(cells.Add({0.42, 0.17}));
  EXPECT_FALSE(cells.Add({0.47, 0.11})) << "the same cell";
  EXPECT_TRUE(cells.Add({0.52, 0.17}));
}

TEST(SampledCells, AreMarkedOnMapsWhereverThoseBegin) {
  SampledCells cells(0.1);
  cells.Add({-0.23, 0.17});
  cells.Add({0.42, -0.99});
  for (const GridGeometry& map :
       {GridGeometry{-1.0, -1.0, 0.1, 20, 20}, GridGeometry{-3.3, -1.7, 0.1, 60, 60}}) {
    const Grid<std::uint8_t> raster = cells.On(map);
    EXPECT_EQ(raster.geometry(), map);
    EXPECT_EQ(Sum(raster), 2);
    EXPECT_EQ(raster[map.CellAt({-0.23, 0.17})], 1);
    EXPECT_EQ(raster[map.CellAt({0.42, -0.99})], 1);
  }
}

TEST(SampledCells, OffTheMapAreLeftOut) {
  SampledCells cells(0.1);
  cells.Add({5.0, 5.0});
  cells.Add({-5.0, 5.0});
  EXPECT_EQ(Sum(cells.On({0.0, 0.0, 0.1, 10, 10})), 0);
}

// Every cell of a map far from (0, 0), whose coordinates are no multiples of the resolution in
// binary.
TEST(SampledCells, AreTheCellsOfTheMap) {
  const GridGeometry map{-37.3, 812.7, 0.1, 40, 40};
  for (std::size_t i = 0; i < map.size(); ++i) {
    SampledCells cells(0.1);
    cells.Add(map.Center(map.CellAtIndex(i)));
    const Grid<std::uint8_t> raster = cells.On(map);
    EXPECT_EQ(Sum(raster), 1);
    EXPECT_EQ(raster[i], 1) << i;
  }
}

}  // namespace sampled_cells_test
}  // namespace plumescout
