// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/inverse_columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/linalg/dense_kernel.h"

namespace plumescout {

InverseColumns::InverseColumns(const FieldFactor& factor, ReadingPaths paths,
                               std::optional<InverseColumns> used)
    : factor_(&factor), paths_(std::move(paths)), stride_(TileRows(paths_.cells())) {
  if (!used) return;
  blocks_ = std::move(used->blocks_);
  weights_ = std::move(used->weights_);
  left_ = std::move(used->left_);
  lower_ = std::move(used->lower_);
}

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
  constexpr double kSlackShare = 1e-3;
  const double slack = kSlackShare * limit;
  Subtraction subtraction(limit - slack, by_slot, stop);
  Descend(subtraction, slack);
}

void InverseColumns::Descend(Visitor& visitor, double slack) {
  slack_ = slack;
  DescendBelow(factor_->tree().nodes().size() - 1, 0, true, visitor);
}

void InverseColumns::DescendBelow(std::size_t node, std::size_t depth, bool on_path,
                                  Visitor& visitor) {
  const Front& front = factor_->front(node);
  const ReadingPaths::Step* const step = on_path ? paths_.StepAt(node) : nullptr;
  if (step == nullptr && front.boundary() == 0) return;
  if (blocks_.size() <= depth) blocks_.resize(depth + 1);
  Block& block = blocks_[depth];
  block.squares.For(front.cells.size());
  if (front.boundary() > 0) GatherSquares(front, node, depth);
  const std::span<const double> on_boundary = {block.squares.data() + front.own, front.boundary()};
  if (step == nullptr && !visitor.Enter(node, on_boundary)) return;
  const SeparatorTree::Node& place = factor_->tree().nodes()[node];
  GatherRows(front, depth);
  if (step == nullptr && !place.is_leaf()) Compress(front, block);
  Continue(front, block);
  if (step != nullptr) AddOwn(*step, front, block);
  for (std::size_t i = 0; i < front.own; ++i) {
    const double* const row = block.rows.data() + i * block.stride;
    block.squares.data()[i] = Dot(row, row, block.stride);
  }
  visitor.Take(front.own_cells(), {block.squares.data(), front.own});
  if (place.is_leaf()) return;
  for (const std::uint32_t child : place.children) factor_->front(child).Prefetch();
  for (const std::uint32_t child : place.children) {
    DescendBelow(child, depth + 1, step != nullptr, visitor);
  }
}

void InverseColumns::GatherSquares(const Front& front, std::size_t node, std::size_t depth) {
  place_ = factor_->PlacesInParent(node);
  const double* const from = blocks_[depth - 1].squares.data();
  double* const to = blocks_[depth].squares.data() + front.own;
  for (std::size_t i = 0; i < front.boundary(); ++i) to[i] = from[place_[i]];
}

void InverseColumns::GatherRows(const Front& front, std::size_t depth) {
  Block& block = blocks_[depth];
  const std::size_t stride = block.stride = depth == 0 ? stride_ : blocks_[depth - 1].stride;
  block.slack = depth == 0 ? slack_ : blocks_[depth - 1].slack;
  double* to = block.rows.For(front.cells.size() * stride) + front.own * stride;
  const double* const rows = depth == 0 ? nullptr : blocks_[depth - 1].rows.data();
  for (std::size_t i = 0; i < front.boundary(); ++i) {
    const double* const row = rows + place_[i] * stride;
    // Tile by tile: rows are short, and a copy of no known size is a call.
    for (std::size_t j = 0; j < stride; j += kRowTile, to += kRowTile) {
      std::memcpy(to, row + j, kRowTile * sizeof(double));
    }
  }
}

// Off the paths only X X^T counts, with X the rows on the boundary, and from afar these are much
// alike: L L^T is as good with a column for each pivot of a Cholesky factorisation that takes the
// longest row that is left first. What is left is positive semidefinite, so by W >= 0 with row sums
// of at most 1 no square below becomes less by more than the most there is on its diagonal.
void InverseColumns::Compress(const Front& front, Block& block) {
  const std::size_t size = front.boundary();
  const std::size_t stride = block.stride;
  if (block.slack <= 0.0 || stride <= kRowTile) return;
  const double slack = block.slack / 2.0;
  const std::size_t most = stride - kRowTile;  // more would spare nothing
  const double* const rows = block.rows.data() + front.own * stride;
  left_.assign(block.squares.data() + front.own, block.squares.data() + front.cells.size());
  lower_.assign(size * most, 0.0);
  for (std::size_t rank = 0; rank <= most; ++rank) {
    const auto longest = std::max_element(left_.begin(), left_.end());
    if (*longest <= slack) {
      block.slack -= slack;
      block.stride = std::max(kRowTile, TileRows(rank));
      for (std::size_t i = 0; i < size; ++i) {
        std::copy_n(lower_.data() + i * most, block.stride,
                    block.rows.data() + (front.own + i) * block.stride);
      }
      return;
    }
    if (rank == most) return;
    const auto pivot = static_cast<std::size_t>(longest - left_.begin());
    const double scale = 1.0 / std::sqrt(*longest);
    for (std::size_t i = 0; i < size; ++i) {
      double* const low = lower_.data() + i * most;
      low[rank] = scale * (Dot(rows + i * stride, rows + pivot * stride, stride) -
                           Dot(low, lower_.data() + pivot * most, rank));
      left_[i] -= low[rank] * low[rank];
    }
    left_[pivot] = 0.0;
  }
}

// x_S = W x_R
void InverseColumns::Continue(const Front& front, Block& block) {
  if (front.boundary() == 0 || front.own == 0) {
    std::fill_n(block.rows.data(), front.own * block.stride, 0.0);
    return;
  }
  Accumulate({.a = block.rows.data() + front.own * block.stride,
              .a_stride = block.stride,
              .b = front.Weights(weights_),
              .b_row_stride = front.own,
              .b_column_stride = 1,
              .c = block.rows.data(),
              .c_stride = block.stride,
              .rows = block.stride,
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
