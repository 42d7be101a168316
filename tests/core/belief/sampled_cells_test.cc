// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/sampled_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "core/types/byte_archive.h"
#include "core/types/byte_reader.h"

namespace plumescout {
namespace sampled_cells_test {

int Sum(const Grid<std::uint8_t>& raster) {
  return std::accumulate(raster.values().begin(), raster.values().end(), 0);
}

TEST(SampledCells, KnowACellOnce) {
  SampledCells cells(0.1);
  EXPECT_TRUE(cells.Add(0, {0.42, 0.17}));
  EXPECT_FALSE(cells.Add(0, {0.47, 0.11})) << "the same cell";
  EXPECT_TRUE(cells.Add(0, {0.52, 0.17}));
}

TEST(SampledCells, AreMarkedOnMapsWhereverThoseBegin) {
  SampledCells cells(0.1);
  cells.Add(0, {-0.23, 0.17});
  cells.Add(0, {0.42, -0.99});
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
  cells.Add(0, {5.0, 5.0});
  cells.Add(0, {-5.0, 5.0});
  EXPECT_EQ(Sum(cells.On({0.0, 0.0, 0.1, 10, 10})), 0);
}

// Every cell of a map far from (0, 0), whose coordinates are no multiples of the resolution in
// binary.
TEST(SampledCells, AreTheCellsOfTheMap) {
  const GridGeometry map{-37.3, 812.7, 0.1, 40, 40};
  for (std::size_t i = 0; i < map.size(); ++i) {
    SampledCells cells(0.1);
    cells.Add(0, map.Center(map.CellAtIndex(i)));
    const Grid<std::uint8_t> raster = cells.On(map);
    EXPECT_EQ(Sum(raster), 1);
    EXPECT_EQ(raster[i], 1) << i;
  }
}

TEST(SampledCells, TellTheNewestReadingOfTheNearestCell) {
  SampledCells cells(0.1);
  EXPECT_EQ(cells.Nearest({0.0, 0.0}), std::nullopt);
  cells.Add(7, {1.05, 0.05});
  cells.Add(9, {1.02, 0.08});
  cells.Add(8, {1.08, 0.02});   // late
  cells.Add(20, {0.25, 2.05});  // farther
  const std::optional<NearestReading> nearest = cells.Nearest({0.35, 0.05});
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->distance_m, 0.7, 1e-12);
  EXPECT_EQ(nearest->time_ns, 9);
  EXPECT_EQ(cells.Nearest({0.35, 1.95})->time_ns, 20);
}

// The same as looking at every cell, from wherever.
TEST(SampledCells, NearestIsTheNearestOfAll) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> index(-30, 30);
  std::vector<Point2> middles;
  SampledCells cells(0.1);
  for (int i = 0; i < 60; ++i) {
    middles.push_back({0.1 * index(random) + 0.05, 0.1 * index(random) + 0.05});
    cells.Add(i, middles.back());
  }
  for (int i = 0; i < 200; ++i) {
    const Point2 place{0.15 * index(random) + 0.01, 0.15 * index(random) + 0.02};
    double least_m = std::numeric_limits<double>::infinity();
    for (const Point2 middle : middles) least_m = std::min(least_m, Distance_m(place, middle));
    EXPECT_NEAR(cells.Nearest(place)->distance_m, least_m, 1e-9);
  }
}

TEST(SampledCells, OfCellsAsNearTheNewestCounts) {
  SampledCells cells(0.5);  // whose middles are exact
  cells.Add(3, {0.25, 0.25});
  cells.Add(5, {1.25, 0.25});
  cells.Add(4, {0.75, 0.75});
  EXPECT_EQ(cells.Nearest({0.75, 0.25}), (NearestReading{0.5, 5}));
}

TEST(SampledCells, AreSavedWithTheirTimes) {
  SampledCells cells(0.1);
  cells.Add(3, {0.42, 0.17});
  cells.Add(5, {-0.42, 0.17});
  ByteWriter writer;
  writer(cells);
  SampledCells back(0.1);
  ByteReader reader(writer.sink().bytes, 0);
  reader(back);
  ASSERT_TRUE(reader.Finish().ok());
  EXPECT_EQ(back.Nearest({0.4, 0.1}), cells.Nearest({0.4, 0.1}));
  EXPECT_EQ(back.Nearest({-0.4, 0.1})->time_ns, 5);
}

// As states of version 1 have them, which hashes still go by.
TEST(SampledCells, OfOldStatesHaveNoTimes) {
  ByteWriter writer;
  writer(std::set<std::pair<std::int64_t, std::int64_t>>{{-5, 1}, {4, 1}});
  SampledCells cells(0.1);
  ByteReader reader(writer.sink().bytes, 0, 1);
  reader(cells);
  ASSERT_TRUE(reader.Finish().ok());
  EXPECT_NEAR(cells.Nearest({0.45, 0.15})->distance_m, 0.0, 1e-12);
  EXPECT_EQ(cells.Nearest({0.45, 0.15})->time_ns, std::nullopt);
  SampledCells timed(0.1);
  timed.Add(3, {0.42, 0.17});
  timed.Add(5, {-0.42, 0.17});
  StateHasher old_hash;
  old_hash(cells);
  StateHasher hash;
  hash(timed);
  EXPECT_EQ(hash.sink().hash.value(), old_hash.sink().hash.value());
  timed.Add(9, {0.42, 0.17});
  cells.Add(9, {0.42, 0.17});
  EXPECT_EQ(cells.Nearest({0.4, 0.1}), timed.Nearest({0.4, 0.1})) << "known from the next on";
}

TEST(SampledCells, ThatLackATimeAreDamaged) {
  ByteWriter writer;
  writer(std::set<std::pair<std::int64_t, std::int64_t>>{{-5, 1}, {4, 1}},
         std::vector<std::int64_t>{7});
  SampledCells cells(0.1);
  ByteReader reader(writer.sink().bytes, 0);
  reader(cells);
  EXPECT_FALSE(reader.Finish().ok());
}

}  // namespace sampled_cells_test
}  // namespace plumescout
