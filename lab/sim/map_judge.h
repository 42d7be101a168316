// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "client/planner_client.h"
#include "core/types/ids.h"
#include "core/types/map_snapshot.h"
#include "lab/sim/metrics.h"

namespace plumescout::lab {

// The metrics at one time of an episode, or of its end.
struct MetricSample {
  double time_s = 0.0;
  std::int64_t revision = 0;  // of the map
  MapMetrics metrics;
};

// Sequences up to which robots' observations are in a map.
using AppliedSequences = std::map<RobotId, std::int64_t>;

// The first map that holds the observations up to `least`. A server that is away or has lost the
// mission may be back in a moment, and be told everything again by its robots: after 10 s without,
// why there is none.
absl::StatusOr<MapSnapshot> AwaitMap(client::PlannerClient& planner, const MissionId& mission,
                                     const AppliedSequences& least);

// Judges a mission's map now and then while robots are at work on it. Thread-safe.
class MapJudge {
 public:
  using Listener = std::function<void(const MetricSample&, const MapSnapshot&)>;

  // `planner` must outlive the judge. period_s > 0.
  MapJudge(client::PlannerClient& planner, MissionId mission, double period_s,
           MapEvaluator evaluator, Listener listener);

  // Takes a sample if one is due, at 0 and every period. After an error nothing more is taken.
  void TakeIfDue(double time_s, const AppliedSequences& least);
  // Takes a sample of AwaitMap's map.
  absl::Status Take(double time_s, const AppliedSequences& least);

  absl::Status status() const;  // of TakeIfDue
  std::vector<MetricSample> samples() const;

 private:
  absl::Status TakeLocked(double time_s, const AppliedSequences& least)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  client::PlannerClient& planner_;
  const MissionId mission_;
  const double period_s_;
  const MapEvaluator evaluator_;
  const Listener listener_;

  mutable absl::Mutex mutex_;
  std::vector<MetricSample> samples_ ABSL_GUARDED_BY(mutex_);
  absl::Status status_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::lab
