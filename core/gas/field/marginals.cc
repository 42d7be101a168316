// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/marginals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/gas/field/prefetch.h"

namespace plumescout {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool IsVariance(double value) { return value > 0.0 && std::isfinite(value); }

}  // namespace

Marginals::Marginals(const SeparatorTree& tree)
    : tree_(&tree),
      mean_ppm_(tree.cells(), kNaN),
      variance_ppm2_(tree.cells(), kNaN),
      memories_(tree.nodes().size()),
      below_(tree.nodes().size()),
      debts_(tree.nodes().size()),
      column_(tree.cells()) {}

Marginals::Pass Marginals::Descend(const FieldFactor& factor, std::span<const std::uint8_t> dirty,
                                   const FieldShift& tolerance, const StopFn& stop) {
  factor_ = &factor;
  dirty_ = dirty;
  tolerance_ = tolerance;
  healthy_ = true;
  stopped_ = false;
  stop_ = &stop;
  CollectDebts();
  const FieldShift error = Visit(memories_.size() - 1, 0);
  return {error, healthy_, stopped_};
}

// What a node itself has missed shows in the boundary it remembers; what its descendants have does
// not, if it is left alone.
void Marginals::CollectDebts() {
  for (std::size_t node = 0; node < debts_.size(); ++node) {
    below_[node] = below_[node] + debts_[node].below;
    debts_[node] = {};
  }
}

// While the node itself is worked on.
void Marginals::PrefetchChildren(const SeparatorTree::Node& node,
                                 void (BoundaryMemory::*prefetch)() const) const {
  if (node.is_leaf()) return;
  for (const std::uint32_t child : node.children) {
    factor_->front(child).Prefetch();
    (memories_[child].*prefetch)();
    const SeparatorTree::Node& place = tree_->nodes()[child];
    const std::size_t size = (place.end - place.first) * sizeof(double);
    PrefetchBytes(mean_ppm_.data() + place.first, size);
    PrefetchBytes(variance_ppm2_.data() + place.first, size);
    for (const std::uint32_t next : place.children) {
      if (next != SeparatorTree::kNone) PrefetchBytes(&factor_->front(next), sizeof(Front));
    }
  }
}

FieldShift Marginals::Visit(std::size_t node, std::size_t depth) {
  stopped_ = stopped_ || Stops(*stop_);
  if (stopped_) return {};
  const SeparatorTree::Node& place = tree_->nodes()[node];
  PrefetchChildren(place, &BoundaryMemory::PrefetchForMoved);
  const Front& front = factor_->front(node);
  boundary_mean_.clear();
  if (front.boundary() > 0) {
    GatherBoundary(front, factor_->PlacesInParent(node), blocks_[depth - 1]);
  }
  const BoundaryField boundary = {boundary_mean_, boundary_};
  if (dirty_[node] == 0) {
    const FieldShift error = memories_[node].Moved(boundary) + below_[node];
    if (error.IsWithin(tolerance_)) return error;
  }
  memories_[node].Remember(boundary);
  std::fill(mean_ppm_.begin() + place.first, mean_ppm_.begin() + place.end, kNaN);
  std::fill(variance_ppm2_.begin() + place.first, variance_ppm2_.begin() + place.end, kNaN);
  UpdateMean(front);
  if (place.is_leaf()) {
    UpdateVariance(front);
    return below_[node] = {};
  }
  if (blocks_.size() <= depth) blocks_.resize(depth + 1);
  FormBlock(front, blocks_[depth]);
  const FieldShift low = Visit(place.children[0], depth + 1);
  const FieldShift high = Visit(place.children[1], depth + 1);
  return below_[node] = Max(low, high);
}

// Z_RR, out of the parent's block, and m_R.
void Marginals::GatherBoundary(const Front& front, std::span<const std::uint32_t> places,
                               const Block& from) {
  const std::size_t size = front.boundary();
  for (const Slot slot : front.boundary_cells()) boundary_mean_.push_back(mean_ppm_[slot]);
  boundary_.resize(size * size);
  for (std::size_t j = 0; j < size; ++j) {
    const double* const column = from.values.data() + places[j] * from.stride;
    for (std::size_t i = j; i < size; ++i) {
      boundary_[j * size + i] = boundary_[i * size + j] = column[places[i]];
    }
  }
}

// m_S = offset + W m_R
void Marginals::UpdateMean(const Front& front) {
  own_ = front.offset_ppm;
  front.AddWeighted(boundary_mean_, scratch_, own_.data());
  for (std::size_t i = 0; i < front.own; ++i) {
    mean_ppm_[front.cells[i]] = own_[i];
    healthy_ = healthy_ && std::isfinite(own_[i]);
  }
}

// diag Z_SS, with Z_SS = C + W Z_RR W^T.
void Marginals::UpdateVariance(const Front& front) {
  const double* weights = FormCross(front);
  own_.clear();
  for (std::size_t i = 0; i < front.own; ++i) own_.push_back(*front.covariance_column(i));
  const double* cross = cross_.data();
  for (std::size_t k = 0; k < front.boundary(); ++k) {
    for (std::size_t i = 0; i < front.own; ++i) own_[i] += cross[i] * weights[i];
    cross += TileRows(front.own);
    weights += front.own;
  }
  for (std::size_t i = 0; i < front.own; ++i) {
    variance_ppm2_[front.cells[i]] = own_[i];
    healthy_ = healthy_ && IsVariance(own_[i]);
  }
}

// Z_SR = W Z_RR; returns W.
const double* Marginals::FormCross(const Front& front) {
  const std::size_t size = front.boundary();
  const std::size_t stride = TileRows(front.own);
  const double* const weights = front.Weights(scratch_);
  cross_.resize(std::max(cross_.size(), stride * size));
  Accumulate({.a = weights,
              .a_stride = front.own,
              .b = boundary_.data(),
              .b_row_stride = size,
              .b_column_stride = 1,
              .c = cross_.data(),
              .c_stride = stride,
              .rows = front.own,
              .columns = size,
              .depth = size,
              .overwrite = true});
  return weights;
}

void Marginals::FormBlock(const Front& front, Block& block) {
  const std::size_t own = front.own;
  const std::size_t size = front.boundary();
  const std::size_t cross_stride = TileRows(own);
  const double* const weights = FormCross(front);
  block.stride = PaddedRows(front.cells.size());
  block.values.resize(std::max(block.values.size(), block.stride * front.cells.size()));
  for (std::size_t j = 0; j < own; ++j) {
    double* const column = block.values.data() + j * block.stride;
    std::copy_n(front.covariance_column(j), own - j, column + j);
    std::fill_n(column + own, block.stride - own, 0.0);
  }
  Accumulate({.a = cross_.data(),
              .a_stride = cross_stride,
              .b = weights,
              .b_row_stride = own,
              .b_column_stride = 1,
              .c = block.values.data(),
              .c_stride = block.stride,
              .rows = own,
              .columns = own,
              .depth = size,
              .lower_only = true});
  for (std::size_t j = 0; j < own; ++j) {
    double* const column = block.values.data() + j * block.stride;
    variance_ppm2_[front.cells[j]] = column[j];
    healthy_ = healthy_ && IsVariance(column[j]);
    for (std::size_t i = 0; i < size; ++i) column[own + i] = cross_[i * cross_stride + j];
  }
  for (std::size_t j = 0; j < size; ++j) {
    std::copy_n(boundary_.data() + j * size + j, size - j,
                block.values.data() + (own + j) * block.stride + own + j);
  }
}

// [IPP] Eq. (3) with one more precision w on the diagonal and d on the right-hand side: for the
// column x of the covariance in cell i, Z' = Z - w / (1 + w Z_ii) x x^T and
// m' = m + (d - w m_i) / (1 + w Z_ii) x.
bool Marginals::Hear(const FieldFactor& factor, const FieldReading& reading,
                     std::span<const PathStep> steps, const FieldShift& limit) {
  // As the factor knows them, exactly: the published mean may be off by the tolerance.
  const double mean_ppm = steps.back().mean_ppm;
  const double variance_ppm2 = steps.back().variance_ppm2;
  const double scale = 1.0 / (1.0 + reading.precision * variance_ppm2);
  factor_ = &factor;
  healthy_ = true;
  hearing_.factors.mean_factor =
      (reading.weighted_deviation - reading.precision * mean_ppm) * scale;
  hearing_.factors.variance_factor = reading.precision * scale;
  hearing_.steps = steps;
  hearing_.limit = limit;
  VisitForReading(memories_.size() - 1, {});
  // With a greater diagonal the error that the cell had would be a larger share of its variance.
  mean_ppm_[reading.slot] = mean_ppm + hearing_.factors.mean_factor * variance_ppm2;
  variance_ppm2_[reading.slot] = variance_ppm2 * scale;
  return healthy_;
}

void Marginals::VisitForReading(std::size_t node, const FieldShift& owed_above) {
  const SeparatorTree::Node& place = tree_->nodes()[node];
  PrefetchChildren(place, &BoundaryMemory::PrefetchForHear);
  const Front& front = factor_->front(node);
  Debt& debt = debts_[node];
  const double largest = GatherColumn(front);
  const bool on_path = !hearing_.steps.empty() && hearing_.steps.back().node == node;
  if (!on_path) {
    const ReadingFactors& factors = hearing_.factors;
    const FieldShift missed = {std::abs(factors.mean_factor) * largest,
                               factors.variance_factor * largest * largest};
    const FieldShift owed = debt.own + missed;
    if ((owed_above + owed + debt.below).IsWithin(hearing_.limit)) {
      debt.own = owed;
      return;
    }
    memories_[node].Hear(factors, x_);
  }
  if (on_path) {
    own_ = hearing_.steps.back().own;
    hearing_.steps = hearing_.steps.first(hearing_.steps.size() - 1);
  } else {
    own_.assign(front.own, 0.0);
  }
  front.AddWeighted(x_, scratch_, own_.data());
  UpdateForReading(front);
  if (place.is_leaf()) return;
  debt.below = {};
  for (const std::uint32_t child : place.children) {
    VisitForReading(child, owed_above + debt.own);
    debt.below = Max(debt.below, debts_[child].own + debts_[child].below);
  }
}

// x_R; returns the largest of them.
double Marginals::GatherColumn(const Front& front) {
  x_.clear();
  double largest = 0.0;
  for (const Slot slot : front.boundary_cells()) {
    x_.push_back(column_[slot]);
    largest = std::max(largest, column_[slot]);
  }
  return largest;
}

void Marginals::UpdateForReading(const Front& front) {
  const auto [mean_factor, variance_factor] = hearing_.factors;
  for (std::size_t i = 0; i < front.own; ++i) {
    const Slot slot = front.cells[i];
    const double x = column_[slot] = own_[i];
    const double mean = mean_ppm_[slot] += mean_factor * x;
    const double variance = variance_ppm2_[slot] -= variance_factor * x * x;
    healthy_ = healthy_ && std::isfinite(mean) && IsVariance(variance);
  }
}

double Marginals::LargestMean_ppm() const {
  double largest = 0.0;
  for (const double mean : mean_ppm_) {
    largest = std::max(largest, std::abs(mean));  // passes over NaN
  }
  return largest;
}

}  // namespace plumescout
