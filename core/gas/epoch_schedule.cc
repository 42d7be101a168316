// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/epoch_schedule.h"

#include <algorithm>

namespace plumescout {
namespace {

// A dissection made for other cells than the present ones costs time: one made before anything was
// known is 1.3 times as dear at 160 x 200 cells, and 3 times at 700 x 700.
constexpr double kDissectedShare = 0.2;

// Rounding: a batch of changes costs a variance that it does not recompute at most about eight
// units of the last place, so after this many they add up to 2e-11, far below the tolerance of
// 1e-5. The drift that is measured then confirms it.
constexpr std::int64_t kMostRefreshes = 10'000;

}  // namespace

int EpochSchedule::Margin_cells(const GasCellRect& rect) {
  constexpr int kLeast_cells = 32;
  constexpr int kPart = 8;  // of the larger side
  return std::max(kLeast_cells, std::max(rect.width(), rect.height()) / kPart);
}

void EpochSchedule::NoteRefresh(std::int64_t activity_changes) {
  ++refreshes_;
  activity_changes_ += activity_changes;
}

void EpochSchedule::NoteFresh(std::int64_t active_cells) {
  active_cells_ = active_cells;
  activity_changes_ = 0;
  refreshes_ = 0;
}

bool EpochSchedule::IsDue(const GasLattice& lattice, const GasCellRect& rect) const {
  return !HasRoom(lattice, rect, Margin_cells(rect) / 2) || refreshes_ >= kMostRefreshes ||
         static_cast<double>(activity_changes_) >
             kDissectedShare * static_cast<double>(active_cells_);
}

}  // namespace plumescout
