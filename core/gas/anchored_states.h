// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/anchor_cell.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/stop.h"

namespace plumescout {

// The newest occupancy states, and what changed in them. The first grid with cells is the anchor.
class AnchoredStates {
 public:
  // Takes `states` over. Returns the indices into states() of the cells that became free or are so
  // no more, ascending. Errors, with nothing changed: those of CornerOf. Cost: O(cells).
  absl::StatusOr<std::vector<std::size_t>> Update(const Grid<CellState>& states);

  bool empty() const { return states_.size() == 0; }
  const GridGeometry& anchor() const { return anchor_; }  // no cells: none yet
  // Of the last update; if it left out cells that were known before, those too, as unknown.
  const Grid<CellState>& states() const { return states_; }
  AnchorCell At(std::size_t index) const {
    const Cell cell = states_.geometry().CellAtIndex(index);
    return {cell.x + corner_.x, cell.y + corner_.y};
  }
  // A cell of states(), or beside it.
  Cell CellAt(AnchorCell cell) const { return {cell.x - corner_.x, cell.y - corner_.y}; }
  bool IsFree(AnchorCell cell) const {
    return states_.At(CellAt(cell), CellState::kUnknown) == CellState::kFree;
  }

  // visit(index into states(), AnchorCell) of each free cell, in order: what At says of all of
  // them, without its divisions.
  template <typename Visit>
  void ForEachFree(const Visit& visit, const StopFn& stop = {}) const {
    std::size_t index = 0;
    const GridGeometry& geometry = states_.geometry();
    ByRows(corner_.y, corner_.y + geometry.height, geometry.width, stop, [&](int y) {
      for (int x = corner_.x; x < corner_.x + geometry.width; ++x, ++index) {
        if (states_[index] == CellState::kFree) visit(index, AnchorCell{x, y});
      }
    });
  }

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  GridGeometry anchor_;
  Grid<CellState> states_;
  AnchorCell corner_;  // of states_
};

}  // namespace plumescout
