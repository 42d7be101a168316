// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/flood.h"

#include "core/grid/padded.h"

namespace plumescout {
namespace {

// Spreads labels (0, 1, ...) over a padded raster of kBlocked, kUnreached or a label.
template <typename Label>
class Flood {
 public:
  Flood(const Grid<std::uint8_t>& passable, Connectivity connectivity)
      : labels_(PaddedFrom<Label>(passable, kBlocked,
                                  [](std::uint8_t ok) { return ok != 0 ? kUnreached : kBlocked; })),
        offsets_(labels_.NeighbourOffsets()),
        connectivity_(connectivity) {}

  const Padded<Label>& labels() const { return labels_; }

  // Labels all that is connected to `start` and not labelled yet. Returns the number of cells.
  int Spread(Cell start, Label label) {
    const int first = labels_.IndexOf(start);
    if (labels_[first] != kUnreached) return 0;
    int count = 1;
    labels_[first] = label;
    stack_.assign(1, first);
    while (!stack_.empty()) {
      const int cell = stack_.back();
      stack_.pop_back();
      count += SpreadFrom(cell, label);
    }
    return count;
  }

 private:
  int SpreadFrom(int cell, Label label) {
    int count = 0;
    const std::size_t steps = connectivity_ == Connectivity::kFour ? kNeighbours4.size() : 8;
    for (std::size_t k = 0; k < steps; ++k) {
      const int neighbour = cell + offsets_[k];
      if (labels_[neighbour] != kUnreached || CutsCorner(cell, k)) continue;
      labels_[neighbour] = label;
      stack_.push_back(neighbour);
      ++count;
    }
    return count;
  }

  bool CutsCorner(int cell, std::size_t k) const {
    const Cell offset = kNeighbours8[k];
    return connectivity_ == Connectivity::kEightNoCornerCut && IsDiagonal(offset) &&
           (labels_[cell + offset.x] == kBlocked ||
            labels_[cell + offset.y * labels_.stride()] == kBlocked);
  }

  static constexpr Label kBlocked = -2;
  static constexpr Label kUnreached = -1;

  Padded<Label> labels_;
  std::array<int, 8> offsets_;
  Connectivity connectivity_;
  std::vector<int> stack_;
};

}  // namespace

Grid<std::uint8_t> ReachableCells(const Grid<std::uint8_t>& passable,
                                  const std::vector<Cell>& starts, Connectivity connectivity) {
  Flood<std::int8_t> flood(passable, connectivity);
  for (const Cell start : starts) {
    if (passable.Contains(start)) flood.Spread(start, 0);
  }
  return GridFrom<std::uint8_t>(flood.labels(), passable.geometry(), [](std::int8_t label) {
    return static_cast<std::uint8_t>(label >= 0 ? 1 : 0);
  });
}

Components ConnectedComponents(const Grid<std::uint8_t>& passable, Connectivity connectivity) {
  Flood<int> flood(passable, connectivity);
  Components components;
  for (std::size_t i = 0; i < passable.size(); ++i) {
    if (passable[i] == 0) continue;
    const int label = static_cast<int>(components.sizes.size());
    const int count = flood.Spread(passable.geometry().CellAtIndex(i), label);
    if (count > 0) components.sizes.push_back(count);
  }
  components.label = GridFrom<int>(flood.labels(), passable.geometry(), [](int label) {
    return label >= 0 ? label : Components::kNone;
  });
  return components;
}

}  // namespace plumescout
