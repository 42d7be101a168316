// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/gas/anchor_cell.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"

namespace plumescout {

// Row of the linear system: m_i of [IPP] Eq. (1). Not a cell of the grid.
enum class VariableIndex : int { kNone = -1 };

constexpr std::size_t ToSize(VariableIndex variable) { return static_cast<std::size_t>(variable); }

// Nodes and prior factors of the Markov random field: a variable for each free cell, in the order
// of cell indices, and a factor between any two that share an edge ([IPP] section II, Fig. 1). A
// wall or an unknown cell has no variable and so cuts the factors through it.
class GmrfGraph {
 public:
  GmrfGraph() = default;
  explicit GmrfGraph(const Grid<CellState>& states) : GmrfGraph(states, {}, 1) {}
  // The same for squares of `factor` x `factor` cells, one of which begins at the anchor: cell
  // (0, 0) of the grid is the anchor cell `corner`. A square is free if one of its cells is, and
  // two share an edge if two free cells of theirs do. geometry() is then that of the squares.
  GmrfGraph(const Grid<CellState>& states, AnchorCell corner, int factor);

  const GridGeometry& geometry() const { return geometry_; }
  int variables() const { return static_cast<int>(cell_index_.size()); }

  // kNone off the free cells and beyond the grid.
  VariableIndex At(Cell cell) const {
    return geometry_.Contains(cell) ? variable_[geometry_.Index(cell)] : VariableIndex::kNone;
  }
  // The cell of a variable, as index into the grid.
  std::size_t cell_index(VariableIndex variable) const { return cell_index_[ToSize(variable)]; }

  // The neighbours east and north, or kNone: each prior factor once, indices ascending.
  const std::array<VariableIndex, 2>& later_neighbours(VariableIndex variable) const {
    return later_neighbours_[ToSize(variable)];
  }

 private:
  GridGeometry geometry_;
  std::vector<VariableIndex> variable_;  // by cell index
  std::vector<std::size_t> cell_index_;  // by variable
  std::vector<std::array<VariableIndex, 2>> later_neighbours_;
};

}  // namespace plumescout
