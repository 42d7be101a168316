// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/grid_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <queue>
#include <utility>

#include "tests/support/grid_art.h"
#include "tests/support/random_grid.h"

namespace plumescout {
namespace grid_search_test {

using testing::ArtFromMask;
using testing::CellInArt;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::MaskFromArt;

// Both sides add the same lengths of a few hundred steps, in different orders.
constexpr double kTolerance_m = 1e-9;

bool MayStep(const Grid<std::uint8_t>& mask, Cell cell, Cell offset, Connectivity connectivity) {
  const auto passable = [&mask](Cell c) { return mask.At(c, 0) != 0; };
  if (connectivity == Connectivity::kEightNoCornerCut) return StepAllowed(cell, offset, passable);
  if (connectivity == Connectivity::kFour && IsDiagonal(offset)) return false;
  return passable(Shifted(cell, offset));
}

// Textbook Dijkstra with a binary heap: the oracle.
Grid<double> SlowDistances_m(const Grid<std::uint8_t>& mask,
                             const std::vector<SearchSource>& sources, Connectivity connectivity) {
  Grid<double> distances(mask.geometry(), kUnreached_m);
  using Entry = std::pair<double, Cell>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const SearchSource& source : sources) {
    if (mask.At(source.cell, 0) != 0) queue.push({source.travel_m, source.cell});
  }
  while (!queue.empty()) {
    const auto [distance_m, cell] = queue.top();
    queue.pop();
    if (distance_m >= distances[cell]) continue;
    distances[cell] = distance_m;
    for (const Cell offset : kNeighbours8) {
      if (!MayStep(mask, cell, offset, connectivity)) continue;
      queue.push({distance_m + StepLength_cells(offset) * mask.geometry().resolution_m,
                  Shifted(cell, offset)});
    }
  }
  return distances;
}

void ExpectNear(const Grid<double>& actual, const Grid<double>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] == kUnreached_m) {
      ASSERT_EQ(actual[i], kUnreached_m) << i;
    } else {
      ASSERT_NEAR(actual[i], expected[i], kTolerance_m) << i;
    }
  }
}

TEST(TravelDistances, EqualAHeapDijkstraOnRandomMaps) {
  Rng rng(1);
  for (int trial = 0; trial < 60; ++trial) {
    const Grid<std::uint8_t> mask = testing::RandomMask(41, 29, rng.Uniform(0.5, 1.0), rng);
    for (const Connectivity connectivity :
         {Connectivity::kFour, Connectivity::kEightNoCornerCut, Connectivity::kEight}) {
      const std::vector<SearchSource> sources = {{testing::RandomCell(mask.geometry(), rng), 0.0}};
      ExpectNear(TravelDistances_m(mask, sources, connectivity),
                 SlowDistances_m(mask, sources, connectivity));
    }
  }
}

TEST(TravelDistances, EqualAHeapDijkstraFromSourcesWithHeadStarts) {
  Rng rng(2);
  for (int trial = 0; trial < 60; ++trial) {
    const Grid<std::uint8_t> mask = testing::RandomMask(41, 29, 0.7, rng);
    std::vector<SearchSource> sources;
    for (int k = 0; k < 4; ++k) {
      sources.push_back({testing::RandomCell(mask.geometry(), rng), rng.Uniform(0.0, 9.0)});
    }
    ExpectNear(TravelDistances_m(mask, sources),
               SlowDistances_m(mask, sources, Connectivity::kEightNoCornerCut));
  }
}

TEST(TravelDistances, EqualAHeapDijkstraAtAResolutionThatIsNoBinaryFraction) {
  Rng rng(3);
  Grid<std::uint8_t> mask(GridGeometry{-6.4, 12.8, 0.07, 200, 160}, 1);
  const std::vector<SearchSource> sources = {{{3, 5}, 0.0}};
  ExpectNear(TravelDistances_m(mask, sources),
             SlowDistances_m(mask, sources, Connectivity::kEightNoCornerCut));
}

TEST(TravelDistances, AreInfiniteWithoutAUsableSource) {
  const Grid<std::uint8_t> mask = MaskFromArt({".#"});
  const Grid<double> distances = TravelDistances_m(mask, std::vector<Cell>{{1, 0}, {7, 7}});
  EXPECT_EQ(distances[0], kUnreached_m);
  EXPECT_EQ(distances[1], kUnreached_m);
}

TEST(TravelDistances, OfAnEmptyRasterAreEmpty) {
  EXPECT_EQ(TravelDistances_m(Grid<std::uint8_t>(), std::vector<Cell>{{0, 0}}).size(), 0U);
}

TEST(ShortestPath, IsAnAllowedChainFromASourceAsLongAsTheFieldSays) {
  Rng rng(4);
  for (int trial = 0; trial < 100; ++trial) {
    const Grid<std::uint8_t> mask = testing::RandomMask(37, 31, 0.75, rng);
    const Cell start = testing::RandomCell(mask.geometry(), rng);
    const Cell goal = testing::RandomCell(mask.geometry(), rng);
    const Grid<double> distances = TravelDistances_m(mask, std::vector<Cell>{start});
    const std::vector<Cell> path = ShortestPath(distances, goal);
    ASSERT_EQ(path.empty(), distances[goal] == kUnreached_m);
    if (path.empty()) continue;
    EXPECT_EQ(path.front(), start);
    EXPECT_EQ(path.back(), goal);
    EXPECT_NEAR(PathLength_m(path, mask.geometry().resolution_m), distances[goal], kTolerance_m);
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Cell offset = {path[i].x - path[i - 1].x, path[i].y - path[i - 1].y};
      ASSERT_TRUE(MayStep(mask, path[i - 1], offset, Connectivity::kEightNoCornerCut));
    }
  }
}

TEST(ShortestPath, LeadsAroundACorner) {
  const testing::GridArt art = {"S#",  //
                                ".G"};
  const Grid<double> distances =
      TravelDistances_m(MaskFromArt(art), std::vector<Cell>{CellInArt(art, 'S')});
  EXPECT_THAT(ShortestPath(distances, CellInArt(art, 'G')),
              ElementsAre(Cell{0, 1}, Cell{0, 0}, Cell{1, 0}));
}

TEST(ShortestPath, MayCutACornerIfTheFieldDid) {
  const testing::GridArt art = {"S#",  //
                                "#G"};
  const Grid<double> distances = TravelDistances_m(
      MaskFromArt(art), std::vector<Cell>{CellInArt(art, 'S')}, Connectivity::kEight);
  EXPECT_THAT(ShortestPath(distances, CellInArt(art, 'G'), Connectivity::kEight),
              ElementsAre(Cell{0, 1}, Cell{1, 0}));
}

TEST(ShortestPath, ToASourceIsThatCellAlone) {
  const Grid<double> distances = TravelDistances_m(MaskFromArt({"..."}), std::vector<Cell>{{1, 0}});
  EXPECT_THAT(ShortestPath(distances, {1, 0}), ElementsAre(Cell{1, 0}));
}

TEST(ShortestPath, ToACellOutsideIsEmpty) {
  const Grid<double> distances = TravelDistances_m(MaskFromArt({"..."}), std::vector<Cell>{{1, 0}});
  EXPECT_THAT(ShortestPath(distances, {3, 0}), IsEmpty());
}

TEST(PathToNearest, EndsAtTheTargetOfLeastTravelOnRandomMaps) {
  Rng rng(5);
  for (int trial = 0; trial < 100; ++trial) {
    Grid<std::uint8_t> mask = testing::RandomMask(25, 19, 0.7, rng);
    const Grid<std::uint8_t> targets = testing::RandomMask(25, 19, 0.02, rng);
    const Cell start = testing::RandomCell(mask.geometry(), rng);
    const std::vector<Cell> path = PathToNearest(mask, targets, start);
    mask[start] = 1;
    const Grid<double> distances =
        SlowDistances_m(mask, {{start, 0.0}}, Connectivity::kEightNoCornerCut);
    double nearest_m = kUnreached_m;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (targets[i] != 0) nearest_m = std::min(nearest_m, distances[i]);
    }
    ASSERT_EQ(path.empty(), nearest_m == kUnreached_m) << ArtFromMask(mask);
    if (path.empty()) continue;
    EXPECT_EQ(path.front(), start);
    EXPECT_NE(targets[path.back()], 0);
    EXPECT_NEAR(PathLength_m(path, mask.geometry().resolution_m), nearest_m, kTolerance_m);
  }
}

TEST(PathToNearest, TakesTheTargetOfLeastIndexOnATie) {
  const testing::GridArt art = {"T.S.T"};
  EXPECT_THAT(PathToNearest(MaskFromArt(art), MaskFromArt(art, ".S"), CellInArt(art, 'S')).back(),
              (Cell{0, 0}));
}

TEST(PathToNearest, OfATargetIsTheStartAlone) {
  const Grid<std::uint8_t> mask = MaskFromArt({"..."});
  EXPECT_THAT(PathToNearest(mask, mask, {1, 0}), ElementsAre(Cell{1, 0}));
}

TEST(PathToNearest, FromOutsideIsEmpty) {
  const Grid<std::uint8_t> mask = MaskFromArt({"..."});
  EXPECT_THAT(PathToNearest(mask, mask, {-1, 0}), IsEmpty());
}

TEST(PathLength, AddsStraightAndDiagonalSteps) {
  EXPECT_DOUBLE_EQ(PathLength_m({{0, 0}, {1, 0}, {2, 1}}, 0.5), 0.5 * (1.0 + std::sqrt(2.0)));
  EXPECT_EQ(PathLength_m({{4, 4}}, 0.5), 0.0);
  EXPECT_EQ(PathLength_m({}, 0.5), 0.0);
}

}  // namespace grid_search_test
}  // namespace plumescout
