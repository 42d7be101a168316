// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/front_builder.h"

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

// Room for at least `size` elements, of any value.
void Reserve(std::vector<double>& values, std::size_t size) {
  values.resize(std::max(values.size(), size));
}

}  // namespace

std::shared_ptr<const Front> FrontBuilder::Build(const SeparatorTree::Node& node,
                                                 const FieldCells& cells, const Front* low,
                                                 const Front* high) {
  auto front = std::make_shared<Front>();
  FindCells(node, cells, low, high, *front);
  if (front->cells.empty()) return front;
  if (node.is_leaf()) Couple(cells, *front);
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
  found_.clear();
  for (Slot slot = node.first; slot < node.end; ++slot) {
    if (cells.active[slot] != 0) found_.push_back(slot);
  }
  front.own = found_.size();
  for (std::size_t i = 0; i < front.own; ++i) {
    const Slot slot = found_[i];
    for (std::size_t direction = 0; direction < tree_->neighbours(slot).size(); ++direction) {
      const Slot next = tree_->neighbours(slot)[direction];
      if (next >= node.end && cells.HasFactor(*tree_, slot, direction)) found_.push_back(next);
    }
  }
  for (const Front* child : {low, high}) {
    if (child == nullptr) continue;
    for (const Slot slot : child->boundary_cells()) {
      if (slot >= node.end) found_.push_back(slot);
    }
  }
  const auto boundary = found_.begin() + static_cast<std::ptrdiff_t>(front.own);
  std::sort(boundary, found_.end());
  found_.erase(std::unique(boundary, found_.end()), found_.end());
  front.cells.assign(found_.begin(), found_.end());
  for (std::size_t i = 0; i < front.cells.size(); ++i) {
    place_[front.cells[i]] = static_cast<std::uint32_t>(i);
  }
  if (low == nullptr) return;
  front.child_places.reserve(low->boundary() + high->boundary());
  for (const Front* child : {low, high}) {
    for (const Slot slot : child->boundary_cells()) front.child_places.push_back(place_[slot]);
  }
}

void FrontBuilder::Couple(const FieldCells& cells, Front& front) {
  couplings_.clear();
  is_coupled_.assign(front.boundary(), 0);
  front.coupling_precision = prior_.prior_precision_per_ppm2;
  for (std::size_t i = 0; i < front.own; ++i) {
    const Slot slot = front.cells[i];
    for (std::size_t direction = 0; direction < tree_->neighbours(slot).size(); ++direction) {
      if (!cells.HasFactor(*tree_, slot, direction)) continue;
      const std::uint32_t place = place_[tree_->neighbours(slot)[direction]];
      if (place < front.own) continue;
      const std::size_t boundary = place - front.own;
      assert(boundary < Front::kMaxLeafBoundary);
      Front::Coupling& coupling = couplings_.emplace_back();
      coupling.own = static_cast<std::uint16_t>(i);
      coupling.boundary = boundary & (Front::kMaxLeafBoundary - 1);
      coupling.is_first = is_coupled_[boundary] == 0;
      is_coupled_[boundary] = 1;
    }
  }
  front.couplings.assign(couplings_.begin(), couplings_.end());
}

// H of the own cells and of the factors between them and others: [IPP] Eq. (3).
void FrontBuilder::Assemble(const FieldCells& cells, const Front& front) {
  const std::size_t unknowns = front.cells.size();
  rows_ = unknowns + kExtraRows;
  matrix_stride_ = PaddedRows(rows_);
  Reserve(matrix_, matrix_stride_ * unknowns);
  for (std::size_t j = 0; j < unknowns; ++j) {  // nothing above the diagonal is asked for
    std::fill_n(matrix_.data() + j * matrix_stride_ + j, matrix_stride_ - j, 0.0);
  }
  for (std::size_t j = 0; j < front.own; ++j) {
    const Slot slot = front.cells[j];
    double* const column = matrix_.data() + j * matrix_stride_;
    for (std::size_t direction = 0; direction < tree_->neighbours(slot).size(); ++direction) {
      const Slot next = tree_->neighbours(slot)[direction];
      if (next < slot || !cells.HasFactor(*tree_, slot, direction)) continue;
      column[place_[next]] = -prior_.prior_precision_per_ppm2;
    }
    column[unknowns] = -(prior_.background_precision_per_ppm2 + cells.precision[slot]);
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
  const std::size_t stride = TileRows(own);
  Reserve(transposed_inverse_, stride * own);
  InvertLowerTransposed(matrix_.data(), matrix_stride_, own, transposed_inverse_.data(), stride);
  const Product from_x = {.a = transposed_inverse_.data(),
                          .a_stride = stride,
                          .b_column_stride = 1,
                          .c_stride = stride,
                          .rows = own,
                          .depth = own,
                          .a_is_upper = true,
                          .overwrite = true};
  Reserve(covariance_, stride * own);
  Product c = from_x;
  c.b = transposed_inverse_.data();
  c.b_row_stride = stride;
  c.c = covariance_.data();
  c.columns = own;
  c.lower_only = true;
  Accumulate(c);

  // A leaf needs only the columns for ground and right-hand side.
  const std::size_t columns = front.couplings.empty() ? front.boundary() : 0;
  const std::size_t first = front.cells.size() - columns;
  Reserve(extended_weights_, stride * (columns + kExtraRows));
  Product w = from_x;
  w.b = matrix_.data() + first;  // L_RS^T
  w.b_row_stride = matrix_stride_;
  w.c = extended_weights_.data();
  w.columns = columns + kExtraRows;
  w.scale = -1.0;
  Accumulate(w);
  KeepDistribution(columns, front);
}

void FrontBuilder::KeepDistribution(std::size_t weight_columns, Front& front) const {
  const std::size_t own = front.own;
  const std::size_t stride = TileRows(own);
  front.covariance.reserve(own * (own + 1) / 2);
  for (std::size_t j = 0; j < own; ++j) {
    const double* const column = covariance_.data() + j * stride;
    front.covariance.insert(front.covariance.end(), column + j, column + own);
  }
  if (weight_columns > 0) front.weights.reserve(own * weight_columns + kRowTile);
  for (std::size_t j = 0; j < weight_columns; ++j) {
    const double* const column = extended_weights_.data() + j * stride;
    front.weights.insert(front.weights.end(), column, column + own);
  }
  if (weight_columns > 0) front.weights.resize(own * weight_columns + kRowTile, 0.0);
  const double* const right_hand_side = extended_weights_.data() + (weight_columns + 1) * stride;
  front.offset_ppm.resize(own);
  for (std::size_t i = 0; i < own; ++i) front.offset_ppm[i] = -right_hand_side[i];
  front.SumWeights();
}

void FrontBuilder::KeepMessage(Front& front) const {
  front.message.reserve(MessageSize(front.boundary()));
  for (std::size_t j = front.own; j < front.cells.size(); ++j) {
    const double* const column = matrix_.data() + j * matrix_stride_;
    front.message.insert(front.message.end(), column + j + 1, column + rows_);
  }
}

}  // namespace plumescout
