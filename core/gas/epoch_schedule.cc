// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/epoch_schedule.h"

#include <algorithm>
#include <cmath>

namespace plumescout {
namespace {

// Variances aim to be right to this share, and never miss by more than that, for want of ageing.
constexpr double kAgeingAim = 0.01;
constexpr double kMostAgeingError = 0.1;

// A dissection made for other cells than the present ones costs time: one made before anything was
// known is 1.3 times as dear at 160 x 200 cells, and 3 times at 700 x 700.
constexpr double kDissectedShare = 0.2;

// Rounding: a batch of changes costs a variance that it does not recompute at most about eight
// units of the last place, so after this many they add up to 2e-11, far below the tolerance of
// 1e-5. The drift that is measured then confirms it.
constexpr std::int64_t kMostRefreshes = 10'000;

}  // namespace

int EpochSchedule::Margin_cells(const GasCellBox& box) {
  constexpr int kLeast_cells = 32;
  constexpr int kPart = 8;  // of the larger side
  return std::max(kLeast_cells, std::max(box.x1 - box.x0, box.y1 - box.y0) / kPart);
}

void EpochSchedule::NoteReading(const GasReading& reading) {
  const double variance_ppm2 = ageing_.InitialVariance_ppm2(reading);
  if (!std::isfinite(variance_ppm2)) return;
  least_variance_ppm2_ =
      has_readings_ ? std::min(least_variance_ppm2_, variance_ppm2) : variance_ppm2;
  has_readings_ = true;
}

void EpochSchedule::NoteRefresh(std::int64_t activity_changes) {
  ++refreshes_;
  activity_changes_ += activity_changes;
}

void EpochSchedule::NoteFresh(std::int64_t time_ns, std::int64_t active_cells) {
  aged_to_ns_ = time_ns;
  active_cells_ = active_cells;
  activity_changes_ = 0;
  refreshes_ = 0;
}

double EpochSchedule::AgeingError(std::int64_t time_ns) const {
  if (!ageing_.enabled() || !has_readings_) return 0.0;
  const double aged = ageing_.Precision(least_variance_ppm2_, aged_to_ns_, time_ns);
  return 1.0 / (least_variance_ppm2_ * aged) - 1.0;
}

bool EpochSchedule::IsTooOld(std::int64_t time_ns) const {
  return AgeingError(time_ns) > kMostAgeingError;
}

bool EpochSchedule::IsDue(const GasLattice& lattice, const GasCellBox& box,
                          std::int64_t time_ns) const {
  const double ageing_error = AgeingError(time_ns + kRecompute_ns);
  if (ageing_error > kMostAgeingError) return false;  // a refresh will not wait for it
  if (!HasRoom(lattice, box, Margin_cells(box) / 2)) return true;
  if (static_cast<double>(activity_changes_) >
      kDissectedShare * static_cast<double>(active_cells_)) {
    return true;
  }
  if (refreshes_ >= kMostRefreshes) return true;
  return ageing_error > kAgeingAim;
}

}  // namespace plumescout
