// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_factor.h"

#include <algorithm>

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

// Values of a vector over slots in the cells of a front.
void Gather(const double* from, std::span<const Slot> cells, double* to) {
  for (std::size_t i = 0; i < cells.size(); ++i) to[i] = from[cells[i]];
}

void Scatter(const double* from, std::span<const Slot> cells, double* to) {
  for (std::size_t i = 0; i < cells.size(); ++i) to[cells[i]] = from[i];
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

SlotColumns FieldFactor::InverseColumns(std::span<const Slot> slots) const {
  SlotColumns x(tree_->cells(), slots.size());
  for (std::size_t j = 0; j < slots.size(); ++j) Ascend(slots[j], x.column(j));
  if (!slots.empty()) Descend(x);
  return x;
}

// From the node of `slot` to the root: x_S = C r_S, r_R += W^T r_S, with r = e_slot at first.
void FieldFactor::Ascend(Slot slot, double* x) const {
  std::vector<double> r(tree_->cells(), 0.0);
  std::vector<double> own;
  r[slot] = 1.0;
  for (std::uint32_t i = tree_->owner(slot); i != SeparatorTree::kNone;
       i = tree_->nodes()[i].parent) {
    const Front& front = *fronts_[i];
    if (front.own == 0) continue;
    own.assign(front.stride, 0.0);
    Gather(r.data(), front.own_cells(), own.data());
    const std::span<const Slot> boundary = front.boundary_cells();
    for (std::size_t j = 0; j < boundary.size(); ++j) {
      r[boundary[j]] += Dot(front.weights.data() + j * front.stride, own.data(), front.own);
    }
    std::vector<double> solution(front.stride, 0.0);
    AddProduct(front.covariance.data(), front.stride, {own.data(), front.own}, solution.data());
    Scatter(solution.data(), front.own_cells(), x);
  }
}

// From the root down: x_S += W x_R.
void FieldFactor::Descend(SlotColumns& x) const {
  std::vector<double> above;
  std::vector<double> own;
  for (std::size_t node = fronts_.size(); node-- > 0;) {
    const Front& front = *fronts_[node];
    const std::size_t boundary = front.boundary();
    if (front.own == 0 || boundary == 0) continue;
    above.resize(boundary * x.columns());
    own.resize(front.stride * x.columns());
    for (std::size_t j = 0; j < x.columns(); ++j) {
      Gather(x.column(j), front.boundary_cells(), above.data() + j * boundary);
      Gather(x.column(j), front.own_cells(), own.data() + j * front.stride);
    }
    if (x.columns() == 1) {
      AddProduct(front.weights.data(), front.stride, above, own.data());
    } else {
      Accumulate({.a = front.weights.data(),
                  .a_stride = front.stride,
                  .b = above.data(),
                  .b_column_stride = boundary,
                  .c = own.data(),
                  .c_stride = front.stride,
                  .rows = front.own,
                  .columns = x.columns(),
                  .depth = boundary});
    }
    for (std::size_t j = 0; j < x.columns(); ++j) {
      Scatter(own.data() + j * front.stride, front.own_cells(), x.column(j));
    }
  }
}

double FieldFactor::Mean_ppm(Slot slot) const {
  std::vector<std::uint32_t> path;
  for (std::uint32_t i = tree_->owner(slot); i != SeparatorTree::kNone;
       i = tree_->nodes()[i].parent) {
    path.push_back(i);
  }
  std::vector<double> mean(tree_->cells(), 0.0);
  std::vector<double> above;
  std::vector<double> own;
  for (auto node = path.rbegin(); node != path.rend(); ++node) {
    const Front& front = *fronts_[*node];
    if (front.own == 0) continue;
    own.assign(front.stride, 0.0);
    std::copy(front.offset_ppm.begin(), front.offset_ppm.end(), own.begin());
    above.resize(front.boundary());
    Gather(mean.data(), front.boundary_cells(), above.data());
    AddProduct(front.weights.data(), front.stride, above, own.data());
    Scatter(own.data(), front.own_cells(), mean.data());
  }
  return mean[slot];
}

}  // namespace plumescout
