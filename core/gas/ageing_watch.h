// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/gas/anchor_cell.h"

namespace plumescout {

// How fast what the field has heard of a cell's readings grows stale: from `since_ns` on, the
// variance of each grows by at most `share_per_s` of what the field takes it for.
struct Staleness {
  std::int64_t since_ns = 0;
  double share_per_s = 0.0;
};

// Watches over cells with readings: which have to be aged, alone or in an epoch.
//
// A variance grows by the same amount per time, so by a share that is the smaller the older the
// reading: 10 s after it was taken, an epoch that needs one second finds it within a tenth, however
// precise it was. Until then its cell is aged alone, at refreshes some tenth of its age apart.
// So a precise sensor costs what the cells read in the last 10 s do, and stops no epoch.
class AgeingWatch {
 public:
  // Variances aim to be right to this share, and never miss by more than that, for want of ageing.
  static constexpr double kAim = 0.01;
  static constexpr double kMostError = 0.1;

  // A cell that is not stale; returns its entry, for Set.
  std::size_t Add(AnchorCell cell);
  void Set(std::size_t entry, const Staleness& staleness) { entries_[entry].staleness = staleness; }
  const Staleness& staleness(std::size_t entry) const { return entries_[entry].staleness; }

  // By what share true variances may exceed those that the field has heard of: weights that shrink
  // by a factor 1 / (1 + r) or less let no variance grow by more than 1 + r. Cost: O(cells), as of
  // the others; a nanosecond each.
  double Error(std::int64_t time_ns) const;
  // Those that err by more than may be published, in the order in which they were added.
  std::vector<AnchorCell> TooOld(std::int64_t time_ns) const;
  // Whether an epoch begun now would find a cell, not one that has to be aged alone meanwhile, that
  // errs by more than the aim.
  bool IsEpochDue(std::int64_t time_ns) const;

 private:
  struct Entry {
    AnchorCell cell;
    Staleness staleness;
  };
  std::vector<Entry> entries_;
};

}  // namespace plumescout
