// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "server/base/clock.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

// Waits for missions that stop, so that nobody else has to. Thread-safe.
class MissionReaper {
 public:
  MissionReaper() : thread_([this] { Run(); }) {}
  // Waits for all of them.
  ~MissionReaper();
  MissionReaper(const MissionReaper&) = delete;
  MissionReaper& operator=(const MissionReaper&) = delete;

  // The mission begins to stop at once. `stopped` is called when its writer is no more, and it
  // itself unless others still hold it.
  void Take(
      std::shared_ptr<MissionHost> host, const absl::Status& status,
      std::function<void()> stopped = [] {});
  // False if some have not stopped by then.
  bool AwaitAll(SteadyTime deadline);

 private:
  struct Stopping {
    std::shared_ptr<MissionHost> host;
    absl::Status status;
    std::function<void()> stopped;
  };

  void Run();
  bool HasWork() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return !stopping_.empty() || ends_; }
  bool IsIdle() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return taken_ == reaped_; }

  absl::Mutex mutex_;
  std::deque<Stopping> stopping_ ABSL_GUARDED_BY(mutex_);
  int taken_ ABSL_GUARDED_BY(mutex_) = 0;
  int reaped_ ABSL_GUARDED_BY(mutex_) = 0;
  bool ends_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::server
