// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/anchored_states.h"

#include <algorithm>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// `states` on the smallest lattice that also covers `other`, unknown where it says nothing.
Grid<CellState> Widened(const Grid<CellState>& states, AnchorCell corner, const GridGeometry& other,
                        AnchorCell other_corner) {
  const int x0 = std::min(corner.x, other_corner.x);
  const int y0 = std::min(corner.y, other_corner.y);
  GridGeometry geometry = states.geometry();
  geometry.origin_x_m += (x0 - corner.x) * geometry.resolution_m;
  geometry.origin_y_m += (y0 - corner.y) * geometry.resolution_m;
  geometry.width = std::max(corner.x + states.width(), other_corner.x + other.width) - x0;
  geometry.height = std::max(corner.y + states.height(), other_corner.y + other.height) - y0;
  Grid<CellState> widened(geometry, CellState::kUnknown);
  for (int y = 0; y < states.height(); ++y) {
    for (int x = 0; x < states.width(); ++x) {
      widened[Cell{x + corner.x - x0, y + corner.y - y0}] = states[Cell{x, y}];
    }
  }
  return widened;
}

}  // namespace

absl::StatusOr<std::vector<std::size_t>> AnchoredStates::Update(const Grid<CellState>& states) {
  if (states.size() == 0 && empty()) return std::vector<std::size_t>{};
  const GridGeometry anchor = empty() ? states.geometry() : anchor_;
  PLUMESCOUT_ASSIGN_OR_RETURN(const AnchorCell corner, CornerOf(states.geometry(), anchor));
  const AnchoredStates old = std::move(*this);
  anchor_ = anchor;
  corner_ = corner;
  states_ = states;
  const auto covered = AnchorRect::Sized(corner, states.width(), states.height());
  const auto before = AnchorRect::Sized(old.corner_, old.states_.width(), old.states_.height());
  if (!covered.Covers(before) && !old.empty()) {
    states_ = Widened(states, corner, old.states_.geometry(), old.corner_);
    corner_ = {std::min(corner.x, old.corner_.x), std::min(corner.y, old.corner_.y)};
  }
  std::vector<std::size_t> changed;
  const bool same_lattice = states_.geometry() == old.states_.geometry();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const bool was_free = same_lattice ? old.states_[i] == CellState::kFree : old.IsFree(At(i));
    if (was_free != (states_[i] == CellState::kFree)) changed.push_back(i);
  }
  return changed;
}

}  // namespace plumescout
