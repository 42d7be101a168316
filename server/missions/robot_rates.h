// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "core/mission/conduct/ingest.h"
#include "core/types/ids.h"
#include "server/base/clock.h"
#include "server/base/token_bucket.h"

namespace plumescout::server {

// What one robot may ask for, per second; 0: any number.
struct RateOptions {
  double scans_per_s = 50.0;
  double gas_readings_per_s = 200.0;
  double ingest_bytes_per_s = 4'194'304.0;
  double plans_per_s = 10.0;
  // Of what is ingested, so much time's worth may come at once: a robot sends its log after an
  // outage.
  absl::Duration ingest_burst = absl::Seconds(60);
};

// What a batch of observations counts for.
struct RateLoad {
  double scans = 0.0;
  double gas_readings = 0.0;
  double bytes = 0.0;
};
// Entries that could not be read count as scans.
RateLoad RateLoadOf(const std::vector<IncomingObservation>& batch, std::size_t bytes);

// Holds the robots of a mission to their rates, one by one. Thread-safe.
class RobotRates {
 public:
  RobotRates(const RateOptions& options, SteadyClock clock);

  // RATE_EXCEEDED, which says when to try again, and nothing is counted.
  absl::Status AdmitBatch(const RobotId& robot, const RateLoad& load);
  absl::Status AdmitPlan(const RobotId& robot);
  // Counts a batch that is here already; returns how long to wait before the next.
  absl::Duration CountBatch(const RobotId& robot, const RateLoad& load);

 private:
  struct Buckets {
    TokenBucket scans;
    TokenBucket gas_readings;
    TokenBucket bytes;
    TokenBucket plans;
  };

  Buckets& Of(const RobotId& robot, SteadyTime now) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  static absl::Duration WaitFor(Buckets& buckets, const RateLoad& load, SteadyTime now);
  static void Take(Buckets& buckets, const RateLoad& load, SteadyTime now);

  const RateOptions options_;
  const SteadyClock clock_;

  absl::Mutex mutex_;
  std::map<RobotId, Buckets> buckets_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
