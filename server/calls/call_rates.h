// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "server/access/rpc.h"
#include "server/base/clock.h"
#include "server/base/token_bucket.h"

namespace plumescout::server {

// What one caller may ask for, per second; 0: any number. Five seconds' worth may come at once.
struct CallRateOptions {
  double calls_per_s = 0.0;
  double costly_calls_per_s = 0.0;  // of these, see RpcRow::is_costly
  std::size_t max_callers = 4096;   // that are known one by one; others share one account
};

// Holds callers to their rates, one by one. Thread-safe.
class CallRates {
 public:
  explicit CallRates(const CallRateOptions& options, SteadyClock clock = SteadyNow)
      : options_(options), clock_(std::move(clock)), others_(Full()) {}

  // RATE_EXCEEDED, which says when to try again, and nothing is counted. To drain the server is
  // always allowed.
  absl::Status Admit(const std::string& account, Rpc rpc) ABSL_LOCKS_EXCLUDED(mutex_);

 private:
  struct Buckets {
    TokenBucket calls;
    TokenBucket costly_calls;
  };

  Buckets Full() const;
  Buckets& Of(const std::string& account, SteadyTime now) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const CallRateOptions options_;
  const SteadyClock clock_;

  absl::Mutex mutex_;
  std::map<std::string, Buckets> buckets_ ABSL_GUARDED_BY(mutex_);
  Buckets others_ ABSL_GUARDED_BY(mutex_);
  SteadyTime next_sweep_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
