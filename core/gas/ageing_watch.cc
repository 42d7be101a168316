// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/ageing_watch.h"

#include <algorithm>

#include "core/gas/epoch_schedule.h"

namespace plumescout {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;
constexpr double kRecompute_s =
    static_cast<double>(EpochSchedule::kRecompute_ns) * kSecondsPerNanosecond;

// In double: the difference of any two clocks, without overflow.
double ErrorOf(const Staleness& staleness, double time_ns) {
  const double elapsed_ns = std::max(0.0, time_ns - static_cast<double>(staleness.since_ns));
  return elapsed_ns * kSecondsPerNanosecond * staleness.share_per_s;
}

// No epoch comes in time for it.
bool IsAgedAlone(const Staleness& staleness) {
  return staleness.share_per_s * kRecompute_s > AgeingWatch::kMostError;
}

}  // namespace

std::size_t AgeingWatch::Add(AnchorCell cell) {
  entries_.push_back({cell, {}});
  return entries_.size() - 1;
}

double AgeingWatch::Error(std::int64_t time_ns) const {
  double largest = 0.0;
  for (const Entry& entry : entries_) {
    largest = std::max(largest, ErrorOf(entry.staleness, static_cast<double>(time_ns)));
  }
  return largest;
}

std::vector<AnchorCell> AgeingWatch::TooOld(std::int64_t time_ns) const {
  std::vector<AnchorCell> cells;
  for (const Entry& entry : entries_) {
    if (ErrorOf(entry.staleness, static_cast<double>(time_ns)) > kMostError) {
      cells.push_back(entry.cell);
    }
  }
  return cells;
}

bool AgeingWatch::IsEpochDue(std::int64_t time_ns) const {
  const double adopted_ns =
      static_cast<double>(time_ns) + static_cast<double>(EpochSchedule::kRecompute_ns);
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return ErrorOf(entry.staleness, adopted_ns) > kAim && !IsAgedAlone(entry.staleness);
  });
}

}  // namespace plumescout
