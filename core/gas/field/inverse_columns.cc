// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/inverse_columns.h"

#include <algorithm>
#include <utility>

#include "core/linalg/dense_kernel.h"

namespace plumescout {

InverseColumns::InverseColumns(const FieldFactor& factor, ReadingPaths paths)
    : factor_(&factor), paths_(std::move(paths)), stride_(TileRows(paths_.cells())) {}

void InverseColumns::Mix(std::vector<double> matrix, std::size_t stride) {
  mix_ = std::move(matrix);
  mix_stride_ = stride;
}

void InverseColumns::SubtractSquares(double limit, std::vector<double>& by_slot,
                                     const StopFn& stop) {
  class Subtraction final : public Visitor {
   public:
    Subtraction(double limit, std::vector<double>& by_slot, const StopFn& stop)
        : limit_(limit), by_slot_(by_slot), stop_(stop) {}
    bool Enter(std::size_t, std::span<const double> squares) override {
      constexpr int kNodesPerStop = 16;
      stopped_ = stopped_ || (asked_++ % kNodesPerStop == 0 && Stops(stop_));
      return !stopped_ && *std::max_element(squares.begin(), squares.end()) > limit_;
    }
    void Take(std::span<const Slot> own, std::span<const double> squares) override {
      for (std::size_t i = 0; i < own.size(); ++i) by_slot_[own[i]] -= squares[i];
    }

   private:
    const double limit_;
    std::vector<double>& by_slot_;
    const StopFn& stop_;
    int asked_ = 0;
    bool stopped_ = false;
  };
  Subtraction subtraction(limit, by_slot, stop);
  Descend(subtraction);
}

void InverseColumns::Descend(Visitor& visitor) {
  DescendBelow(factor_->tree().nodes().size() - 1, 0, true, visitor);
}

void InverseColumns::DescendBelow(std::size_t node, std::size_t depth, bool on_path,
                                  Visitor& visitor) {
  const Front& front = factor_->front(node);
  const ReadingPaths::Step* const step = on_path ? paths_.StepAt(node) : nullptr;
  if (step == nullptr && front.boundary() == 0) return;
  if (blocks_.size() <= depth) blocks_.resize(depth + 1);
  Block& block = blocks_[depth];
  block.squares.resize(std::max(block.squares.size(), front.cells.size()));
  if (front.boundary() > 0) GatherSquares(front, node, depth);
  const std::span<const double> on_boundary = {block.squares.data() + front.own, front.boundary()};
  if (step == nullptr && !visitor.Enter(node, on_boundary)) return;
  GatherRows(front, depth);
  Continue(front, block);
  if (step != nullptr) AddOwn(*step, front, block);
  for (std::size_t i = 0; i < front.own; ++i) {
    const double* const row = block.rows.data() + i * stride_;
    block.squares[i] = Dot(row, row, stride_);
  }
  visitor.Take(front.own_cells(), {block.squares.data(), front.own});
  const SeparatorTree::Node& place = factor_->tree().nodes()[node];
  if (place.is_leaf()) return;
  for (const std::uint32_t child : place.children) factor_->front(child).Prefetch();
  for (const std::uint32_t child : place.children) {
    DescendBelow(child, depth + 1, step != nullptr, visitor);
  }
}

void InverseColumns::GatherSquares(const Front& front, std::size_t node, std::size_t depth) {
  FindPlaces(front.boundary_cells(), factor_->front(factor_->tree().nodes()[node].parent).cells,
             place_);
  const std::vector<double>& from = blocks_[depth - 1].squares;
  double* const to = blocks_[depth].squares.data() + front.own;
  for (std::size_t i = 0; i < front.boundary(); ++i) to[i] = from[place_[i]];
}

void InverseColumns::GatherRows(const Front& front, std::size_t depth) {
  Block& block = blocks_[depth];
  block.rows.resize(std::max(block.rows.size(), front.cells.size() * stride_));
  double* to = block.rows.data() + front.own * stride_;
  for (std::size_t i = 0; i < front.boundary(); ++i, to += stride_) {
    std::copy_n(blocks_[depth - 1].rows.data() + place_[i] * stride_, stride_, to);
  }
}

// x_S = W x_R
void InverseColumns::Continue(const Front& front, Block& block) {
  if (front.boundary() == 0 || front.own == 0) {
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

// x_S += M p, with p the covariances of S and the cells of the paths, given R.
void InverseColumns::AddOwn(const ReadingPaths::Step& step, const Front& front,
                            Block& block) const {
  if (mix_.empty()) {
    for (std::size_t i = 0; i < front.own; ++i) {
      const double* const own = step.own + i * step.stride();
      double* const row = block.rows.data() + i * stride_ + step.first;
      for (std::size_t j = 0; j < step.cells; ++j) row[j] += own[j];
    }
    return;
  }
  const std::size_t above = step.first / kRowTile * kRowTile;  // rows of M that are 0
  Accumulate({.a = mix_.data() + step.first * mix_stride_ + above,
              .a_stride = mix_stride_,
              .b = step.own,
              .b_row_stride = 1,
              .b_column_stride = step.stride(),
              .c = block.rows.data() + above,
              .c_stride = stride_,
              .rows = stride_ - above,
              .columns = front.own,
              .depth = step.cells});
}

}  // namespace plumescout
