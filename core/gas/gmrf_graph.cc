// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gmrf_graph.h"

#include "core/gas/gas_lattice.h"

namespace plumescout {
namespace {

// Squares of `factor` x `factor` cells over a grid.
class Squares {
 public:
  Squares(const GridGeometry& cells, AnchorCell corner, int factor)
      : corner_(corner), factor_(factor), first_(GasCellOf(corner, factor)), geometry_(cells) {
    geometry_.resolution_m *= factor;
    geometry_.origin_x_m -= (corner.x - first_.x * factor) * cells.resolution_m;
    geometry_.origin_y_m -= (corner.y - first_.y * factor) * cells.resolution_m;
    if (cells.size() == 0) return;
    const Cell last = Of({cells.width - 1, cells.height - 1});
    geometry_.width = last.x + 1;
    geometry_.height = last.y + 1;
  }

  const GridGeometry& geometry() const { return geometry_; }
  Cell Of(Cell cell) const {
    const GasCell square = GasCellOf({corner_.x + cell.x, corner_.y + cell.y}, factor_);
    return {square.x - first_.x, square.y - first_.y};
  }

 private:
  AnchorCell corner_;
  int factor_;
  GasCell first_;
  GridGeometry geometry_;
};

// What is said of a square.
struct Square {
  bool free = false;
  bool linked_east = false;
  bool linked_north = false;
};

std::vector<Square> Look(const Grid<CellState>& states, const Squares& squares) {
  std::vector<Square> seen(squares.geometry().size());
  for (std::size_t index = 0; index < states.size(); ++index) {
    if (states[index] != CellState::kFree) continue;
    const Cell cell = states.geometry().CellAtIndex(index);
    const Cell own = squares.Of(cell);
    Square& square = seen[squares.geometry().Index(own)];
    square.free = true;
    const auto reaches = [&](Cell next) {
      return states.At(next, CellState::kUnknown) == CellState::kFree && squares.Of(next) != own;
    };
    square.linked_east = square.linked_east || reaches({cell.x + 1, cell.y});
    square.linked_north = square.linked_north || reaches({cell.x, cell.y + 1});
  }
  return seen;
}

}  // namespace

GmrfGraph::GmrfGraph(const Grid<CellState>& states, AnchorCell corner, int factor) {
  const Squares squares(states.geometry(), corner, factor);
  const std::vector<Square> seen = Look(states, squares);
  geometry_ = squares.geometry();
  variable_.assign(seen.size(), VariableIndex::kNone);
  for (std::size_t index = 0; index < seen.size(); ++index) {
    if (!seen[index].free) continue;
    variable_[index] = static_cast<VariableIndex>(cell_index_.size());
    cell_index_.push_back(index);
  }
  later_neighbours_.reserve(cell_index_.size());
  for (const std::size_t index : cell_index_) {
    const Cell cell = geometry_.CellAtIndex(index);
    constexpr VariableIndex kNone = VariableIndex::kNone;
    later_neighbours_.push_back({seen[index].linked_east ? At({cell.x + 1, cell.y}) : kNone,
                                 seen[index].linked_north ? At({cell.x, cell.y + 1}) : kNone});
  }
}

}  // namespace plumescout
