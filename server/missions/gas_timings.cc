// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/gas_timings.h"

#include "core/types/quantile.h"

namespace plumescout::server {
namespace {

constexpr double kMedian = 0.5;
constexpr double kTail = 0.99;

absl::Duration Between(SteadyTime from, SteadyTime to) { return absl::FromChrono(to - from); }

}  // namespace

void LatencyWindow::Add(absl::Duration sample) {
  const double sample_ms = absl::ToDoubleMilliseconds(sample);
  if (window_ms_.size() < kLatencyWindow) {
    window_ms_.push_back(sample_ms);
  } else {
    window_ms_[static_cast<std::size_t>(samples_) % kLatencyWindow] = sample_ms;
  }
  ++samples_;
}

LatencyFigures LatencyWindow::Figures() const {
  if (window_ms_.empty()) return {};
  const auto quantile = [&](double share) {
    return absl::Milliseconds(Quantile(window_ms_, share));
  };
  return {samples_, quantile(kMedian), quantile(kTail), quantile(1.0)};
}

void GasTimer::NoteReading(SteadyTime now) {
  if (!waiting_since_.has_value()) waiting_since_ = now;
}

void GasTimer::NoteRefresh(SteadyTime from, SteadyTime now) {
  if (!refreshed_since_.has_value()) refreshed_since_ = waiting_since_;
  waiting_since_.reset();
  metrics_->NoteRefresh(Between(from, now));
  absl::MutexLock lock(&mutex_);
  updates_.Add(Between(from, now));
}

void GasTimer::NoteAdoption(SteadyTime from, SteadyTime now) {
  metrics_->NoteAdoption(Between(from, now));
  absl::MutexLock lock(&mutex_);
  updates_.Add(Between(from, now));
}

void GasTimer::NotePublication(SteadyTime now) {
  if (!refreshed_since_.has_value()) return;
  metrics_->NoteStaleness(Between(*refreshed_since_, now));
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
