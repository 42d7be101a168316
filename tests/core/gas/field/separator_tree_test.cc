// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/separator_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/types/rng.h"
#include "tests/core/gas/field/rotated_rooms.h"

namespace plumescout {
namespace separator_tree_test {

std::vector<std::uint8_t> RandomActivity(std::size_t cells, double share, Rng& rng) {
  std::vector<std::uint8_t> active(cells);
  for (std::uint8_t& cell : active) cell = rng.Uniform01() < share ? 1 : 0;
  return active;
}

bool IsSameOrAncestor(const SeparatorTree& tree, std::uint32_t above, std::uint32_t below) {
  while (below != SeparatorTree::kNone && below != above) below = tree.nodes()[below].parent;
  return below == above;
}

struct Lattice {
  std::size_t width, height;
};

class SeparatorTreeTest : public ::testing::TestWithParam<Lattice> {
 protected:
  SeparatorTree RandomTree() const {
    Rng rng(1);
    const auto [width, height] = GetParam();
    return SeparatorTree(width, height, RandomActivity(width * height, 0.6, rng));
  }
};

TEST_P(SeparatorTreeTest, PlacesEachCellOnce) {
  const SeparatorTree tree = RandomTree();
  ASSERT_EQ(tree.cells(), GetParam().width * GetParam().height);
  for (std::size_t cell = 0; cell < tree.cells(); ++cell) {
    EXPECT_EQ(tree.cell(tree.slot(cell)), cell);
  }
}

TEST_P(SeparatorTreeTest, NumbersNodesAndSlotsChildrenFirst) {
  const SeparatorTree tree = RandomTree();
  Slot next = 0;
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
    const SeparatorTree::Node& node = tree.nodes()[i];
    EXPECT_EQ(node.first, next);
    next = node.end;
    for (Slot slot = node.first; slot < node.end; ++slot) EXPECT_EQ(tree.owner(slot), i);
    EXPECT_EQ(node.parent == SeparatorTree::kNone, i + 1 == tree.nodes().size());
    if (node.is_leaf()) continue;
    for (const std::uint32_t child : node.children) {
      EXPECT_LT(child, i);
      EXPECT_EQ(tree.nodes()[child].parent, i);
    }
  }
  EXPECT_EQ(next, tree.cells());
}

TEST_P(SeparatorTreeTest, SeparatesCellsOfDifferentBranches) {
  const SeparatorTree tree = RandomTree();
  for (Slot slot = 0; slot < tree.cells(); ++slot) {
    for (const Slot next : tree.neighbours(slot)) {
      if (next == kNoSlot) continue;
      EXPECT_TRUE(IsSameOrAncestor(tree, tree.owner(next), tree.owner(slot)) ||
                  IsSameOrAncestor(tree, tree.owner(slot), tree.owner(next)));
    }
  }
}

TEST_P(SeparatorTreeTest, KnowsTheFourNeighbours) {
  const SeparatorTree tree = RandomTree();
  const auto [width, height] = GetParam();
  for (std::size_t i = 0; i < tree.cells(); ++i) {
    const std::size_t x = i % width;
    const std::size_t y = i / width;
    const std::array<Slot, 4> expected = {
        x + 1 < width ? tree.slot(i + 1) : kNoSlot, y + 1 < height ? tree.slot(i + width) : kNoSlot,
        x > 0 ? tree.slot(i - 1) : kNoSlot, y > 0 ? tree.slot(i - width) : kNoSlot};
    EXPECT_EQ(tree.neighbours(tree.slot(i)), expected);
  }
}

TEST(SeparatorTreeCutsTest, SeparateCellsAlongLinesOfAnySlope) {
  for (double angle_deg = -45.0; angle_deg <= 45.0; angle_deg += 6.0) {
    constexpr std::size_t kSide = 90;
    const SeparatorTree tree(kSide, kSide, testing::RotatedRooms(kSide, angle_deg));
    for (Slot slot = 0; slot < tree.cells(); ++slot) {
      for (const Slot next : tree.neighbours(slot)) {
        if (next == kNoSlot || next < slot) continue;
        EXPECT_TRUE(IsSameOrAncestor(tree, tree.owner(next), tree.owner(slot)));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lattices, SeparatorTreeTest,
                         ::testing::Values(Lattice{1, 1}, Lattice{1, 500}, Lattice{500, 1},
                                           Lattice{2, 90}, Lattice{7, 7}, Lattice{40, 61}));

TEST(SeparatorTreeCutsTest, CutAlongAWallThroughItsDoor) {
  constexpr std::size_t kWidth = 50;
  constexpr std::size_t kHeight = 40;
  constexpr std::size_t kWall = 19;
  std::vector<std::uint8_t> active(kWidth * kHeight, 1);
  for (std::size_t y = 0; y < kHeight; ++y) active[y * kWidth + kWall] = y < 3 ? 1 : 0;
  const SeparatorTree tree(kWidth, kHeight, active);
  const SeparatorTree::Node& root = tree.nodes().back();
  for (Slot slot = root.first; slot < root.end; ++slot) {
    EXPECT_EQ(tree.cell(slot) % kWidth, kWall);
  }
}

TEST(SeparatorTreeCutsTest, FollowWallsInAnyDirection) {
  // Through rooms of 30 cells with doors of 6: a line along a wall is active in a fifth or so of
  // its cells, one askew in nine of ten.
  constexpr std::size_t kSide = 180;
  for (const double angle_deg : {0.0, 30.0, -17.0}) {
    const std::vector<std::uint8_t> active = testing::RotatedRooms(kSide, angle_deg);
    const SeparatorTree tree(kSide, kSide, active);
    const SeparatorTree::Node& root = tree.nodes().back();
    double open = 0.0;
    for (Slot slot = root.first; slot < root.end; ++slot) open += active[tree.cell(slot)];
    EXPECT_LT(open, 0.4 * (root.end - root.first)) << angle_deg;
  }
}

TEST(SeparatorTreeCutsTest, LeaveTheUnknownReadyToBecomeActive) {
  constexpr std::size_t kMostCells = 64;  // of a line across; leaves are smaller
  const SeparatorTree tree(64, 64, std::vector<std::uint8_t>(64 * 64, 0));
  for (const SeparatorTree::Node& node : tree.nodes()) {
    EXPECT_LE(node.end - node.first, kMostCells);
  }
}

}  // namespace separator_tree_test
}  // namespace plumescout
