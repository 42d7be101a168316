// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_lattice.h"

#include <gtest/gtest.h>

#include "tests/support/grid_art.h"

namespace plumescout {
namespace gas_lattice_test {

using ::plumescout::testing::GridArt;
using ::plumescout::testing::GridFromArt;

CellInput Structure(const GridArt& art, GasCell gas_cell, int factor) {
  AnchoredStates states;
  EXPECT_TRUE(states.Update(GridFromArt(art)).ok());
  return StructureOf(states, gas_cell, factor);
}

TEST(GasLatticeTest, GasCellsContinueOnTheOtherSideOfTheAnchor) {
  EXPECT_EQ(GasCellOf({0, 2}, 3), (GasCell{0, 0}));
  EXPECT_EQ(GasCellOf({3, 5}, 3), (GasCell{1, 1}));
  EXPECT_EQ(GasCellOf({-1, -3}, 3), (GasCell{-1, -1}));
  EXPECT_EQ(GasCellOf({-4, -6}, 3), (GasCell{-2, -2}));
  EXPECT_EQ(GasCellOf({-4, 7}, 1), (GasCell{-4, 7}));
}

TEST(GasLatticeTest, IndexAndCellAreInverse) {
  const GasLattice lattice{-2, 5, 3, 4};
  for (std::size_t i = 0; i < lattice.size(); ++i) EXPECT_EQ(lattice.Index(lattice.CellAt(i)), i);
  EXPECT_TRUE(lattice.Contains({0, 8}));
  EXPECT_FALSE(lattice.Contains({1, 8}));
  EXPECT_FALSE(lattice.Contains({-3, 5}));
}

TEST(GasLatticeTest, NewLatticeHoldsTheOldOneAndTheMargin) {
  const GasCellRect rect{{-1, 4}, {4, 7}};
  const GasLattice lattice = MakeLattice({2, 2, 20, 1}, rect, 5);
  EXPECT_EQ(lattice, (GasLattice{-6, -1, 28, 13}));
  EXPECT_TRUE(HasRoom(lattice, rect, 5));
  EXPECT_FALSE(HasRoom(lattice, rect, 6));
  EXPECT_FALSE(HasRoom(GasLattice(), rect, 0));
}

TEST(GasLatticeTest, SingleCellsAreLinkedByBeingFree) {
  const CellInput input = Structure({".#"}, {0, 0}, 1);
  EXPECT_TRUE(input.active && input.linked_east && input.linked_north);
  EXPECT_FALSE(Structure({".#"}, {1, 0}, 1).active);
}

TEST(GasLatticeTest, CoarseCellIsActiveIfAnyOfItsCellsIsFree) {
  EXPECT_TRUE(Structure({"##", "#."}, {0, 0}, 2).active);
  EXPECT_FALSE(Structure({"#?", "##"}, {0, 0}, 2).active);
  EXPECT_FALSE(Structure({".."}, {7, 7}, 2).active);
}

TEST(GasLatticeTest, CoarseCellsAreLinkedWhereFreeCellsTouchAcrossTheirSide) {
  EXPECT_TRUE(Structure({"####", "...."}, {0, 0}, 2).linked_east);
  EXPECT_FALSE(Structure({".#..", ".#.."}, {0, 0}, 2).linked_east) << "a wall";
  EXPECT_FALSE(Structure({"..##", "##.."}, {0, 0}, 2).linked_east) << "corners only";
  EXPECT_TRUE(Structure({"#.", "#.", "#.", ".."}, {0, 0}, 2).linked_north);
  EXPECT_FALSE(Structure({"#.", "#.", ".#", ".."}, {0, 0}, 2).linked_north);
}

}  // namespace gas_lattice_test
}  // namespace plumescout
