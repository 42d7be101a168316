// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "core/gas/field/field_engine.h"
#include "core/types/options.h"
#include "core/types/rng.h"

namespace plumescout {

// Breaks what an engine takes for granted.
struct FieldEnginePeer {
  static void PoisonVariances(FieldEngine& engine, double variance_ppm2) {
    for (double& variance : engine.marginals_.variance_ppm2_) variance = variance_ppm2;
  }
  // What each says to its parent.
  static void PoisonFronts(FieldEngine& engine) {
    for (std::shared_ptr<const Front>& front : engine.factor_.fronts_) {
      auto poisoned = std::make_shared<Front>(*front);
      std::fill(poisoned->message.begin(), poisoned->message.end(), std::nan(""));
      front = std::move(poisoned);
    }
  }
  static void PoisonInput(FieldEngine& engine, std::size_t cell, double precision) {
    const Slot slot = engine.tree_->slot(cell);
    engine.cells_.active[slot] = 1;
    engine.cells_.precision[slot] = precision;
  }
};

}  // namespace plumescout

namespace plumescout::testing {

// The energy of [IPP] Eq. (1)-(6) written out, factor by factor, and dense algebra. Shares no code
// with the library.
class DenseTruth {
 public:
  DenseTruth(std::size_t width, std::span<const CellInput> cells, const GasOptions& options)
      : variables_(cells.size(), kNone) {
    Eigen::Index count = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].active) variables_[i] = count++;
    }
    hessian_ = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd information = Eigen::VectorXd::Zero(count);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!cells[i].active) continue;
      hessian_(variables_[i], variables_[i]) +=
          options.background_precision_per_ppm2 + cells[i].precision;
      information(variables_[i]) = cells[i].weighted_deviation;
      const bool has_east = (i + 1) % width != 0;
      if (has_east && cells[i].linked_east) Join(i, i + 1, options.prior_precision_per_ppm2);
      if (cells[i].linked_north) Join(i, i + width, options.prior_precision_per_ppm2);
    }
    covariance_ = hessian_.inverse();
    mean_ppm_ = covariance_ * information;
  }

  // Row of an active cell.
  Eigen::Index variable(std::size_t cell) const { return variables_[cell]; }
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  const Eigen::VectorXd& mean_ppm() const { return mean_ppm_; }

 private:
  static constexpr Eigen::Index kNone = -1;

  // 1/2 lambda (m_i - m_j)^2, if both have a variable.
  void Join(std::size_t i, std::size_t j, double precision) {
    if (j >= variables_.size() || variables_[i] == kNone || variables_[j] == kNone) return;
    hessian_(variables_[i], variables_[i]) += precision;
    hessian_(variables_[j], variables_[j]) += precision;
    hessian_(variables_[i], variables_[j]) -= precision;
    hessian_(variables_[j], variables_[i]) -= precision;
  }

  std::vector<Eigen::Index> variables_;  // by cell
  Eigen::MatrixXd hessian_;
  Eigen::MatrixXd covariance_;
  Eigen::VectorXd mean_ppm_;
};

// A lattice and all that was said of its cells, with the dense truth about it.
struct FieldCase {
  std::size_t width = 0;
  std::vector<CellInput> cells;

  std::size_t height() const { return cells.size() / width; }

  void Apply(const std::vector<CellChange>& changes) {
    for (const CellChange& change : changes) cells[change.cell] = change.input;
  }

  DenseTruth Dense() const { return DenseTruth(width, cells, GasOptions()); }
};

// Exact.
inline FieldOptions DefaultField() {
  const GasOptions gas;
  FieldOptions options;
  options.prior = {gas.prior_precision_per_ppm2, gas.background_precision_per_ppm2};
  options.tolerance = {0.0, 0.0};
  return options;
}

inline FieldEngine EngineOf(const FieldCase& c, const FieldOptions& options = DefaultField()) {
  return FieldEngine(c.width, c.height(), c.cells, options);
}

// Evidence as of one to three readings, and now and then a wall to a neighbour.
inline CellInput RandomInput(bool active, double evidence_share, Rng& rng) {
  constexpr double kWallShare = 0.1;
  CellInput input;
  input.active = active;
  input.linked_east = rng.Uniform01() >= kWallShare;
  input.linked_north = rng.Uniform01() >= kWallShare;
  if (rng.Uniform01() < evidence_share) {
    input.precision = rng.Uniform(0.5, 30.0);
    input.weighted_deviation = input.precision * rng.Uniform(0.0, 50.0);
  }
  return input;
}

inline FieldCase RandomFieldCase(std::size_t width, std::size_t height, double blocked_share,
                                 Rng& rng) {
  FieldCase c{width, std::vector<CellInput>(width * height)};
  for (CellInput& cell : c.cells) cell = RandomInput(rng.Uniform01() >= blocked_share, 0.1, rng);
  return c;
}

// New activity and evidence for `count` random cells.
inline std::vector<CellChange> RandomChanges(const FieldCase& c, int count, double blocked_share,
                                             Rng& rng) {
  std::vector<CellChange> changes;
  for (int k = 0; k < count; ++k) {
    changes.push_back(
        {rng.Below(c.cells.size()), RandomInput(rng.Uniform01() >= blocked_share, 0.2, rng)});
  }
  return changes;
}

// One more reading in each of `count` random cells, active or not.
inline std::vector<CellChange> RandomReading(const FieldCase& c, Rng& rng) {
  CellChange change;
  change.cell = rng.Below(c.cells.size());
  change.input = c.cells[change.cell];
  const double precision = rng.Uniform(0.5, 20.0);
  change.input.precision += precision;
  change.input.weighted_deviation += precision * rng.Uniform(0.0, 50.0);
  return {change};
}

inline std::vector<CellChange> ReadingInAnActiveCell(const FieldCase& c, Rng& rng) {
  std::vector<CellChange> reading;
  do {
    reading = RandomReading(c, rng);
  } while (!reading[0].input.active);
  return reading;
}

// Largest errors over all active cells; expects NaN elsewhere.
inline FieldDeviation ErrorAgainst(const FieldCase& c, const FieldEngine& engine,
                                   const DenseTruth& dense) {
  FieldDeviation error;
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    if (!c.cells[i].active) {
      EXPECT_TRUE(std::isnan(engine.mean_ppm(i)) && std::isnan(engine.variance_ppm2(i)));
      continue;
    }
    const Eigen::Index v = dense.variable(i);
    const double mean = dense.mean_ppm()(v);
    const double variance = dense.covariance()(v, v);
    const double mean_error = std::abs(engine.mean_ppm(i) - mean);
    const double variance_error = std::abs(engine.variance_ppm2(i) / variance - 1.0);
    EXPECT_TRUE(std::isfinite(mean_error) && std::isfinite(variance_error)) << "cell " << i;
    error.mean_ppm = std::max(error.mean_ppm, mean_error);
    error.variance_ratio = std::max(error.variance_ratio, variance_error);
  }
  return error;
}

// The same bits in every cell.
inline bool SameFields(const FieldCase& c, const FieldEngine& a, const FieldEngine& b) {
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    const double mean[] = {a.mean_ppm(i), b.mean_ppm(i)};
    const double variance[] = {a.variance_ppm2(i), b.variance_ppm2(i)};
    if (std::memcmp(&mean[0], &mean[1], sizeof(double)) != 0) return false;
    if (std::memcmp(&variance[0], &variance[1], sizeof(double)) != 0) return false;
  }
  return true;
}

}  // namespace plumescout::testing
