// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/escape.h"

#include <algorithm>

#include "core/grid/grid_search.h"

namespace plumescout {

std::vector<Cell> EscapePath(const Grid<CellState>& states, const Grid<std::uint8_t>& traversable,
                             Cell start) {
  if (!states.Contains(start)) return {};
  if (traversable[start] != 0) return {start};
  const bool through_unknown = states[start] != CellState::kFree;
  Grid<std::uint8_t> passable(states.geometry());
  std::transform(states.values().begin(), states.values().end(), passable.values().begin(),
                 [through_unknown](CellState state) {
                   const bool ok = state == CellState::kFree ||
                                   (through_unknown && state == CellState::kUnknown);
                   return static_cast<std::uint8_t>(ok ? 1 : 0);
                 });
  return PathToNearest(passable, traversable, start);
}

}  // namespace plumescout
