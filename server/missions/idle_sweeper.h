// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/missions/mission_registry.h"

namespace plumescout::server {

// Deletes missions that nobody has called for during their idle time to live, from a thread of its
// own: ending a mission may take as long as a refresh of its posterior.
class IdleSweeper {
 public:
  // Looks every `period`. The registry is not owned and outlives this.
  IdleSweeper(MissionRegistry* registry, absl::Duration period);
  ~IdleSweeper();
  IdleSweeper(const IdleSweeper&) = delete;
  IdleSweeper& operator=(const IdleSweeper&) = delete;

 private:
  void Run();

  MissionRegistry* const registry_;
  const absl::Duration period_;

  absl::Mutex mutex_;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::server
