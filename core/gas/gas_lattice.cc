// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_lattice.h"

namespace plumescout {

bool HasRoom(const GasLattice& lattice, const GasCellRect& rect, int margin) {
  return lattice.cells().Covers(rect.Grown(margin));
}

GasLattice MakeLattice(const GasLattice& old, const GasCellRect& rect, int margin) {
  GasCellRect all = rect.Grown(margin);
  if (old.size() > 0) all = all.With(old.cells());
  return {all.min.x, all.min.y, all.width(), all.height()};
}

CellInput StructureOf(const AnchoredStates& states, GasCell gas_cell, int factor) {
  const AnchorCell low{gas_cell.x * factor, gas_cell.y * factor};
  // Two single cells that are both free always touch.
  const bool single = factor == 1;
  CellInput input{.active = false, .linked_east = single, .linked_north = single};
  for (int y = 0; y < factor; ++y) {
    for (int x = 0; x < factor; ++x) {
      const AnchorCell cell{low.x + x, low.y + y};
      if (!states.IsFree(cell)) continue;
      input.active = true;
      if (x == factor - 1 && states.IsFree({cell.x + 1, cell.y})) input.linked_east = true;
      if (y == factor - 1 && states.IsFree({cell.x, cell.y + 1})) input.linked_north = true;
    }
  }
  return input;
}

}  // namespace plumescout
