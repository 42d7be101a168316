// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "core/gas/field/field_engine.h"
#include "tests/core/gas/dense_field.h"

namespace plumescout::testing {

// A lattice and all that was said of its cells, with the dense truth about it.
struct FieldCase {
  std::size_t width = 0;
  std::vector<CellInput> cells;

  std::size_t height() const { return cells.size() / width; }

  void Apply(const std::vector<CellChange>& changes) {
    for (const CellChange& change : changes) cells[change.cell] = change.input;
  }

  DenseField Dense() const {
    GridGeometry geometry;
    geometry.width = static_cast<int>(width);
    geometry.height = static_cast<int>(height());
    Grid<CellState> states(geometry, CellState::kUnknown);
    std::vector<DenseReading> readings;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!cells[i].active) continue;
      states[i] = CellState::kFree;
      if (cells[i].precision == 0.0) continue;
      readings.push_back({geometry.CellAtIndex(i), cells[i].precision,
                          cells[i].weighted_deviation / cells[i].precision});
    }
    return DenseField(states, readings, GasOptions());
  }
};

inline FieldOptions DefaultField() {
  const GasOptions gas;
  FieldOptions options;
  options.prior = {gas.prior_precision, gas.background_precision};
  return options;
}

inline FieldEngine EngineOf(const FieldCase& c, const FieldOptions& options = DefaultField()) {
  return FieldEngine(c.width, c.height(), c.cells, options);
}

// Evidence as of one to three readings.
inline CellInput RandomInput(bool active, double evidence_share, Rng& rng) {
  CellInput input{active, 0.0, 0.0};
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

// Largest errors over all active cells, of the variance relative, and NaN elsewhere.
inline FieldError ErrorAgainst(const FieldCase& c, const FieldEngine& engine,
                               const DenseField& dense) {
  FieldError error;
  Eigen::Index variable = 0;
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    if (!c.cells[i].active) {
      EXPECT_TRUE(std::isnan(engine.mean_ppm(i)) && std::isnan(engine.variance_ppm2(i)));
      continue;
    }
    const double mean = dense.mean_ppm()(variable);
    const double variance = dense.variance_ppm2()(variable++);
    const double mean_error = std::abs(engine.mean_ppm(i) - mean);
    const double variance_error = std::abs(engine.variance_ppm2(i) / variance - 1.0);
    EXPECT_TRUE(std::isfinite(mean_error) && std::isfinite(variance_error)) << "cell " << i;
    error.mean_ppm = std::max(error.mean_ppm, mean_error);
    error.variance_ppm2 = std::max(error.variance_ppm2, variance_error);
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
