// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_cells.h"

namespace plumescout {
namespace {

// Directions of SeparatorTree::neighbours.
constexpr std::size_t kEast = 0;
constexpr std::size_t kNorth = 1;
constexpr std::size_t Opposite(std::size_t direction) { return direction ^ 2U; }

void SetLink(std::uint8_t& links, std::size_t direction, bool linked) {
  const auto bit = static_cast<std::uint8_t>(1U << direction);
  links = static_cast<std::uint8_t>(linked ? links | bit : links & ~bit);
}

}  // namespace

FieldCells::FieldCells(const SeparatorTree& tree, std::span<const CellInput> inputs)
    : active(inputs.size()),
      links(inputs.size()),
      precision(inputs.size()),
      weighted_deviation(inputs.size()) {
  for (std::size_t i = 0; i < inputs.size(); ++i) Set(tree, {i, inputs[i]});
}

void FieldCells::Set(const SeparatorTree& tree, const CellChange& change) {
  const Slot slot = tree.slot(change.cell);
  active[slot] = change.input.active ? 1 : 0;
  precision[slot] = change.input.precision;
  weighted_deviation[slot] = change.input.weighted_deviation;
  for (const std::size_t direction : {kEast, kNorth}) {
    const bool linked = direction == kEast ? change.input.linked_east : change.input.linked_north;
    SetLink(links[slot], direction, linked);
    const Slot next = tree.neighbours(slot)[direction];
    if (next != kNoSlot) SetLink(links[next], Opposite(direction), linked);
  }
}

CellInput FieldCells::Get(Slot slot) const {
  return {active[slot] != 0, precision[slot], weighted_deviation[slot], IsLinked(slot, kEast),
          IsLinked(slot, kNorth)};
}

}  // namespace plumescout
