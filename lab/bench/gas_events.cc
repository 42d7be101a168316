// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/gas_events.h"

#include <algorithm>
#include <cmath>

#include "core/types/options.h"

namespace plumescout::lab {
namespace {

constexpr int kFlipsPerRobot = 40;
constexpr std::int64_t kReach_cells = 30;
constexpr std::size_t kFlippedAtOnce = 200;

std::int64_t Offset(Rng& rng) {
  return static_cast<std::int64_t>(rng.Below(2 * kReach_cells + 1)) - kReach_cells;
}

}  // namespace

std::size_t GasEvents::ActiveCell() {
  std::size_t cell = 0;
  do {
    cell = rng_.Below(cells_.size());
  } while (!cells_[cell].active);
  return cell;
}

std::vector<CellChange> GasEvents::Reading() {
  constexpr double kPeak_ppm = 50.0;
  const std::size_t cell = ActiveCell();
  const double precision = GasOptions().observation_precision;
  cells_[cell].precision += precision;
  cells_[cell].weighted_deviation += precision * rng_.Uniform(0.0, kPeak_ppm);
  return {{cell, cells_[cell]}};
}

std::vector<CellChange> GasEvents::Scan(int robots) {
  const auto width = static_cast<std::int64_t>(width_);
  const std::int64_t height = static_cast<std::int64_t>(cells_.size()) / width;
  std::vector<CellChange> changes;
  for (int robot = 0; robot < robots; ++robot) {
    const auto at = static_cast<std::int64_t>(ActiveCell());
    for (int flips = 0; flips < kFlipsPerRobot;) {
      if (flips % 2 == 1 && flipped_.size() > kFlippedAtOnce) {
        changes.push_back(Flip(flipped_.front()));
        flipped_.pop_front();
        ++flips;
        continue;
      }
      const std::int64_t x = at % width + Offset(rng_);
      const std::int64_t y = at / width + Offset(rng_);
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      flipped_.push_back(static_cast<std::size_t>(y * width + x));
      changes.push_back(Flip(flipped_.back()));
      ++flips;
    }
  }
  return changes;
}

CellChange GasEvents::Flip(std::size_t cell) {
  cells_[cell].active = !cells_[cell].active;
  return {cell, cells_[cell]};
}

FieldEngine GasEvents::Fresh() const {
  const GasOptions gas;
  FieldOptions options;
  options.prior = {gas.prior_precision, gas.background_precision};
  return FieldEngine(width_, cells_.size() / width_, cells_, options);
}

FieldError GasEvents::ErrorOf(const FieldEngine& field) const {
  const FieldEngine fresh = Fresh();
  FieldError error;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!cells_[i].active) continue;
    const double ratio = field.variance_ppm2(i) / fresh.variance_ppm2(i);
    error.mean_ppm = std::max(error.mean_ppm, std::abs(field.mean_ppm(i) - fresh.mean_ppm(i)));
    error.variance_ratio = std::max(error.variance_ratio, std::abs(ratio - 1.0));
  }
  return error;
}

}  // namespace plumescout::lab
