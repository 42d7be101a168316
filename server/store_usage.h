// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "server/base/clock.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// How much of the disk each mission takes, looked up once a minute at most. The store is not owned
// and outlives it. Thread-safe.
class StoreUsage {
 public:
  explicit StoreUsage(MissionStore* store, SteadyClock clock = SteadyNow)
      : store_(store), clock_(std::move(clock)) {}

  // By key. Blocks when it has to look.
  std::map<std::string, std::int64_t> BytesByMission();

 private:
  MissionStore* const store_;
  const SteadyClock clock_;

  absl::Mutex mutex_;
  SteadyTime look_at_ ABSL_GUARDED_BY(mutex_) = SteadyTime::min();
  std::map<std::string, std::int64_t> bytes_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
