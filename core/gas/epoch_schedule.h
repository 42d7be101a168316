// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/gas/ageing.h"
#include "core/gas/gas_lattice.h"
#include "core/types/gas_reading.h"
#include "core/types/options.h"

namespace plumescout {

// When the field should be made anew, as a function of sample time and of what changed: never of
// a clock or a machine.
class EpochSchedule {
 public:
  // The long part of an epoch gets this much sample time; a fresh field of 400,000 cells takes
  // about 0.5 s of a core.
  static constexpr std::int64_t kRecompute_ns = 1'000'000'000;
  // Cells around the active ones that a new lattice gets. Half of them are used up before the next
  // one is due, so a map that grows is made anew a number of times that follows its logarithm.
  static int Margin_cells(const GasCellBox& box);

  explicit EpochSchedule(const GasOptions& options) : ageing_(options) {}

  void NoteReading(const GasReading& reading);
  // A batch of changes, of which so many made a cell active or not.
  void NoteRefresh(std::int64_t activity_changes);
  // A field was made anew, with precisions as of `time_ns`.
  void NoteFresh(std::int64_t time_ns, std::int64_t active_cells);

  bool ages() const { return ageing_.enabled(); }
  std::int64_t aged_to_ns() const { return aged_to_ns_; }
  // By what share true variances may exceed those of readings aged to aged_to_ns(): weights that
  // shrink by a factor 1 / (1 + r) or less let no variance grow by more than 1 + r.
  double AgeingError(std::int64_t time_ns) const;
  // It has grown beyond what may be published: a refresh then ages all itself.
  bool IsTooOld(std::int64_t time_ns) const;
  bool IsDue(const GasLattice& lattice, const GasCellBox& box, std::int64_t time_ns) const;

 private:
  Ageing ageing_;
  bool has_readings_ = false;
  double least_variance_ppm2_ = 0.0;  // 1 / lambda of the most precise reading
  std::int64_t aged_to_ns_ = 0;
  std::int64_t activity_changes_ = 0;  // since the last fresh field
  std::int64_t active_cells_ = 0;      // of that field
  std::int64_t refreshes_ = 0;         // since then
};

}  // namespace plumescout
