// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>

#include "server/base/clock.h"

namespace plumescout::server {

// Ends the waits of a thread that has something to do at its times. They are waits by the monotonic
// clock: those of absl::Mutex end by the wall clock, early or an hour late if it is set meanwhile.
// Thread-safe.
class StopSignal {
 public:
  void Stop() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopped_ = true;
    }
    change_.notify_all();
  }
  // Returns then, or as soon as somebody has called Stop: true.
  bool AwaitStop(SteadyTime until) {
    std::unique_lock<std::mutex> lock(mutex_);
    return change_.wait_until(lock, until, [this] { return stopped_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable change_;
  bool stopped_ = false;  // guarded by mutex_
};

}  // namespace plumescout::server
