// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_cells.h"

#include <gtest/gtest.h>

#include <vector>

namespace plumescout {
namespace field_cells_test {

constexpr std::size_t kWidth = 9;
constexpr std::size_t kHeight = 8;

SeparatorTree MakeTree() {
  return SeparatorTree(kWidth, kHeight, std::vector<std::uint8_t>(kWidth * kHeight, 1));
}

std::vector<CellInput> AllActive() {
  return std::vector<CellInput>(kWidth * kHeight, {true, 0.0, 0.0});
}

TEST(FieldCellsTest, GiveBackWhatTheyWereTold) {
  const SeparatorTree tree = MakeTree();
  FieldCells cells(tree, AllActive());
  const CellInput told{true, 3.0, -4.0, false, true};
  cells.Set(tree, {kWidth * kHeight - 1, told});  // at the edges of the lattice
  const CellInput input = cells.Get(tree.slot(kWidth * kHeight - 1));
  EXPECT_TRUE(input.active);
  EXPECT_EQ(input.precision, 3.0);
  EXPECT_EQ(input.weighted_deviation, -4.0);
  EXPECT_FALSE(input.linked_east);
  EXPECT_TRUE(input.linked_north);
}

TEST(FieldCellsTest, KnowALinkFromBothSides) {
  const SeparatorTree tree = MakeTree();
  FieldCells cells(tree, AllActive());
  constexpr std::size_t kCell = 2 * kWidth + 3;
  cells.Set(tree, {kCell, {true, 0.0, 0.0, false, false}});
  constexpr std::size_t kEast = 0, kNorth = 1, kWest = 2, kSouth = 3;
  EXPECT_FALSE(cells.HasFactor(tree, tree.slot(kCell), kEast));
  EXPECT_FALSE(cells.HasFactor(tree, tree.slot(kCell + 1), kWest));
  EXPECT_FALSE(cells.HasFactor(tree, tree.slot(kCell), kNorth));
  EXPECT_FALSE(cells.HasFactor(tree, tree.slot(kCell + kWidth), kSouth));
  EXPECT_TRUE(cells.HasFactor(tree, tree.slot(kCell), kWest));
  EXPECT_TRUE(cells.HasFactor(tree, tree.slot(kCell), kSouth));
}

TEST(FieldCellsTest, HaveNoFactorWithACellThatIsNotActiveOrBeyondTheLattice) {
  const SeparatorTree tree = MakeTree();
  FieldCells cells(tree, AllActive());
  cells.Set(tree, {1, {}});
  for (const std::size_t direction : {0, 2, 3}) {  // the lattice ends in the west and the south
    EXPECT_FALSE(cells.HasFactor(tree, tree.slot(0), direction));
  }
  EXPECT_TRUE(cells.HasFactor(tree, tree.slot(0), 1));
}

}  // namespace field_cells_test
}  // namespace plumescout
