// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/gas/field/front_builder.h"
#include "core/gas/field/separator_tree.h"

namespace plumescout {

// Vectors over the slots of a tree, slot by slot; 0 off the active cells.
class SlotColumns {
 public:
  SlotColumns(std::size_t slots, std::size_t columns)
      : columns_(columns), values_(slots * columns, 0.0) {}

  std::size_t slots() const { return values_.size() / columns_; }
  std::size_t columns() const { return columns_; }
  double* row(Slot slot) { return values_.data() + slot * columns_; }
  const double* row(Slot slot) const { return values_.data() + slot * columns_; }

 private:
  std::size_t columns_;  // >= 1
  std::vector<double> values_;
};

// Columns that hold their values on some paths to the root only, so far.
struct PathColumns {
  SlotColumns values;
  std::vector<std::uint32_t> path_nodes;  // ascending
};

// A separator tree with all its nodes eliminated: H^-1 in factored form. A copy shares the fronts,
// which never change; it costs one pointer per node.
class FieldFactor {
 public:
  explicit FieldFactor(std::shared_ptr<const SeparatorTree> tree)
      : tree_(std::move(tree)), fronts_(tree_->nodes().size()) {}

  const SeparatorTree& tree() const { return *tree_; }
  const Front& front(std::size_t node) const { return *fronts_[node]; }

  // Eliminates the nodes anew whose flag is set. REQUIRES: ancestors of a flagged node are flagged;
  // at the first call all are.
  void Eliminate(std::span<const std::uint8_t> dirty, const FieldCells& cells,
                 FrontBuilder& builder);

  // What each node from the owner of an active cell to the root knows of it; at the root that is
  // its mean and variance. Cost: that of reading the fronts.
  std::vector<PathStep> StepsFrom(Slot slot) const;
  // The cell that the steps start from has more evidence. Its nodes are to be eliminated anew when
  // next any is. Cost: that of copying the fronts.
  void AddReading(std::span<const PathStep> steps, double precision, double weighted_deviation);

  // H^-1 e_i for each i in `slots`, on the paths from there. REQUIRES: slots are active, one at
  // least. Cost: that of the paths.
  PathColumns InverseOnPaths(std::span<const Slot> slots) const;
  // Continues columns of H^-1, or combinations of them, to all slots. Cost: all weights.
  SlotColumns Extend(PathColumns columns) const;

  // Multiply-adds of eliminating all nodes. Cost: O(nodes).
  double work() const;

 private:
  friend struct FieldEnginePeer;  // of the tests

  std::shared_ptr<const SeparatorTree> tree_;
  std::vector<std::shared_ptr<const Front>> fronts_;  // by node
};

}  // namespace plumescout
