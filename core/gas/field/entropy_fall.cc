// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/entropy_fall.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "core/gas/field/prefetch.h"
#include "core/linalg/dense_kernel.h"

namespace plumescout {
namespace {

constexpr double kEntropyShare = 0.5;
constexpr std::size_t kNodesPerStop = 16;
// Fronts of so many nodes ahead are asked of memory: first what they are, then what they hold.
constexpr std::size_t kFar = 8;
constexpr std::size_t kNear = 3;

// -1/2 ln(1 - share). Far from the readings shares are small, and the logarithm takes long.
double Nats(double share) {
  constexpr double kSmall = 1.0 / 512.0;
  if (share < kSmall) {  // the next term is below 1e-14 of the first
    double series = 1.0 / 5.0;
    for (const double term : {1.0 / 4.0, 1.0 / 3.0, 1.0 / 2.0, 1.0}) series = series * share + term;
    return kEntropyShare * share * series;
  }
  constexpr double kMostShare = 1.0 - 1e-12;  // what rounding leaves of a variance
  return -kEntropyShare * std::log1p(-std::min(share, kMostShare));
}

}  // namespace

// Adds up, node by node, what readings take away.
class EntropyFall::Sum final : public InverseColumns::Visitor {
 public:
  // Subtrees whose cells lose no greater share of their variance than this are bounded, unless it
  // is 0.
  Sum(const EntropyFall& fall, double bounded_share, const StopFn& stop)
      : fall_(fall), bounded_share_(bounded_share), stop_(stop) {}

  bool Enter(std::size_t node, std::span<const double> squares) override {
    if (stopped_ || (asked_++ % kNodesPerStop == 0 && Stops(stop_))) {
      stopped_ = true;
      return false;
    }
    const double most = *std::max_element(squares.begin(), squares.end());
    if (most <= fall_.tolerance_ppm2_) return false;
    if (bounded_share_ == 0.0) return true;
    const Bound& bound = fall_.bounds_[node];
    const double share = bound.greatest_share * most;
    if (share >= bounded_share_) return true;
    if (share == 0.0) return false;  // nothing in it has a weight
    const double chord = Nats(share) / share;
    nats_ +=
        chord * Dot(fall_.boundary_weights_.data() + bound.first, squares.data(), squares.size());
    return false;
  }

  void Take(std::span<const Slot> own, std::span<const double> squares) override {
    for (std::size_t i = 0; i < own.size(); ++i) {
      const double weight = fall_.weights_[own[i]];
      if (weight == 0.0) continue;
      nats_ += weight * Nats(squares[i] / fall_.variance_ppm2_[own[i]]);
    }
  }

  std::optional<double> nats() const {
    return stopped_ ? std::nullopt : std::optional<double>(nats_);
  }

 private:
  const EntropyFall& fall_;
  const double bounded_share_;
  const StopFn& stop_;
  double nats_ = 0.0;
  std::size_t asked_ = 0;
  bool stopped_ = false;
};

EntropyFall::EntropyFall(const FieldFactor& factor, std::vector<double> variance_ppm2,
                         std::vector<double> weights, double tolerance_ppm2)
    : factor_(&factor),
      own_variance_ppm2_(std::move(variance_ppm2)),
      variance_ppm2_(own_variance_ppm2_),
      weights_(std::move(weights)),
      tolerance_ppm2_(tolerance_ppm2) {}

EntropyFall::EntropyFall(const FieldFactor& factor, std::span<const double> variance_ppm2,
                         std::vector<double> weights, double tolerance_ppm2)
    : factor_(&factor),
      variance_ppm2_(variance_ppm2),
      weights_(std::move(weights)),
      tolerance_ppm2_(tolerance_ppm2) {}

void EntropyFall::FindBounds(const StopFn& stop) {
  if (has_bounds_) return;
  const std::size_t nodes = factor_->tree().nodes().size();
  bounds_.assign(nodes, {});
  boundary_weights_.clear();
  for (std::size_t node = 0; node < nodes; ++node) {
    if (node % kNodesPerStop == 0 && Stops(stop)) return;
    if (node + kFar < nodes) PrefetchBytes(&factor_->front(node + kFar), sizeof(Front));
    if (node + kNear < nodes) factor_->front(node + kNear).Prefetch();
    FindBound(node);
  }
  has_bounds_ = true;
}

void EntropyFall::FindBound(std::size_t node) {
  const Front& front = factor_->front(node);
  const SeparatorTree::Node& place = factor_->tree().nodes()[node];
  Bound& bound = bounds_[node];
  bound.first = boundary_weights_.size();
  if (front.boundary() == 0) return;  // never bounded
  slopes_.assign(front.cells.size(), 0.0);
  double greatest_share = 0.0;
  for (std::size_t i = 0; i < front.own; ++i) {
    const double inverse = 1.0 / variance_ppm2_[front.cells[i]];
    const double weight = weights_[front.cells[i]];
    const double row_sum = front.weight_sums[i];
    slopes_[i] = weight * inverse;
    const double share = weight > 0.0 ? row_sum * row_sum * inverse : 0.0;
    greatest_share = std::max(greatest_share, share);
  }
  if (!place.is_leaf()) {
    for (const std::uint32_t child : place.children) {
      const std::span<const std::uint32_t> places = factor_->PlacesInParent(child);
      const double* const added = boundary_weights_.data() + bounds_[child].first;
      for (std::size_t i = 0; i < places.size(); ++i) slopes_[places[i]] += added[i];
      greatest_share = std::max(greatest_share, bounds_[child].greatest_share);
    }
  }
  bound.greatest_share = greatest_share;
  for (std::size_t i = 0; i < front.own; ++i) slopes_[i] *= front.weight_sums[i];
  front.AddTransposed({slopes_.data(), front.own}, scratch_, slopes_.data() + front.own);
  boundary_weights_.insert(boundary_weights_.end(),
                           slopes_.begin() + static_cast<std::ptrdiff_t>(front.own), slopes_.end());
}

std::optional<double> EntropyFall::Of(InverseColumns& columns, const StopFn& stop) const {
  Sum sum(*this, 0.0, stop);
  columns.Descend(sum);
  return sum.nats();
}

std::optional<double> EntropyFall::AtMost(InverseColumns& columns, const StopFn& stop) const {
  if (!has_bounds_) return std::nullopt;
  constexpr double kBoundedShare = 0.3;  // there the chord is off by a fifth at most
  constexpr double kRounding = 1.0 + 1e-9;
  Sum sum(*this, kBoundedShare, stop);
  columns.Descend(sum);
  const std::optional<double> nats = sum.nats();
  return nats ? std::optional<double>(kRounding * *nats) : std::nullopt;
}

}  // namespace plumescout
