// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/base/stop_signal.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// How much room the store takes, and each mission in it. It is looked up on a thread of its own,
// for a disk or a database may take its time: whoever asks gets what was found last. The store is
// not owned and outlives it. Thread-safe.
class StoreUsage {
 public:
  struct Sizes {
    std::int64_t disk_bytes = 0;
    std::map<std::string, std::int64_t> mission_bytes;  // by key
    int damaged_missions = 0;                           // StoredMission::is_damaged
  };

  // Looks at once, and then every `period`.
  explicit StoreUsage(MissionStore* store, absl::Duration period = absl::Minutes(1));
  ~StoreUsage();
  StoreUsage(const StoreUsage&) = delete;
  StoreUsage& operator=(const StoreUsage&) = delete;

  // Nothing until the first look is over.
  Sizes sizes() const;

 private:
  void Run();
  void Look();

  MissionStore* const store_;
  const absl::Duration period_;

  mutable absl::Mutex mutex_;
  Sizes sizes_ ABSL_GUARDED_BY(mutex_);

  StopSignal stop_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::server
