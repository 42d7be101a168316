// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/escape.h"

#include "core/grid/grid_search.h"
#include "core/grid/mask.h"

namespace plumescout {

std::vector<Cell> EscapePath(const Grid<CellState>& states, const Grid<std::uint8_t>& traversable,
                             Cell start) {
  if (!states.Contains(start)) return {};
  if (traversable[start] != 0) return {start};
  const bool through_unknown = states[start] != CellState::kFree;
  const auto passable = [through_unknown](CellState state) {
    return state == CellState::kFree || (through_unknown && state == CellState::kUnknown);
  };
  return PathToNearest(MaskWhere(states, passable), traversable, start);
}

}  // namespace plumescout
