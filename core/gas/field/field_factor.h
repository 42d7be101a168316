// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/gas/field/front.h"
#include "core/gas/field/separator_tree.h"

namespace plumescout {

// Vectors over the slots of a tree, one after the other; 0 off the active cells.
class SlotColumns {
 public:
  SlotColumns(std::size_t slots, std::size_t columns)
      : stride_(TileRows(slots)), columns_(columns), values_(stride_ * columns, 0.0) {}

  std::size_t stride() const { return stride_; }
  std::size_t columns() const { return columns_; }
  double* column(std::size_t j) { return values_.data() + j * stride_; }
  const double* column(std::size_t j) const { return values_.data() + j * stride_; }

 private:
  std::size_t stride_;
  std::size_t columns_;
  std::vector<double> values_;
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

  // H^-1 e_i for each i in `slots`, which are active. Cost: one pass over all weights.
  SlotColumns InverseColumns(std::span<const Slot> slots) const;

  // m_i of an active slot. Cost: a path.
  double Mean_ppm(Slot slot) const;

 private:
  void Ascend(Slot slot, double* x) const;
  void Descend(SlotColumns& x) const;

  std::shared_ptr<const SeparatorTree> tree_;
  std::vector<std::shared_ptr<const Front>> fronts_;  // by node
};

}  // namespace plumescout
