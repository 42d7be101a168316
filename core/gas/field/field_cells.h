// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/gas/field/cell_input.h"
#include "core/gas/field/separator_tree.h"

namespace plumescout {

// What the field is told of its cells, by slot.
struct FieldCells {
  FieldCells() = default;
  FieldCells(const SeparatorTree& tree, std::span<const CellInput> inputs);

  void Set(const SeparatorTree& tree, const CellChange& change);
  CellInput Get(Slot slot) const;

  // Whether the cell may have a factor with neighbour `direction` of the tree.
  bool IsLinked(Slot slot, std::size_t direction) const {
    return ((links[slot] >> direction) & 1U) != 0;
  }
  // Whether it has one. REQUIRES: the cell is active.
  bool HasFactor(const SeparatorTree& tree, Slot slot, std::size_t direction) const {
    const Slot next = tree.neighbours(slot)[direction];
    return next != kNoSlot && active[next] != 0 && IsLinked(slot, direction);
  }

  std::vector<std::uint8_t> active;        // 1: has a variable
  std::vector<std::uint8_t> links;         // bit by direction, the same on both sides
  std::vector<double> precision;           // sum of lambda_k of its readings, ppm^-2
  std::vector<double> weighted_deviation;  // sum of lambda_k (z_k - m_0), ppm^-1
};

}  // namespace plumescout
