// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>

#include "core/gas/anchor_cell.h"
#include "core/gas/anchored_states.h"
#include "core/gas/field/cell_input.h"

namespace plumescout {

// A cell of the gas lattice: a square of `factor` x `factor` anchor cells, counted from the same
// corner. Ordered row by row from the south.
struct GasCell {
  int x = 0;
  int y = 0;

  friend bool operator==(const GasCell&, const GasCell&) = default;
  friend std::strong_ordering operator<=>(const GasCell& a, const GasCell& b) {
    return a.y != b.y ? a.y <=> b.y : a.x <=> b.x;
  }
};

inline GasCell GasCellOf(AnchorCell cell, int factor) {
  if (factor == 1) return {cell.x, cell.y};  // nearly always, and divisions take long
  const auto floor_of = [factor](int a) {
    return a >= 0 ? a / factor : -((factor - 1 - a) / factor);
  };
  return {floor_of(cell.x), floor_of(cell.y)};
}

using GasCellRect = CellRectOf<GasCell>;

// The raster of a gas field: gas cells from (x0, y0), in the order in which they are stored.
struct GasLattice {
  int x0 = 0;
  int y0 = 0;
  int width = 0;
  int height = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  GasCellRect cells() const { return GasCellRect::Sized({x0, y0}, width, height); }
  bool Contains(GasCell cell) const { return cells().Contains(cell); }
  // REQUIRES: Contains(cell).
  std::size_t Index(GasCell cell) const {
    return static_cast<std::size_t>(cell.y - y0) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.x - x0);
  }
  GasCell CellAt(std::size_t index) const {
    const auto w = static_cast<std::size_t>(width);
    return {x0 + static_cast<int>(index % w), y0 + static_cast<int>(index / w)};
  }
  friend bool operator==(const GasLattice&, const GasLattice&) = default;
};

// Whether `rect`, and `margin` cells more on each side, lie in the lattice.
bool HasRoom(const GasLattice& lattice, const GasCellRect& rect, int margin);

// The lattice for `rect` with `margin` cells on each side; holds `old` too if that has cells.
GasLattice MakeLattice(const GasLattice& old, const GasCellRect& rect, int margin);

// Activity and links of a gas cell: it has a variable if one of its occupancy cells is free, and a
// factor to the next one if two free cells of theirs touch across the side they share. Evidence is
// left empty. A wall inside a gas cell does not split it.
CellInput StructureOf(const AnchoredStates& states, GasCell cell, int factor);

}  // namespace plumescout
