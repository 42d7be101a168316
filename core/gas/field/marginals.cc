// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/marginals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumescout {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

FieldShift Max(const FieldShift& a, const FieldShift& b) {
  return {std::max(a.mean_ppm, b.mean_ppm), std::max(a.covariance_ppm2, b.covariance_ppm2)};
}

FieldShift Sum(const FieldShift& a, const FieldShift& b) {
  return {a.mean_ppm + b.mean_ppm, a.covariance_ppm2 + b.covariance_ppm2};
}

bool IsWithin(const FieldShift& error, const FieldShift& tolerance) {
  return error.mean_ppm <= tolerance.mean_ppm && error.covariance_ppm2 <= tolerance.covariance_ppm2;
}

bool IsVariance(double value) { return value > 0.0 && std::isfinite(value); }

// Places of the ascending slots `some` among the ascending slots `all`, which hold them.
void FindPlaces(std::span<const Slot> some, std::span<const Slot> all,
                std::vector<std::uint32_t>& places) {
  places.resize(some.size());
  std::uint32_t place = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    while (all[place] != some[i]) ++place;
    places[i] = place;
  }
}

}  // namespace

Marginals::Marginals(const SeparatorTree& tree)
    : tree_(&tree),
      mean_ppm_(tree.cells(), kNaN),
      variance_ppm2_(tree.cells(), kNaN),
      origins_(tree.nodes().size()) {}

Marginals::Pass Marginals::Descend(const FieldFactor& factor, std::span<const std::uint8_t> dirty,
                                   const FieldShift& tolerance) {
  factor_ = &factor;
  dirty_ = dirty;
  tolerance_ = tolerance;
  healthy_ = true;
  const FieldShift error = Visit(origins_.size() - 1, 0);
  return {error, healthy_};
}

FieldShift Marginals::Visit(std::size_t node, std::size_t depth) {
  const SeparatorTree::Node& place = tree_->nodes()[node];
  const Front& front = factor_->front(node);
  Origin& origin = origins_[node];
  if (front.boundary() > 0) {
    GatherBoundary(front, factor_->front(place.parent), blocks_[depth - 1]);
  }
  if (dirty_[node] == 0) {
    const FieldShift error = Sum(Moved(front, origin), origin.below);
    if (IsWithin(error, tolerance_)) return error;
  }
  Remember(front, origin);
  std::fill(mean_ppm_.begin() + place.first, mean_ppm_.begin() + place.end, kNaN);
  std::fill(variance_ppm2_.begin() + place.first, variance_ppm2_.begin() + place.end, kNaN);
  UpdateMean(front);
  if (place.is_leaf()) {
    UpdateVariance(front);
    return origin.below = {};
  }
  if (blocks_.size() <= depth) blocks_.resize(depth + 1);
  FormBlock(front, blocks_[depth]);
  const FieldShift low = Visit(place.children[0], depth + 1);
  const FieldShift high = Visit(place.children[1], depth + 1);
  return origins_[node].below = Max(low, high);
}

// Z_RR, out of the parent's block.
void Marginals::GatherBoundary(const Front& front, const Front& parent, const Block& from) {
  const std::size_t size = front.boundary();
  FindPlaces(front.boundary_cells(), parent.cells, place_);
  boundary_.resize(size * size);
  for (std::size_t j = 0; j < size; ++j) {
    const double* const column = from.values.data() + place_[j] * from.stride;
    for (std::size_t i = j; i < size; ++i) {
      boundary_[j * size + i] = boundary_[i * size + j] = column[place_[i]];
    }
  }
}

FieldShift Marginals::Moved(const Front& front, const Origin& origin) const {
  const std::size_t size = front.boundary();
  const std::span<const Slot> cells = front.boundary_cells();
  FieldShift moved;
  const double* old = origin.covariance_ppm2.data();
  for (std::size_t j = 0; j < size; ++j) {
    const double change = std::abs(mean_ppm_[cells[j]] - origin.mean_ppm[j]);
    moved.mean_ppm = std::max(moved.mean_ppm, change);
    const double* const column = boundary_.data() + j * size;
    double most = 0.0;
    for (std::size_t i = j; i < size; ++i) most = std::max(most, std::abs(column[i] - *old++));
    moved.covariance_ppm2 = std::max(moved.covariance_ppm2, most);
  }
  return moved;
}

void Marginals::Remember(const Front& front, Origin& origin) const {
  const std::size_t size = front.boundary();
  origin.mean_ppm.clear();
  for (const Slot slot : front.boundary_cells()) origin.mean_ppm.push_back(mean_ppm_[slot]);
  origin.covariance_ppm2.clear();
  origin.covariance_ppm2.reserve(size * (size + 1) / 2);
  for (std::size_t j = 0; j < size; ++j) {
    const double* const column = boundary_.data() + j * size;
    origin.covariance_ppm2.insert(origin.covariance_ppm2.end(), column + j, column + size);
  }
}

// m_S = offset + W m_R
void Marginals::UpdateMean(const Front& front) {
  const std::span<const Slot> boundary = front.boundary_cells();
  for (std::size_t i = 0; i < front.own; ++i) mean_ppm_[front.cells[i]] = front.offset_ppm[i];
  for (std::size_t j = 0; j < boundary.size(); ++j) {
    const double mean = mean_ppm_[boundary[j]];
    const double* const weights = front.weights.data() + j * front.stride;
    for (std::size_t i = 0; i < front.own; ++i) mean_ppm_[front.cells[i]] += weights[i] * mean;
  }
  for (const Slot slot : front.own_cells()) {
    healthy_ = healthy_ && std::isfinite(mean_ppm_[slot]);
  }
}

// diag Z_SS, with Z_SS = C + W Z_RR W^T.
void Marginals::UpdateVariance(const Front& front) {
  FormCross(front);
  std::vector<double>& sum = diagonal_;
  sum.assign(front.stride, 0.0);
  for (std::size_t i = 0; i < front.own; ++i) sum[i] = front.covariance[i * front.stride + i];
  for (std::size_t k = 0; k < front.weights.size(); k += front.stride) {
    for (std::size_t i = 0; i < front.stride; ++i) sum[i] += cross_[k + i] * front.weights[k + i];
  }
  for (std::size_t i = 0; i < front.own; ++i) {
    variance_ppm2_[front.cells[i]] = sum[i];
    healthy_ = healthy_ && IsVariance(sum[i]);
  }
}

// Z_SR = W Z_RR
void Marginals::FormCross(const Front& front) {
  const std::size_t size = front.boundary();
  cross_.assign(front.stride * size, 0.0);
  Accumulate({.a = front.weights.data(),
              .a_stride = front.stride,
              .b = boundary_.data(),
              .b_column_stride = size,
              .c = cross_.data(),
              .c_stride = front.stride,
              .rows = front.own,
              .columns = size,
              .depth = size});
}

void Marginals::FormBlock(const Front& front, Block& block) {
  const std::size_t own = front.own;
  const std::size_t size = front.boundary();
  FormCross(front);
  block.stride = PaddedRows(front.cells.size());
  block.values.resize(std::max(block.values.size(), block.stride * front.cells.size()));
  for (std::size_t j = 0; j < own; ++j) {
    double* const column = block.values.data() + j * block.stride;
    std::copy_n(front.covariance.data() + j * front.stride, own, column);
    std::fill_n(column + own, block.stride - own, 0.0);
  }
  Accumulate({.a = cross_.data(),
              .a_stride = front.stride,
              .b = front.weights.data(),
              .b_row_stride = front.stride,
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
    for (std::size_t i = 0; i < size; ++i) column[own + i] = cross_[i * front.stride + j];
  }
  for (std::size_t j = 0; j < size; ++j) {
    std::copy_n(boundary_.data() + j * size + j, size - j,
                block.values.data() + (own + j) * block.stride + own + j);
  }
}

bool Marginals::Add(const PendingReading& reading) {
  const double* const x = reading.column.row(0);
  bool healthy = true;
  for (std::size_t i = 0; i < mean_ppm_.size(); ++i) {
    mean_ppm_[i] += reading.mean_factor * x[i];
    variance_ppm2_[i] -= reading.variance_factor * x[i] * x[i];
    healthy =
        healthy && (x[i] == 0.0 || (IsVariance(variance_ppm2_[i]) && std::isfinite(mean_ppm_[i])));
  }
  return healthy;
}

double Marginals::LargestMean_ppm() const {
  double largest = 0.0;
  for (const double mean : mean_ppm_)
    largest = std::max(largest, std::abs(mean));  // NaN is passed over
  return largest;
}

void Marginals::Absorb(const FieldFactor& factor, const PendingReadings& readings,
                       std::span<const std::uint8_t> dirty) {
  std::vector<double> x;
  for (std::size_t node = 0; node < origins_.size(); ++node) {
    if (dirty[node] != 0) continue;
    Origin& origin = origins_[node];
    const std::span<const Slot> cells = factor.front(node).boundary_cells();
    x.resize(cells.size());
    for (const auto& reading : readings) {
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = *reading->column.row(cells[i]);
      double* covariance = origin.covariance_ppm2.data();
      for (std::size_t j = 0; j < x.size(); ++j) {
        origin.mean_ppm[j] += reading->mean_factor * x[j];
        const double scale = reading->variance_factor * x[j];
        for (std::size_t i = j; i < x.size(); ++i) *covariance++ -= scale * x[i];
      }
    }
  }
}

}  // namespace plumescout
