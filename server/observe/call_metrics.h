// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <array>
#include <set>
#include <string>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/access/rpc.h"

namespace plumescout::server {

// Counts and times calls by method. Thread-safe.
class CallMetrics {
 public:
  // The registry outlives it.
  explicit CallMetrics(prometheus::Registry& registry);

  // A call is over, whether it was let in or not.
  void Note(Rpc rpc, const absl::Status& status, absl::Duration duration);

 private:
  // The reason of a refusal, or OTHER for one more than a metric should have.
  std::string Bounded(absl::string_view reason) ABSL_LOCKS_EXCLUDED(mutex_);

  prometheus::Family<prometheus::Counter>& calls_;
  prometheus::Family<prometheus::Histogram>& durations_;
  prometheus::Family<prometheus::Counter>& refusals_;
  std::array<prometheus::Counter*, kRpcCount> ok_ = {};
  std::array<prometheus::Histogram*, kRpcCount> duration_ = {};

  absl::Mutex mutex_;
  std::set<std::string> reasons_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
