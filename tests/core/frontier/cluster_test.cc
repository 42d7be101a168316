// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/cluster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/grid_art.h"

namespace plumescout {
namespace cluster_test {

using ::testing::UnorderedElementsAre;

constexpr std::uint8_t kWaiting = 1;
constexpr std::uint8_t kTaken = 2;

// Cells drawn 'f' or 'S' wait, the cluster is taken from 'S'.
struct Drawing {
  explicit Drawing(const testing::GridArt& art)
      : geometry(testing::GeometryOfArt(art)),
        cells(PaddedFrom<std::uint8_t>(testing::MaskFromArt(art, "."), 0,
                                       [](std::uint8_t mark) { return mark; })),
        seed(cells.IndexOf(testing::CellInArt(art, 'S'))) {}

  Frontier Take(int min_cells = 1) {
    return TakeCluster(geometry, {FrontierKind::kGas, kWaiting, kTaken, min_cells}, seed, cells);
  }

  GridGeometry geometry;
  Padded<std::uint8_t> cells;
  int seed;
};

TEST(TakeCluster, GathersAllThatIsConnectedByEdgesOrCorners) {
  Drawing drawing({"f...f",  //
                   ".S..f",  //
                   "..f.."});
  EXPECT_THAT(drawing.Take().cells, UnorderedElementsAre(Cell{1, 1}, Cell{0, 2}, Cell{2, 0}));
}

TEST(TakeCluster, TakesEachCellOnce) {
  Drawing drawing({"Sf",  //
                   "ff"});
  EXPECT_EQ(drawing.Take().cells.size(), 4U);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) {
      EXPECT_EQ(drawing.cells[drawing.cells.IndexOf({x, y})], kTaken);
    }
  }
}

TEST(TakeCluster, HasTheMeanOfItsCentresAsCentroid) {
  const Frontier frontier = Drawing({"f..",  //
                                     ".S.",  //
                                     "..f"})
                                .Take();
  EXPECT_DOUBLE_EQ(frontier.centroid.x_m, 0.15);
  EXPECT_DOUBLE_EQ(frontier.centroid.y_m, 0.15);
  EXPECT_EQ(frontier.kind, FrontierKind::kGas);
}

TEST(TakeCluster, IsTooSmallBelowTheMinimum) {
  EXPECT_FALSE(Drawing({"Sff"}).Take(3).too_small);
  EXPECT_TRUE(Drawing({"Sff"}).Take(4).too_small);
}

}  // namespace cluster_test
}  // namespace plumescout
