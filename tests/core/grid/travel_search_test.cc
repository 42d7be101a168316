// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/travel_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/grid/grid_search.h"
#include "tests/support/random_grid.h"

namespace plumescout {
namespace travel_search_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using FloatSearch = TravelSearch<float>;

FloatSearch SearchOver(const Grid<std::uint8_t>& mask,
                       Connectivity connectivity = Connectivity::kEightNoCornerCut) {
  return {mask.geometry(), connectivity, [&mask](std::size_t index) { return mask[index] != 0; }};
}

Grid<std::uint8_t> OpenRow(int width) {
  return Grid<std::uint8_t>(GridGeometry{0.0, 0.0, 0.1, width, 1}, 1);
}

TEST(TravelSearch, OfARectangleIsThatOfTheRasterWithAllElseClosed) {
  Rng rng(5);
  const Grid<std::uint8_t> mask = testing::RandomMask(40, 30, 0.8, rng);
  const CellRect cells({7, 3}, {33, 29});
  Grid<std::uint8_t> inside(mask.geometry(), 0);
  Cell start;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const Cell cell = mask.geometry().CellAtIndex(i);
    inside[i] = cells.Contains(cell) ? mask[i] : std::uint8_t{0};
    if (inside[i] != 0) start = cell;
  }
  TravelSearch<double> search(mask.geometry(), cells, Connectivity::kEightNoCornerCut,
                              [&mask](std::size_t index) { return mask[index] != 0; });
  search.Run({{{0, 0}, 0.0}, {start, 0.0}});
  const Grid<double> expected = TravelDistances_m(inside, std::vector<Cell>{start});
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const Cell cell = mask.geometry().CellAtIndex(i);
    ASSERT_EQ(search.Travel(cell), expected[i]) << cell.x << ", " << cell.y;
  }
}

TEST(TravelSearch, InFloatAgreesWithDoubleToItsRoundings) {
  Rng rng(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Grid<std::uint8_t> mask = testing::RandomMask(70, 50, 0.75, rng);
    const Cell start = testing::RandomCell(mask.geometry(), rng);
    FloatSearch search = SearchOver(mask);
    search.Run({{start, 0.0}});
    const Grid<double> expected = TravelDistances_m(mask, std::vector<Cell>{start});
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const Cell cell = mask.geometry().CellAtIndex(i);
      ASSERT_EQ(search.IsReached(search.IndexOf(cell)), expected[i] < kUnreached_m);
      if (expected[i] == kUnreached_m) continue;
      // A few hundred steps, each rounded to half of 2^-23 of at most 30 m: 1e-3 bounds them all.
      ASSERT_NEAR(static_cast<double>(search.Travel(cell)), expected[i], 1e-3);
    }
  }
}

TEST(TravelSearch, InFloatReadsBackWholeWays) {
  Rng rng(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Grid<std::uint8_t> mask = testing::RandomMask(70, 50, 0.8, rng);
    const Cell start = testing::RandomCell(mask.geometry(), rng);
    const Cell goal = testing::RandomCell(mask.geometry(), rng);
    FloatSearch search = SearchOver(mask, Connectivity::kEight);
    search.Run({{start, 0.0}});
    const std::vector<Cell> way = search.WayTo(goal);
    ASSERT_EQ(way.empty(), !search.IsReached(search.IndexOf(goal)));
    if (way.empty()) continue;
    EXPECT_EQ(way.front(), start);
    EXPECT_EQ(way.back(), goal);
    EXPECT_NEAR(PathLength_m(way, 0.1), static_cast<double>(search.Travel(goal)), 1e-3);
  }
}

TEST(TravelSearch, OpensAndClosesCellsBeforeItRuns) {
  const Grid<std::uint8_t> mask = OpenRow(4);
  FloatSearch search = SearchOver(mask);
  search.Close(search.IndexOf({2, 0}));
  EXPECT_FALSE(search.IsOpen(search.IndexOf({2, 0})));
  search.Run({{{0, 0}, 0.0}});
  EXPECT_THAT(search.WayTo({3, 0}), IsEmpty());

  FloatSearch reopened = SearchOver(mask);
  reopened.Close(reopened.IndexOf({2, 0}));
  reopened.Open(reopened.IndexOf({2, 0}));
  reopened.Run({{{0, 0}, 0.0}});
  EXPECT_THAT(reopened.WayTo({2, 0}), ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{2, 0}));
}

TEST(TravelSearch, StopsAfterTheBucketAtWhichItIsDone) {
  const Grid<std::uint8_t> mask = OpenRow(10);
  FloatSearch search = SearchOver(mask);
  const int target = search.IndexOf({3, 0});
  search.Run({{{0, 0}, 0.0}},
             [&](std::span<const FloatSearch::Entry>) { return search.IsSettled(target); });
  EXPECT_TRUE(search.IsReached(target));
  EXPECT_FALSE(search.IsReached(search.IndexOf({6, 0})));
}

TEST(TravelSearch, PassesOverSourcesOutsideOrBlocked) {
  const Grid<std::uint8_t> mask(GridGeometry{0.0, 0.0, 0.1, 5, 5}, 0);
  FloatSearch search = SearchOver(mask);
  search.Run({{{2, 2}, 0.0}, {{-1, 0}, 0.0}, {{0, 1 << 30}, 0.0}});
  EXPECT_FALSE(search.IsReached(search.IndexOf({2, 2})));
}

}  // namespace travel_search_test
}  // namespace plumescout
