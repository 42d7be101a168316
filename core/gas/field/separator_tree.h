// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types/stop.h"

namespace plumescout {

// Place of a lattice cell in the order of elimination.
using Slot = std::uint32_t;
inline constexpr Slot kNoSlot = ~Slot{0};

// Nested dissection of a lattice of 4-connected cells, active or not: each node owns cells on a
// line along the axes or the walls that separate those of its two children, or, as a leaf, a small
// part. Nodes are numbered children first, the root last, and their cells in that order, so that
//   * a node owns the slots [first, end), and its descendants slots below `first`;
//   * a neighbour of a cell of the node with a slot >= `end` belongs to an ancestor.
// Activity only advises where to cut: any cell may become active later without a new tree.
class SeparatorTree {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  struct Node {
    std::uint32_t parent = kNone;
    std::array<std::uint32_t, 2> children = {kNone, kNone};  // both or none
    Slot first = 0;
    Slot end = 0;

    bool is_leaf() const { return children[0] == kNone; }
  };

  // `active` is by cell index y * width + x. REQUIRES: width, height >= 1, width * height < 2^32 -
  // 1, active.size() == width * height. Cost: O(n log n).
  // Once `stop` says so, what is left is not divided any more: a tree, but not one to work with.
  SeparatorTree(std::size_t width, std::size_t height, std::span<const std::uint8_t> active,
                const StopFn& stop = {});

  std::size_t width() const { return width_; }
  std::size_t cells() const { return slot_of_cell_.size(); }
  const std::vector<Node>& nodes() const { return nodes_; }
  Slot slot(std::size_t cell) const { return slot_of_cell_[cell]; }
  std::size_t cell(Slot slot) const { return cell_of_slot_[slot]; }
  std::uint32_t owner(Slot slot) const { return owner_[slot]; }
  // East, north, west, south; kNoSlot beyond the lattice.
  const std::array<Slot, 4>& neighbours(Slot slot) const { return neighbours_[slot]; }

 private:
  void FindNeighbours();

  std::size_t width_;
  std::vector<Node> nodes_;
  std::vector<Slot> slot_of_cell_;
  std::vector<std::uint32_t> cell_of_slot_;
  std::vector<std::uint32_t> owner_;  // by slot
  std::vector<std::array<Slot, 4>> neighbours_;

  friend class Dissection;
};

}  // namespace plumescout
