// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_lattice.h"

#include <algorithm>

namespace plumescout {
namespace {

int FloorDivide(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

GasCell GasCellOf(AnchorCell cell, int factor) {
  return {FloorDivide(cell.x, factor), FloorDivide(cell.y, factor)};
}

void GasCellBox::Add(GasCell cell) {
  if (empty()) {
    *this = {cell.x, cell.y, cell.x + 1, cell.y + 1};
    return;
  }
  x0 = std::min(x0, cell.x);
  y0 = std::min(y0, cell.y);
  x1 = std::max(x1, cell.x + 1);
  y1 = std::max(y1, cell.y + 1);
}

bool HasRoom(const GasLattice& lattice, const GasCellBox& box, int margin) {
  return lattice.Contains({box.x0 - margin, box.y0 - margin}) &&
         lattice.Contains({box.x1 - 1 + margin, box.y1 - 1 + margin});
}

GasLattice MakeLattice(const GasLattice& old, const GasCellBox& box, int margin) {
  GasCellBox all = box;
  all.Add({box.x0 - margin, box.y0 - margin});
  all.Add({box.x1 - 1 + margin, box.y1 - 1 + margin});
  if (old.size() > 0) {
    all.Add({old.x0, old.y0});
    all.Add({old.x0 + old.width - 1, old.y0 + old.height - 1});
  }
  return {all.x0, all.y0, all.x1 - all.x0, all.y1 - all.y0};
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
