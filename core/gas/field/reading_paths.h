// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/gas/field/front.h"
#include "core/gas/field/separator_tree.h"
#include "core/linalg/room.h"
#include "core/types/stop.h"

namespace plumescout {

class FieldFactor;

// Some cells as the nodes see them that lie on their paths to the root of a factor: what
// FieldFactor::StepsFrom says of one, of all of them together. Slots of a subtree follow each
// other, so of cells in the order of their slots those of a subtree do too.
class ReadingPaths {
 public:
  // Of the cells in the subtree of a node, given its boundary. A row has one element for each of
  // these cells, is 0 beyond them, and TileRows(cells) elements follow it to the next.
  struct Step {
    std::uint32_t node = 0;
    std::size_t first = 0;  // cells [first, first + cells)
    std::size_t cells = 0;
    const double* own = nullptr;       // row by own cell of the front: covariances
    const double* boundary = nullptr;  // row by boundary cell: its weights in the means
    const double* among = nullptr;     // lower triangle, by columns: covariances between them

    std::size_t stride() const { return TileRows(cells); }
  };

  // REQUIRES: `slots` are active, ascending, one at least; some may be the same. Of no use once
  // `stop`, which is asked all along, says so. Takes the memory of those that are `used` no more.
  // Cost: that of reading the fronts of the paths once.
  ReadingPaths(const FieldFactor& factor, std::span<const Slot> slots, const StopFn& stop = {},
               std::optional<ReadingPaths> used = std::nullopt);
  ReadingPaths(ReadingPaths&&) = default;
  ReadingPaths& operator=(ReadingPaths&&) = default;

  std::size_t cells() const { return steps_.back().cells; }
  // By node, ascending. At the last, the root, `among` is the covariance of the cells.
  std::span<const Step> steps() const { return steps_; }
  const Step* StepAt(std::size_t node) const;  // null: off the paths

 private:
  // Those of Step in values_.
  struct Rows {
    double* own = nullptr;
    double* boundary = nullptr;
    double* among = nullptr;
  };

  void FindSteps(const FieldFactor& factor, std::span<const Slot> slots);
  Rows RowsOf(const Step& step, const Front& front);
  void TakeLeaf(const Front& front, std::span<const Slot> slots, const Step& step);
  void TakeInner(const Front& front, const Step& step);
  void GatherWeights(const FieldFactor& factor, std::span<const Slot> slots, const Step& step);

  std::vector<Step> steps_;
  Room values_;

  // Of the present step.
  std::vector<double> weights_;  // row by cell of the front: its weights in the means
  std::vector<double> covariance_;
};

}  // namespace plumescout
