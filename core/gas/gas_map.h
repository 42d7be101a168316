// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "core/gas/posterior.h"
#include "core/gas/reading_store.h"
#include "core/types/cell_state.h"
#include "core/types/gas_reading.h"
#include "core/types/grid.h"
#include "core/types/map_snapshot.h"
#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

// Gas posterior of a mission: takes readings anywhere and at any time, and recomputes mean and
// marginal variance of every free cell exactly.
//
//   GasMap gas(options);
//   gas.Add(time_ns, position, reading);
//   RETURN_IF_ERROR(gas.Refresh(occupancy.States(), now_ns));
//   gas.mean_ppm()[cell], gas.variance_ppm2()[cell]
//
// Readings are kept by position for ever. At a refresh each takes part if its cell is free, or, if
// not, in the nearest free cell one cell away; otherwise it waits. Thread-compatible.
class GasMap {
 public:
  // REQUIRES: Validate(options).ok().
  explicit GasMap(const GasOptions& options);

  // A reading that is not finite, or beyond 1e9 ppm, is counted and waits for ever.
  void Add(std::int64_t time_ns, Point2 position, const GasReading& reading);

  // Brings the posterior to `states` and ages readings to `time_ns`. On error the old posterior
  // stays: kInvalidArgument if the lattice of `states` is not that of the first refresh moved by
  // whole cells, kInternal if the factorisation fails (lambda_p / lambda_d beyond about 1e14).
  // Cost: at 160x200 free cells about 0.06 s of CPU; O(n^1.5) for n free cells.
  absl::Status Refresh(const Grid<CellState>& states, std::int64_t time_ns);

  // As of the last refresh, on its geometry; NaN off free cells. Empty before the first.
  const Grid<float>& mean_ppm() const { return mean_ppm_; }
  const Grid<float>& variance_ppm2() const { return variance_ppm2_; }
  const GasCounters& counters() const { return readings_.counters(); }
  bool stale() const { return stale_; }  // readings came since the last refresh

 private:
  GasOptions options_;
  ReadingStore readings_;
  PosteriorSolver solver_;
  Grid<float> mean_ppm_;
  Grid<float> variance_ppm2_;
  bool stale_ = false;
};

}  // namespace plumescout
