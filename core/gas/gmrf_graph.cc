// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gmrf_graph.h"

namespace plumescout {

GmrfGraph::GmrfGraph(const Grid<CellState>& states)
    : geometry_(states.geometry()), variable_(states.size(), VariableIndex::kNone) {
  for (std::size_t index = 0; index < states.size(); ++index) {
    if (states[index] != CellState::kFree) continue;
    variable_[index] = static_cast<VariableIndex>(cell_index_.size());
    cell_index_.push_back(index);
  }
  later_neighbours_.reserve(cell_index_.size());
  for (const std::size_t index : cell_index_) {
    const Cell cell = geometry_.CellAtIndex(index);
    later_neighbours_.push_back({At({cell.x + 1, cell.y}), At({cell.x, cell.y + 1})});
  }
}

}  // namespace plumescout
