// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/gas_space.h"

#include <algorithm>
#include <array>

#include "core/grid/neighbours.h"

namespace plumescout::lab {
namespace {

constexpr std::uint8_t kFarthest = 255;

// The neighbours that a walk row by row from the south has already passed; those of the walk back
// are opposite.
constexpr std::array<Cell, 4> kPassed = {{{-1, -1}, {0, -1}, {1, -1}, {-1, 0}}};

void Relax(Cell cell, int sign, Grid<std::uint8_t>& clearance) {
  for (const Cell offset : kPassed) {
    const Cell passed{cell.x + sign * offset.x, cell.y + sign * offset.y};
    const int through = clearance.At(passed, kFarthest) + 1;
    if (through < clearance[cell]) clearance[cell] = static_cast<std::uint8_t>(through);
  }
}

}  // namespace

Grid<GasSpace> GasSpaces(const LayoutRaster& raster) {
  Grid<GasSpace> spaces(raster.occupancy.geometry(), GasSpace::kSolid);
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    if (raster.occupancy[i] == CellState::kFree) {
      spaces[i] = GasSpace::kInside;
    } else if (raster.flow.fluid[i] != 0) {
      spaces[i] = GasSpace::kOutside;
    }
  }
  return spaces;
}

// Two passes are exact for this distance (Rosenfeld and Pfaltz 1966).
Grid<std::uint8_t> Clearances(const Grid<GasSpace>& spaces) {
  Grid<std::uint8_t> clearance(spaces.geometry(), kFarthest);
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    if (spaces[i] == GasSpace::kSolid) clearance[i] = 0;
    Relax(spaces.geometry().CellAtIndex(i), 1, clearance);
  }
  for (std::size_t i = spaces.size(); i-- > 0;) {
    Relax(spaces.geometry().CellAtIndex(i), -1, clearance);
  }
  return clearance;
}

}  // namespace plumescout::lab
