// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/reading_paths.h"

#include <algorithm>
#include <utility>

#include "core/gas/field/field_factor.h"
#include "core/linalg/dense_kernel.h"

namespace plumescout {
namespace {

std::size_t PlaceAmong(std::span<const Slot> own, Slot slot) {
  return static_cast<std::size_t>(std::lower_bound(own.begin(), own.end(), slot) - own.begin());
}

// Of the symmetric C.
double CovarianceAt(const Front& front, std::size_t i, std::size_t j) {
  return front.covariance_column(std::min(i, j))[std::max(i, j) - std::min(i, j)];
}

// C, both triangles.
void Unpack(const Front& front, std::vector<double>& covariance) {
  const std::size_t own = front.own;
  covariance.resize(std::max(covariance.size(), own * own));
  const double* value = front.covariance.data();
  for (std::size_t j = 0; j < own; ++j) {
    for (std::size_t i = j; i < own; ++i) {
      covariance[j * own + i] = covariance[i * own + j] = *value++;
    }
  }
}

}  // namespace

ReadingPaths::ReadingPaths(const FieldFactor& factor, std::span<const Slot> slots,
                           const StopFn& stop, std::optional<ReadingPaths> used) {
  if (used) *this = *std::move(used);
  FindSteps(factor, slots);
  constexpr std::size_t kNodesPerStop = 8;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (i % kNodesPerStop == 0 && Stops(stop)) return;
    const Step& step = steps_[i];
    const Front& front = factor.front(step.node);
    if (factor.tree().nodes()[step.node].is_leaf()) {
      TakeLeaf(front, slots, step);
    } else {
      GatherWeights(factor, slots, step);
      TakeInner(front, step);
    }
  }
}

// A walk from cell to cell through the tree: a node is left once no later cell is in its subtree.
void ReadingPaths::FindSteps(const FieldFactor& factor, std::span<const Slot> slots) {
  const std::vector<SeparatorTree::Node>& nodes = factor.tree().nodes();
  steps_.clear();
  std::vector<Step> path;  // of the present cell, from the root
  std::vector<std::uint32_t> joining;
  std::size_t size = 0;
  const auto leave = [&](std::size_t next) {
    Step& step = steps_.emplace_back(path.back());
    path.pop_back();
    step.cells = next - step.first;
    size += step.stride() * (factor.front(step.node).cells.size() + step.cells);
  };
  for (std::size_t i = 0; i < slots.size(); ++i) {
    joining.clear();
    std::uint32_t node = factor.tree().owner(slots[i]);
    for (; node != SeparatorTree::kNone; node = nodes[node].parent) {
      while (!path.empty() && path.back().node < node) leave(i);
      if (!path.empty() && path.back().node == node) break;
      joining.push_back(node);
    }
    for (std::size_t k = joining.size(); k-- > 0;) path.push_back({joining[k], i});
  }
  while (!path.empty()) leave(slots.size());
  const double* values = values_.For(size);
  for (Step& step : steps_) {
    const Front& front = factor.front(step.node);
    step.own = values;
    step.boundary = step.own + front.own * step.stride();
    step.among = step.own + front.cells.size() * step.stride();
    values += (front.cells.size() + step.cells) * step.stride();
  }
}

const ReadingPaths::Step* ReadingPaths::StepAt(std::size_t node) const {
  const auto at =
      std::lower_bound(steps_.begin(), steps_.end(), node,
                       [](const Step& step, std::size_t wanted) { return step.node < wanted; });
  return at == steps_.end() || at->node != node ? nullptr : &*at;
}

ReadingPaths::Rows ReadingPaths::RowsOf(const Step& step, const Front& front) {
  double* const own = values_.data() + (step.own - values_.data());
  return {own, own + front.own * step.stride(), own + front.cells.size() * step.stride()};
}

// All cells are own ones: their covariances with the others are columns of C.
void ReadingPaths::TakeLeaf(const Front& front, std::span<const Slot> slots, const Step& step) {
  const Rows to = RowsOf(step, front);
  const std::size_t stride = step.stride();
  std::fill_n(to.own, (front.cells.size() + step.cells) * stride, 0.0);
  for (std::size_t j = 0; j < step.cells; ++j) {
    const std::size_t place = PlaceAmong(front.own_cells(), slots[step.first + j]);
    for (std::size_t s = 0; s < front.own; ++s) {
      to.own[s * stride + j] = CovarianceAt(front, place, s);
    }
    for (std::size_t i = 0; i <= j; ++i) to.among[i * stride + j] = to.own[place * stride + i];
  }
  for (const Front::Coupling& coupling : front.couplings) {
    for (std::size_t j = 0; j < step.cells; ++j) {
      to.boundary[coupling.boundary * stride + j] +=
          front.coupling_precision * to.own[coupling.own * stride + j];
    }
  }
}

// The weights of S and R in the means of the cells, by what the children say and the cells that are
// own ones; and what the cells below one child have in common given them.
void ReadingPaths::GatherWeights(const FieldFactor& factor, std::span<const Slot> slots,
                                 const Step& step) {
  const Front& front = factor.front(step.node);
  const std::size_t stride = step.stride();
  const Rows to = RowsOf(step, front);
  weights_.assign(front.cells.size() * stride, 0.0);
  std::fill_n(to.among, step.cells * stride, 0.0);
  std::size_t below = 0;
  for (const std::uint32_t child : factor.tree().nodes()[step.node].children) {
    const Step* const from = StepAt(child);
    if (from == nullptr) continue;
    const std::size_t first = from->first - step.first;
    const std::span<const std::uint32_t> places = factor.PlacesInParent(child);
    for (std::size_t r = 0; r < places.size(); ++r) {
      std::copy_n(from->boundary + r * from->stride(), from->cells,
                  weights_.data() + places[r] * stride + first);
    }
    for (std::size_t j = 0; j < from->cells; ++j) {
      std::copy_n(from->among + j * from->stride() + j, from->cells - j,
                  to.among + (first + j) * stride + first + j);
    }
    below += from->cells;
  }
  for (std::size_t j = below; j < step.cells; ++j) {
    const std::size_t place = PlaceAmong(front.own_cells(), slots[step.first + j]);
    weights_[place * stride + j] = 1.0;
  }
}

// Takes the mean out of S: what is given are the values of R alone.
void ReadingPaths::TakeInner(const Front& front, const Step& step) {
  const std::size_t own = front.own;
  const std::size_t stride = step.stride();
  const Rows to = RowsOf(step, front);
  std::copy_n(weights_.data() + own * stride, front.boundary() * stride, to.boundary);
  if (own == 0) return;
  Unpack(front, covariance_);
  const Product from_weights = {.a = weights_.data(),
                                .a_stride = stride,
                                .b_column_stride = 1,
                                .c_stride = stride,
                                .rows = stride,
                                .depth = own};
  Product covariances = from_weights;
  covariances.b = covariance_.data();
  covariances.b_row_stride = own;
  covariances.c = to.own;
  covariances.columns = own;
  covariances.overwrite = true;
  Accumulate(covariances);
  Product among = from_weights;
  among.b = to.own;
  among.b_row_stride = stride;
  among.c = to.among;
  among.columns = step.cells;
  among.lower_only = true;
  Accumulate(among);
  if (front.weights.empty()) return;
  Product boundary = from_weights;
  boundary.b = front.weights.data();
  boundary.b_row_stride = 1;
  boundary.b_column_stride = own;
  boundary.c = to.boundary;
  boundary.columns = front.boundary();
  Accumulate(boundary);
}

}  // namespace plumescout
