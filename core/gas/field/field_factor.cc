// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_factor.h"

#include <algorithm>
#include <utility>

namespace plumescout {
namespace {

// y += a x, for a column-major `a` with whole row tiles; four columns at once, to load and store y
// less often.
void AddProduct(const double* a, std::size_t stride, std::span<const double> x, double* y) {
  std::size_t j = 0;
  for (; j + 4 <= x.size(); j += 4, a += 4 * stride) {
    const double *a0 = a, *a1 = a0 + stride, *a2 = a1 + stride, *a3 = a2 + stride;
    const double x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
    for (std::size_t i = 0; i < stride; ++i) {
      y[i] += (a0[i] * x0 + a1[i] * x1) + (a2[i] * x2 + a3[i] * x3);
    }
  }
  for (; j < x.size(); ++j, a += stride) {
    for (std::size_t i = 0; i < stride; ++i) y[i] += a[i] * x[j];
  }
}

// Scratch of the way down.
struct Descent {
  std::vector<double> boundary;  // x_R, cell by cell
  std::vector<double> own;       // x_S, column by column
};

// x_S += W x_R for one column.
void DescendOne(const Front& front, double* x, Descent& scratch) {
  const std::span<const Slot> boundary = front.boundary_cells();
  scratch.boundary.resize(boundary.size());
  scratch.own.assign(front.stride, 0.0);
  for (std::size_t i = 0; i < boundary.size(); ++i) scratch.boundary[i] = x[boundary[i]];
  AddProduct(front.weights.data(), front.stride, scratch.boundary, scratch.own.data());
  for (std::size_t i = 0; i < front.own; ++i) x[front.cells[i]] += scratch.own[i];
}

// The same for several columns at once.
void DescendMany(const Front& front, SlotColumns& x, Descent& scratch) {
  const std::size_t columns = x.columns();
  const std::span<const Slot> boundary = front.boundary_cells();
  scratch.boundary.resize(boundary.size() * columns);
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    std::copy_n(x.row(boundary[i]), columns, scratch.boundary.data() + i * columns);
  }
  scratch.own.assign(front.stride * columns, 0.0);
  Accumulate({.a = front.weights.data(),
              .a_stride = front.stride,
              .b = scratch.boundary.data(),
              .b_row_stride = columns,
              .b_column_stride = 1,
              .c = scratch.own.data(),
              .c_stride = front.stride,
              .rows = front.own,
              .columns = columns,
              .depth = boundary.size()});
  for (std::size_t i = 0; i < front.own; ++i) {
    double* const row = x.row(front.cells[i]);
    for (std::size_t j = 0; j < columns; ++j) row[j] += scratch.own[j * front.stride + i];
  }
}

void DescendFront(const Front& front, SlotColumns& x, Descent& scratch) {
  if (front.own == 0 || front.boundary() == 0) return;
  if (x.columns() == 1) {
    DescendOne(front, x.row(0), scratch);
  } else {
    DescendMany(front, x, scratch);
  }
}

}  // namespace

void FieldFactor::Eliminate(std::span<const std::uint8_t> dirty, const FieldCells& cells,
                            FrontBuilder& builder) {
  for (std::size_t i = 0; i < fronts_.size(); ++i) {
    if (dirty[i] == 0) continue;
    const SeparatorTree::Node& node = tree_->nodes()[i];
    const Front* const low = node.is_leaf() ? nullptr : fronts_[node.children[0]].get();
    const Front* const high = node.is_leaf() ? nullptr : fronts_[node.children[1]].get();
    fronts_[i] = builder.Build(node, cells, low, high);
  }
}

double FieldFactor::work() const {
  double sum = 0.0;
  for (const auto& front : fronts_) sum += front->work();
  return sum;
}

PathColumns FieldFactor::InverseOnPaths(std::span<const Slot> slots) const {
  PathColumns columns{SlotColumns(tree_->cells(), slots.size()), {}};
  std::vector<double> r(tree_->cells(), 0.0);
  std::vector<std::uint32_t>& nodes = columns.path_nodes;
  for (std::size_t j = 0; j < slots.size(); ++j) {
    const std::vector<std::uint32_t> path = PathFrom(slots[j]);
    nodes.insert(nodes.end(), path.begin(), path.end());
    Ascend(slots[j], j, r, columns.values);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  Descent scratch;
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    DescendFront(*fronts_[*node], columns.values, scratch);
  }
  return columns;
}

std::vector<std::uint32_t> FieldFactor::PathFrom(Slot slot) const {
  std::vector<std::uint32_t> path;
  for (std::uint32_t node = tree_->owner(slot); node != SeparatorTree::kNone;
       node = tree_->nodes()[node].parent) {
    path.push_back(node);
  }
  return path;
}

// From e_slot up to the root: x_S = C r_S, r_R += W^T r_S. `r` is 0 before and after.
void FieldFactor::Ascend(Slot slot, std::size_t column, std::vector<double>& r,
                         SlotColumns& x) const {
  std::vector<double> own;
  std::vector<double> solution;
  r[slot] = 1.0;
  for (const std::uint32_t node : PathFrom(slot)) {
    const Front& front = *fronts_[node];
    if (front.own == 0) continue;
    own.resize(front.own);
    for (std::size_t i = 0; i < front.own; ++i) own[i] = std::exchange(r[front.cells[i]], 0.0);
    const std::span<const Slot> boundary = front.boundary_cells();
    for (std::size_t j = 0; j < boundary.size(); ++j) {
      r[boundary[j]] += Dot(front.weights.data() + j * front.stride, own.data(), front.own);
    }
    solution.assign(front.stride, 0.0);
    AddProduct(front.covariance.data(), front.stride, own, solution.data());
    for (std::size_t i = 0; i < front.own; ++i) x.row(front.cells[i])[column] = solution[i];
  }
}

SlotColumns FieldFactor::Extend(PathColumns columns) const {
  Descent scratch;
  auto known = columns.path_nodes.rbegin();
  for (std::size_t node = fronts_.size(); node-- > 0;) {
    if (known != columns.path_nodes.rend() && *known == node) {
      ++known;
    } else {
      DescendFront(*fronts_[node], columns.values, scratch);
    }
  }
  return std::move(columns.values);
}

double FieldFactor::Mean_ppm(Slot slot) const {
  SlotColumns mean(tree_->cells(), 1);
  Descent scratch;
  const std::vector<std::uint32_t> path = PathFrom(slot);
  for (auto node = path.rbegin(); node != path.rend(); ++node) {
    const Front& front = *fronts_[*node];
    for (std::size_t i = 0; i < front.own; ++i) *mean.row(front.cells[i]) = front.offset_ppm[i];
    DescendFront(front, mean, scratch);
  }
  return *mean.row(slot);
}

}  // namespace plumescout
