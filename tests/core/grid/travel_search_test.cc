// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/travel_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

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

// By definition: the least sum of steps, in the order in which they are driven, each sum rounded.
template <typename Length>
Grid<Length> SlowTravel_m(const Grid<std::uint8_t>& mask, const std::vector<SearchSource>& sources,
                          Connectivity connectivity) {
  Grid<Length> travel_m(mask.geometry(), std::numeric_limits<Length>::infinity());
  for (const SearchSource& source : sources) {
    if (mask[source.cell] == 0) continue;
    travel_m[source.cell] = std::min(travel_m[source.cell], static_cast<Length>(source.travel_m));
  }
  const auto passable = [&](Cell cell) { return mask.At(cell, 0) != 0; };
  for (bool shortened = true; shortened;) {
    shortened = false;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const Cell cell = mask.geometry().CellAtIndex(i);
      for (const Cell offset : kNeighbours8) {
        const Cell to = Shifted(cell, offset);
        const bool allowed = connectivity == Connectivity::kEightNoCornerCut
                                 ? StepAllowed(cell, offset, passable)
                                 : passable(to);
        if (!allowed || (connectivity == Connectivity::kFour && IsDiagonal(offset))) continue;
        const Length via_m = travel_m[i] + static_cast<Length>(StepLength_cells(offset) *
                                                               mask.geometry().resolution_m);
        if (!(via_m < travel_m[to])) continue;
        travel_m[to] = via_m;
        shortened = true;
      }
    }
  }
  return travel_m;
}

template <typename Length>
void ExpectLeastSums(Connectivity connectivity, Rng& rng) {
  for (int trial = 0; trial < 30; ++trial) {
    const double share = 0.5 + 0.5 * rng.Uniform01();
    const Grid<std::uint8_t> mask = testing::RandomMask(31, 23, share, rng);
    std::vector<SearchSource> sources;
    for (int i = 0; i <= trial % 4; ++i) {
      sources.push_back({testing::RandomCell(mask.geometry(), rng), 2.0 * i * rng.Uniform01()});
    }
    TravelSearch<Length> search(mask.geometry(), connectivity,
                                [&mask](std::size_t index) { return mask[index] != 0; });
    search.Run(sources);
    ASSERT_EQ(search.Field(), SlowTravel_m<Length>(mask, sources, connectivity));
  }
}

TEST(TravelSearch, FindsTheLeastSumsToTheBit) {
  Rng rng(9);
  for (const Connectivity connectivity :
       {Connectivity::kFour, Connectivity::kEightNoCornerCut, Connectivity::kEight}) {
    ExpectLeastSums<double>(connectivity, rng);
    ExpectLeastSums<float>(connectivity, rng);
  }
}

TEST(TravelSearch, ShowsWhatWasReachedOnALevel) {
  const Grid<std::uint8_t> mask = OpenRow(4);
  FloatSearch search = SearchOver(mask);
  std::vector<Cell> reached;
  search.Run({{{1, 0}, 0.0}}, [&] {
    search.ForEachOfLevel([&](int cell, float travel_m) {
      EXPECT_EQ(travel_m, search.Travel(search.CellAt(cell)));
      reached.push_back(search.CellAt(cell));
    });
    return false;
  });
  EXPECT_THAT(reached, ElementsAre(Cell{1, 0}, Cell{2, 0}, Cell{0, 0}, Cell{3, 0}));
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
  search.Run({{{0, 0}, 0.0}}, [&] { return search.IsSettled(target); });
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
