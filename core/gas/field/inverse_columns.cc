// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/inverse_columns.h"

#include <algorithm>
#include <utility>

#include "core/linalg/dense_kernel.h"

namespace plumescout {

InverseColumns::InverseColumns(const FieldFactor& factor, std::span<const Slot> slots,
                               const StopFn& stop)
    : factor_(&factor), columns_(slots.size()), stride_(TileRows(slots.size())) {
  PlacePaths(slots, stop);
  CompletePath(factor.tree().nodes().size() - 1, 0, stop);
}

// What each cell contributes to the nodes on its own path, given that their boundary is 0.
void InverseColumns::PlacePaths(std::span<const Slot> slots, const StopFn& stop) {
  std::vector<std::vector<PathStep>> paths;
  for (const Slot slot : slots) {
    if (Stops(stop)) return;
    paths.push_back(factor_->StepsFrom(slot));
    for (const PathStep& step : paths.back()) path_nodes_.push_back(step.node);
  }
  std::sort(path_nodes_.begin(), path_nodes_.end());
  path_nodes_.erase(std::unique(path_nodes_.begin(), path_nodes_.end()), path_nodes_.end());
  std::size_t size = 0;
  for (const std::uint32_t node : path_nodes_) {
    first_.push_back(size);
    size += factor_->front(node).own * stride_;
  }
  path_rows_.assign(size, 0.0);
  for (std::size_t j = 0; j < columns_; ++j) {
    for (const PathStep& step : paths[j]) {
      double* row = path_rows_.data() + FirstOf(step.node);
      for (const double value : step.own) {
        row[j] = value;
        row += stride_;
      }
    }
  }
}

std::size_t InverseColumns::FirstOf(std::size_t node) const {
  const auto at = std::lower_bound(path_nodes_.begin(), path_nodes_.end(), node);
  if (at == path_nodes_.end() || *at != node) return kOffPaths;
  return first_[static_cast<std::size_t>(at - path_nodes_.begin())];
}

double InverseColumns::At(Slot slot, std::size_t column) const {
  const std::uint32_t node = factor_->tree().owner(slot);
  const std::span<const Slot> own = factor_->front(node).own_cells();
  const auto row =
      static_cast<std::size_t>(std::lower_bound(own.begin(), own.end(), slot) - own.begin());
  return path_rows_[FirstOf(node) + row * stride_ + column];
}

// Adds what comes from the boundary, to a node on a path and those below it.
void InverseColumns::CompletePath(std::size_t node, std::size_t depth, const StopFn& stop) {
  if (Stops(stop)) return;
  const std::size_t first = FirstOf(node);
  if (first == kOffPaths) return;
  GatherBoundary(node, depth);
  const Front& front = factor_->front(node);
  Block& block = blocks_[depth];
  Continue(front, block);
  for (std::size_t i = 0; i < front.own * stride_; ++i) {
    block.rows[i] = path_rows_[first + i] += block.rows[i];
  }
  if (factor_->tree().nodes()[node].is_leaf()) return;
  for (const std::uint32_t child : factor_->tree().nodes()[node].children) {
    CompletePath(child, depth + 1, stop);
  }
}

void InverseColumns::Mix(const double* matrix, std::size_t stride) {
  std::vector<double> mixed(path_rows_.size());
  Accumulate({.a = matrix,
              .a_stride = stride,
              .b = path_rows_.data(),
              .b_column_stride = stride_,
              .c = mixed.data(),
              .c_stride = stride_,
              .rows = stride_,
              .columns = path_rows_.size() / stride_,
              .depth = columns_,
              .overwrite = true});
  path_rows_ = std::move(mixed);
}

void InverseColumns::SubtractSquares(double limit, std::vector<double>& by_cell,
                                     const StopFn& stop) {
  class Subtraction final : public Visitor {
   public:
    Subtraction(const SeparatorTree& tree, double limit, std::vector<double>& by_cell,
                const StopFn& stop)
        : tree_(tree), limit_(limit), by_cell_(by_cell), stop_(stop) {}
    bool Enter(std::size_t, std::span<const double> squares) override {
      constexpr int kNodesPerStop = 16;
      stopped_ = stopped_ || (asked_++ % kNodesPerStop == 0 && Stops(stop_));
      return !stopped_ && *std::max_element(squares.begin(), squares.end()) > limit_;
    }
    void Take(std::span<const Slot> own, std::span<const double> squares) override {
      for (std::size_t i = 0; i < own.size(); ++i) by_cell_[tree_.cell(own[i])] -= squares[i];
    }

   private:
    const SeparatorTree& tree_;
    const double limit_;
    std::vector<double>& by_cell_;
    const StopFn& stop_;
    int asked_ = 0;
    bool stopped_ = false;
  };
  Subtraction subtraction(factor_->tree(), limit, by_cell, stop);
  Descend(subtraction);
}

void InverseColumns::Descend(Visitor& visitor) {
  DescendBelow(factor_->tree().nodes().size() - 1, 0, visitor);
}

void InverseColumns::DescendBelow(std::size_t node, std::size_t depth, Visitor& visitor) {
  GatherBoundary(node, depth);
  const SeparatorTree& tree = factor_->tree();
  const Front& front = factor_->front(node);
  Block& block = blocks_[depth];
  if (const std::size_t first = FirstOf(node); first != kOffPaths) {
    std::copy_n(path_rows_.data() + first, front.own * stride_, block.rows.data());
  } else {
    if (front.boundary() == 0) return;
    if (!visitor.Enter(node, {block.squares.data() + front.own, front.boundary()})) return;
    Continue(front, block);
  }
  for (std::size_t i = 0; i < front.own; ++i) {
    const double* const row = block.rows.data() + i * stride_;
    block.squares[i] = Dot(row, row, stride_);
  }
  visitor.Take(front.own_cells(), {block.squares.data(), front.own});
  if (tree.nodes()[node].is_leaf()) return;
  for (const std::uint32_t child : tree.nodes()[node].children) {
    factor_->front(child).Prefetch();
  }
  for (const std::uint32_t child : tree.nodes()[node].children) {
    DescendBelow(child, depth + 1, visitor);
  }
}

// Out of the block of the parent, into that of the node.
void InverseColumns::GatherBoundary(std::size_t node, std::size_t depth) {
  if (blocks_.size() <= depth) blocks_.resize(depth + 1);
  const Front& front = factor_->front(node);
  Block& block = blocks_[depth];
  const std::size_t size = front.cells.size();
  block.rows.resize(std::max(block.rows.size(), size * stride_));
  block.squares.resize(std::max(block.squares.size(), size));
  if (front.boundary() == 0) return;
  const Block& from = blocks_[depth - 1];
  FindPlaces(front.boundary_cells(), factor_->front(factor_->tree().nodes()[node].parent).cells,
             place_);
  double* to = block.rows.data() + front.own * stride_;
  for (std::size_t i = 0; i < front.boundary(); ++i, to += stride_) {
    std::copy_n(from.rows.data() + place_[i] * stride_, stride_, to);
    block.squares[front.own + i] = from.squares[place_[i]];
  }
}

// x_S = W x_R
void InverseColumns::Continue(const Front& front, Block& block) {
  if (front.boundary() == 0) {
    std::fill_n(block.rows.begin(), front.own * stride_, 0.0);
    return;
  }
  Accumulate({.a = block.rows.data() + front.own * stride_,
              .a_stride = stride_,
              .b = front.Weights(weights_),
              .b_row_stride = front.own,
              .b_column_stride = 1,
              .c = block.rows.data(),
              .c_stride = stride_,
              .rows = stride_,
              .columns = front.own,
              .depth = front.boundary(),
              .overwrite = true});
}

}  // namespace plumescout
