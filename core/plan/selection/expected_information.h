// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/belief/belief.h"
#include "core/gas/field/entropy_fall.h"
#include "core/types/options.h"
#include "core/types/pose2.h"
#include "core/types/stop.h"

namespace plumescout {

// Cells in which a robot that drives along `path` would take its readings, one for each: every
// 1 / reading_rate_hz seconds on the way at speed_mps, and while it stands for dwell_s at each
// vertex but the first; ramps and turns of the trajectory are left out. Where that makes more than
// kMaxReadings, so many at equal distances: what they bring is then a lower bound.
inline constexpr std::size_t kMaxReadings = 256;
std::vector<Cell> ReadingCells(const std::vector<Point2>& path, const GridGeometry& geometry,
                               const PlanningOptions& options);

// By how much readings lower the entropy of the gas field, cell by cell, before they are taken: the
// variance of a Gaussian field depends on where readings are taken and not on what they say, so
// this is exact (too much in gas if gas.observation_stddev_share makes readings there noisier).
// Ours.
class ExpectedInformation {
 public:
  // Holds references to the belief. Cost: O(cells).
  explicit ExpectedInformation(const Belief& belief, const StopFn& stop = {});

  // The sum over free cells of relevance (core/plan/cost/relevance.h) times 1/2 ln(variance now /
  // variance then), in nats. None if the belief has no gas field yet, or `stop` said so. Cost: that
  // of EntropyFall::Of.
  std::optional<double> Of(const std::vector<Cell>& readings, const StopFn& stop = {});
  // For AtMost. Finds none if `stop`, which is asked all along, says so. Cost: see EntropyFall.
  void FindBounds(const StopFn& stop = {});
  // No less, for less: that of EntropyFall::AtMost. None without bounds.
  std::optional<double> AtMost(const std::vector<Cell>& readings, const StopFn& stop = {});

 private:
  using Measure = std::optional<double> (EntropyFall::*)(InverseColumns&, const StopFn&) const;
  std::optional<double> Ask(Measure measure, const std::vector<Cell>& readings, const StopFn& stop);

  const Belief& belief_;
  std::optional<EntropyFall> fall_;
  std::optional<InverseColumns> used_;  // of the last question, for their memory
};

}  // namespace plumescout
