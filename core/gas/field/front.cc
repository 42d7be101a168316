// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/front.h"

#include <algorithm>
#include <cassert>

#include "core/gas/field/dominant_front.h"

namespace plumescout {
namespace {

constexpr std::size_t kExtraRows = 2;  // ground and right-hand side

// Packed size of the message on `boundary` cells.
std::size_t MessageSize(std::size_t boundary) {
  return boundary * (boundary + 1) / 2 + boundary;  // column j: boundary - 1 - j + kExtraRows
}

}  // namespace

double Front::work() const {
  const auto cube = [](double n) { return n * n * n / 6.0; };
  return cube(static_cast<double>(cells.size())) - cube(static_cast<double>(boundary()));
}

void Front::AddWeighted(std::span<const double> boundary, double* own_values) const {
  AddProduct(weights.data(), stride, boundary, own_values);
}

// Sherman and Morrison on the joint distribution of S and cell i given R, of which W is the
// derivative of the means.
std::shared_ptr<const Front> AfterReading(const Front& front, const PathStep& step,
                                          double precision, double weighted_deviation) {
  auto after = std::make_shared<Front>();
  after->cells = front.cells;
  after->own = front.own;
  after->stride = front.stride;
  after->covariance = front.covariance;
  after->weights = front.weights;
  after->offset_ppm = front.offset_ppm;
  const double scale = 1.0 / (1.0 + precision * step.variance_ppm2);
  const double gain = (weighted_deviation - precision * step.mean_ppm) * scale;
  for (std::size_t i = 0; i < front.own; ++i) after->offset_ppm[i] += gain * step.own[i];
  const auto subtract = [&](std::span<const double> by_column, std::vector<double>& block) {
    for (std::size_t j = 0; j < by_column.size(); ++j) {
      const double factor = precision * scale * by_column[j];
      double* const column = block.data() + j * front.stride;
      for (std::size_t i = 0; i < front.own; ++i) column[i] -= factor * step.own[i];
    }
  };
  subtract({step.own.data(), front.own}, after->covariance);
  subtract(step.boundary, after->weights);
  return after;
}

// Four columns at once, to load and store y less often.
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

void FindPlaces(std::span<const Slot> some, std::span<const Slot> all,
                std::vector<std::uint32_t>& places) {
  places.resize(some.size());
  std::uint32_t place = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    while (all[place] != some[i]) ++place;
    places[i] = place;
  }
}

std::shared_ptr<const Front> FrontBuilder::Build(const SeparatorTree::Node& node,
                                                 const FieldCells& cells, const Front* low,
                                                 const Front* high) {
  auto front = std::make_shared<Front>();
  FindCells(node, cells, low, high, *front);
  if (front->cells.empty()) return front;
  Assemble(cells, *front);
  for (const Front* child : {low, high}) {
    if (child != nullptr) AddMessage(*child);
  }
  EliminateDominant({.values = matrix_.data(),
                     .stride = matrix_stride_,
                     .rows = rows_,
                     .dominant_rows = rows_ - 1,
                     .unknowns = front->cells.size(),
                     .columns = front->own});
  if (front->own > 0) Condition(*front);
  KeepMessage(*front);
  return front;
}

void FrontBuilder::FindCells(const SeparatorTree::Node& node, const FieldCells& cells,
                             const Front* low, const Front* high, Front& front) {
  for (Slot slot = node.first; slot < node.end; ++slot) {
    if (cells.active[slot] != 0) front.cells.push_back(slot);
  }
  front.own = front.cells.size();
  for (std::size_t i = 0; i < front.own; ++i) {
    const Slot slot = front.cells[i];
    for (std::size_t direction = 0; direction < tree_->neighbours(slot).size(); ++direction) {
      const Slot next = tree_->neighbours(slot)[direction];
      if (next >= node.end && cells.HasFactor(*tree_, slot, direction)) front.cells.push_back(next);
    }
  }
  for (const Front* child : {low, high}) {
    if (child == nullptr) continue;
    for (const Slot slot : child->boundary_cells()) {
      if (slot >= node.end) front.cells.push_back(slot);
    }
  }
  const auto boundary = front.cells.begin() + static_cast<std::ptrdiff_t>(front.own);
  std::sort(boundary, front.cells.end());
  front.cells.erase(std::unique(boundary, front.cells.end()), front.cells.end());
  for (std::size_t i = 0; i < front.cells.size(); ++i) {
    place_[front.cells[i]] = static_cast<std::uint32_t>(i);
  }
}

// H of the own cells and of the factors between them and others: [IPP] Eq. (3).
void FrontBuilder::Assemble(const FieldCells& cells, const Front& front) {
  const std::size_t unknowns = front.cells.size();
  rows_ = unknowns + kExtraRows;
  matrix_stride_ = PaddedRows(rows_);
  matrix_.assign(matrix_stride_ * unknowns, 0.0);
  for (std::size_t j = 0; j < front.own; ++j) {
    const Slot slot = front.cells[j];
    double* const column = matrix_.data() + j * matrix_stride_;
    for (std::size_t direction = 0; direction < tree_->neighbours(slot).size(); ++direction) {
      const Slot next = tree_->neighbours(slot)[direction];
      if (next < slot || !cells.HasFactor(*tree_, slot, direction)) continue;
      column[place_[next]] = -prior_.prior_precision;
    }
    column[unknowns] = -(prior_.background_precision + cells.precision[slot]);
    column[unknowns + 1] = cells.weighted_deviation[slot];
  }
}

void FrontBuilder::AddMessage(const Front& child) {
  const std::span<const Slot> boundary = child.boundary_cells();
  assert(child.message.size() == MessageSize(boundary.size()));
  const double* value = child.message.data();
  for (std::size_t j = 0; j < boundary.size(); ++j) {
    double* const column = matrix_.data() + place_[boundary[j]] * matrix_stride_;
    for (std::size_t i = j + 1; i < boundary.size(); ++i) column[place_[boundary[i]]] += *value++;
    for (std::size_t i = rows_ - kExtraRows; i < rows_; ++i) column[i] += *value++;
  }
}

// C, W and the offset, out of L.
void FrontBuilder::Condition(Front& front) {
  const std::size_t own = front.own;
  const std::size_t boundary = front.boundary();
  const std::size_t stride = front.stride = TileRows(own);
  inverse_.resize(std::max(inverse_.size(), stride * own));
  InvertLower(matrix_.data(), matrix_stride_, own, inverse_.data(), stride);
  transposed_inverse_.assign(stride * own, 0.0);
  for (std::size_t j = 0; j < own; ++j) {
    for (std::size_t i = j; i < own; ++i) {
      transposed_inverse_[i * stride + j] = inverse_[j * stride + i];
    }
  }
  const Product from_x = {.a = transposed_inverse_.data(),
                          .a_stride = stride,
                          .c_stride = stride,
                          .rows = own,
                          .depth = own};
  front.covariance.assign(stride * own, 0.0);
  Product c = from_x;
  c.b = inverse_.data();
  c.b_column_stride = stride;
  c.c = front.covariance.data();
  c.columns = own;
  Accumulate(c);

  extended_weights_.assign(stride * (boundary + kExtraRows), 0.0);
  Product w = from_x;
  w.b = matrix_.data() + own;  // L_RS^T
  w.b_row_stride = matrix_stride_;
  w.b_column_stride = 1;
  w.c = extended_weights_.data();
  w.columns = boundary + kExtraRows;
  w.scale = -1.0;
  Accumulate(w);
  const double* const begin = extended_weights_.data();
  const double* const end = begin + stride * boundary;
  front.weights.assign(begin, end);
  front.offset_ppm.resize(own);
  const double* const right_hand_side = end + stride;
  for (std::size_t i = 0; i < own; ++i) front.offset_ppm[i] = -right_hand_side[i];
}

void FrontBuilder::KeepMessage(Front& front) const {
  front.message.reserve(MessageSize(front.boundary()));
  for (std::size_t j = front.own; j < front.cells.size(); ++j) {
    const double* const column = matrix_.data() + j * matrix_stride_;
    front.message.insert(front.message.end(), column + j + 1, column + rows_);
  }
}

}  // namespace plumescout
