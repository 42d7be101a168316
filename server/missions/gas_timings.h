// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/base/clock.h"
#include "server/observe/mission_metrics.h"

namespace plumescout::server {

// Of the last kLatencyWindow samples; `samples` counts all.
struct LatencyFigures {
  std::int64_t samples = 0;
  absl::Duration median;
  absl::Duration p99;
  absl::Duration max;
};

inline constexpr std::size_t kLatencyWindow = 1024;  // at 10 Hz the last minutes

// How long one mission's gas posterior takes, by the wall clock: what GetMission tells to who may
// see the mission and no metrics.
struct GasTimings {
  LatencyFigures update;     // the writer's time for a refresh, or for adopting an epoch
  LatencyFigures staleness;  // at each publication: since the first reading that it is the first to
                             // hold was acknowledged
};

// The last samples of one latency. Metrics do not tell what it does: their histograms are of all
// missions of a server, and as coarse as their buckets. Thread-compatible.
class LatencyWindow {
 public:
  void Add(absl::Duration sample);
  LatencyFigures Figures() const;

 private:
  std::vector<double> window_ms_;  // a ring once it is full
  std::int64_t samples_ = 0;
};

// Follows readings of one mission from the acknowledgement through the posterior to a published
// belief. All calls come from one thread, but for timings().
class GasTimer {
 public:
  explicit GasTimer(MissionMetrics* metrics = &MissionMetrics::Unread()) : metrics_(metrics) {}

  void NoteReading(SteadyTime now);
  // The posterior was brought up to date with all readings noted, or an epoch was adopted.
  void NoteRefresh(SteadyTime from, SteadyTime now);
  void NoteAdoption(SteadyTime from, SteadyTime now);
  void NotePublication(SteadyTime now);
  // What is not published was not wanted: from now on it is.
  void Restart(SteadyTime now);

  // When the first reading was noted that no publication holds; max() if none.
  SteadyTime unpublished_since() const;
  // Whether a publication now would hold that reading.
  bool unpublished_in_posterior() const { return refreshed_since_.has_value(); }

  // From any thread.
  GasTimings timings() const;

 private:
  MissionMetrics* const metrics_;
  std::optional<SteadyTime> waiting_since_;    // the first reading not in the posterior
  std::optional<SteadyTime> refreshed_since_;  // the first that is, but was not published

  mutable absl::Mutex mutex_;
  LatencyWindow updates_ ABSL_GUARDED_BY(mutex_);
  LatencyWindow stalenesses_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
