// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/flood.h"

#include <cstddef>

#include "core/grid/padded.h"

namespace plumescout {
namespace {

// Spreads labels (0, 1, ...) over a padded raster of kBlocked, kUnreached or a label, by runs:
// cells of a row that lie side by side. Where corners are not cut a diagonal step is two straight
// ones, so that runs are connected as if there were none.
template <typename Label>
class Flood {
 public:
  Flood(const Grid<std::uint8_t>& passable, Connectivity connectivity)
      : labels_(PaddedFrom<Label>(passable, kBlocked,
                                  [](std::uint8_t ok) { return ok != 0 ? kUnreached : kBlocked; })),
        aside_(connectivity == Connectivity::kEight ? 1 : 0) {}

  const Padded<Label>& labels() const { return labels_; }

  // Labels all that is connected to `start` and not labelled yet. Returns the number of cells.
  int Spread(Cell start, Label label, const StopFn& stop = {}) {
    int count = 0;
    std::size_t since_stop = 0;
    stack_.assign(1, labels_.IndexOf(start));
    while (!stack_.empty()) {
      const int cell = stack_.back();
      stack_.pop_back();
      const int run = labels_[cell] == kUnreached ? LabelRun(cell, label) : 0;
      count += run;
      since_stop += 1 + static_cast<std::size_t>(run);
      if (since_stop < kCellsPerStop) continue;
      if (Stops(stop)) break;
      since_stop = 0;
    }
    return count;
  }

 private:
  // That of the cell. Its neighbours are for later.
  int LabelRun(int cell, Label label) {
    int begin = cell;
    int end = cell + 1;
    while (labels_[begin - 1] == kUnreached) --begin;
    while (labels_[end] == kUnreached) ++end;
    for (int i = begin; i < end; ++i) labels_[i] = label;
    for (const int row : {-labels_.stride(), labels_.stride()}) {
      PushRuns(begin - aside_ + row, end + aside_ + row);
    }
    return end - begin;
  }

  void PushRuns(int begin, int end) {
    bool in_run = false;
    for (int cell = begin; cell < end; ++cell) {
      const bool is_open = labels_[cell] == kUnreached;
      if (is_open && !in_run) stack_.push_back(cell);
      in_run = is_open;
    }
  }

  static constexpr Label kBlocked = -2;
  static constexpr Label kUnreached = -1;

  Padded<Label> labels_;
  const int aside_;  // how far beside a run cells of the next row are its neighbours
  std::vector<int> stack_;
};

}  // namespace

Grid<std::uint8_t> ReachableCells(const Grid<std::uint8_t>& passable,
                                  const std::vector<Cell>& starts, Connectivity connectivity,
                                  const StopFn& stop) {
  if (Stops(stop)) return Grid<std::uint8_t>(passable.geometry(), 0);
  Flood<std::int8_t> flood(passable, connectivity);
  for (const Cell start : starts) {
    if (Stops(stop)) break;
    if (passable.Contains(start)) flood.Spread(start, 0, stop);
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
