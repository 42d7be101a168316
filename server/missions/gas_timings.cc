// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/gas_timings.h"

#include <algorithm>
#include <cmath>

namespace plumescout::server {
namespace {

constexpr double kMedian = 0.5;
constexpr double kTail = 0.99;

// Nearest rank. REQUIRES: `sorted` is not empty.
absl::Duration Quantile(const std::vector<absl::Duration>& sorted, double share) {
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(rank) - 1];
}

absl::Duration Between(SteadyTime from, SteadyTime to) { return absl::FromChrono(to - from); }

}  // namespace

void LatencyWindow::Add(absl::Duration sample) {
  if (window_.size() < kLatencyWindow) {
    window_.push_back(sample);
  } else {
    window_[static_cast<std::size_t>(samples_) % kLatencyWindow] = sample;
  }
  ++samples_;
}

LatencyFigures LatencyWindow::Figures() const {
  if (window_.empty()) return {};
  std::vector<absl::Duration> sorted = window_;
  std::sort(sorted.begin(), sorted.end());
  return {samples_, Quantile(sorted, kMedian), Quantile(sorted, kTail), sorted.back()};
}

void GasTimer::NoteReading(SteadyTime now) {
  if (!waiting_since_.has_value()) waiting_since_ = now;
}

void GasTimer::NoteRefresh(SteadyTime from, SteadyTime now) {
  if (!refreshed_since_.has_value()) refreshed_since_ = waiting_since_;
  waiting_since_.reset();
  absl::MutexLock lock(&mutex_);
  updates_.Add(Between(from, now));
}

void GasTimer::NoteAdoption(SteadyTime from, SteadyTime now) {
  absl::MutexLock lock(&mutex_);
  updates_.Add(Between(from, now));
}

void GasTimer::NotePublication(SteadyTime now) {
  if (!refreshed_since_.has_value()) return;
  absl::MutexLock lock(&mutex_);
  stalenesses_.Add(Between(*refreshed_since_, now));
  refreshed_since_.reset();
}

void GasTimer::Restart(SteadyTime now) {
  refreshed_since_.reset();
  if (waiting_since_.has_value()) waiting_since_ = now;
}

SteadyTime GasTimer::unpublished_since() const {
  if (refreshed_since_.has_value()) return *refreshed_since_;
  return waiting_since_.value_or(SteadyTime::max());
}

GasTimings GasTimer::timings() const {
  absl::MutexLock lock(&mutex_);
  return {updates_.Figures(), stalenesses_.Figures()};
}

}  // namespace plumescout::server
