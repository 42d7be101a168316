// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/flood.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/grid_art.h"
#include "tests/support/random_grid.h"

namespace plumescout {
namespace flood_test {

using testing::ArtFromMask;
using testing::CellInArt;
using ::testing::ElementsAre;
using testing::MaskFromArt;

constexpr Connectivity kAll[] = {Connectivity::kFour, Connectivity::kEightNoCornerCut,
                                 Connectivity::kEight};

bool MayStep(const Grid<std::uint8_t>& mask, Cell cell, Cell offset, Connectivity connectivity) {
  const auto passable = [&mask](Cell c) { return mask.At(c, 0) != 0; };
  if (connectivity == Connectivity::kEightNoCornerCut) return StepAllowed(cell, offset, passable);
  if (connectivity == Connectivity::kFour && IsDiagonal(offset)) return false;
  return passable(Shifted(cell, offset));
}

// Closes the set of starts under single steps until nothing changes: the definition.
Grid<std::uint8_t> SlowReachable(const Grid<std::uint8_t>& mask, const std::vector<Cell>& starts,
                                 Connectivity connectivity) {
  Grid<std::uint8_t> reached(mask.geometry());
  for (const Cell start : starts) reached[start] = mask[start];
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (reached[i] == 0) continue;
      const Cell cell = mask.geometry().CellAtIndex(i);
      for (const Cell offset : kNeighbours8) {
        if (!MayStep(mask, cell, offset, connectivity)) continue;
        changed = changed || reached[Shifted(cell, offset)] == 0;
        reached[Shifted(cell, offset)] = 1;
      }
    }
  }
  return reached;
}

TEST(ReachableCells, EqualsTheClosureOfStepsOnRandomMaps) {
  Rng rng(1);
  for (int trial = 0; trial < 60; ++trial) {
    const Grid<std::uint8_t> mask = testing::RandomMask(23, 17, 0.6, rng);
    const std::vector<Cell> starts = {testing::RandomCell(mask.geometry(), rng),
                                      testing::RandomCell(mask.geometry(), rng)};
    for (const Connectivity connectivity : kAll) {
      ASSERT_EQ(ReachableCells(mask, starts, connectivity),
                SlowReachable(mask, starts, connectivity))
          << ArtFromMask(mask);
    }
  }
}

TEST(ReachableCells, CutsACornerOnlyIfTold) {
  const testing::GridArt art = {"#.",  //
                                "S#"};
  const std::vector<Cell> starts = {CellInArt(art, 'S')};
  EXPECT_EQ(ArtFromMask(ReachableCells(MaskFromArt(art), starts)), "..\n#.\n");
  EXPECT_EQ(ArtFromMask(ReachableCells(MaskFromArt(art), starts, Connectivity::kEight)),
            ".#\n#.\n");
}

TEST(ReachableCells, PassesOverStartsOutsideOrBlocked) {
  const Grid<std::uint8_t> mask = MaskFromArt({".#"});
  const Grid<std::uint8_t> reached =
      ReachableCells(mask, {{1, 0}, {-1, 0}, {2, 0}, {0, 1 << 30}, {0, -(1 << 30)}});
  EXPECT_EQ(ArtFromMask(reached), "..\n");
}

TEST(ReachableCells, OfAnEmptyRasterIsEmpty) {
  EXPECT_EQ(ReachableCells(Grid<std::uint8_t>(), {{0, 0}}).size(), 0U);
}

TEST(ConnectedComponents, AreNumberedByTheirLeastIndexWithTheirSizes) {
  const Components components = ConnectedComponents(MaskFromArt({"..#.",  //
                                                                 "####",  //
                                                                 ".#.."}));
  EXPECT_THAT(components.sizes, ElementsAre(1, 2, 2, 1));
  EXPECT_THAT(components.label.values(), ElementsAre(0, -1, 1, 1,     //
                                                     -1, -1, -1, -1,  //
                                                     2, 2, -1, 3));
}

TEST(ConnectedComponents, AreWhatEachOfTheirCellsReaches) {
  Rng rng(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Grid<std::uint8_t> mask = testing::RandomMask(15, 11, 0.55, rng);
    for (const Connectivity connectivity : kAll) {
      const Components components = ConnectedComponents(mask, connectivity);
      const Cell start = testing::RandomCell(mask.geometry(), rng);
      const Grid<std::uint8_t> reached = SlowReachable(mask, {start}, connectivity);
      for (std::size_t i = 0; i < mask.size(); ++i) {
        const bool same = mask[i] != 0 && components.label[i] == components.label[start];
        ASSERT_EQ(reached[i] != 0, same);
      }
    }
  }
}

TEST(ConnectedComponents, SizesCountEveryPassableCellOnce) {
  Rng rng(3);
  const Grid<std::uint8_t> mask = testing::RandomMask(40, 30, 0.5, rng);
  const std::vector<int> sizes = ConnectedComponents(mask).sizes;
  EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), 0),
            std::accumulate(mask.values().begin(), mask.values().end(), 0));
}

}  // namespace flood_test
}  // namespace plumescout
