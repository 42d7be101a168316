// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_reaper.h"

#include <malloc.h>

#include <utility>

#include "absl/time/time.h"

namespace plumescout::server {

MissionReaper::~MissionReaper() {
  {
    absl::MutexLock lock(&mutex_);
    ends_ = true;
  }
  thread_.join();
}

void MissionReaper::Take(std::shared_ptr<MissionHost> host, const absl::Status& status,
                         std::function<void()> stopped) {
  host->BeginStop(status);
  absl::MutexLock lock(&mutex_);
  stopping_.push_back({std::move(host), status, std::move(stopped)});
  ++taken_;
}

bool MissionReaper::AwaitAll(SteadyTime deadline) {
  absl::MutexLock lock(&mutex_);
  const absl::Condition idle(this, &MissionReaper::IsIdle);
  if (deadline == SteadyTime::max()) {
    mutex_.Await(idle);
    return true;
  }
  return mutex_.AwaitWithTimeout(idle, absl::FromChrono(deadline - SteadyNow()));
}

void MissionReaper::Run() {
  while (true) {
    Stopping next;
    {
      absl::MutexLock lock(&mutex_);
      mutex_.Await(absl::Condition(this, &MissionReaper::HasWork));
      if (stopping_.empty()) return;
      next = std::move(stopping_.front());
      stopping_.pop_front();
    }
    next.host->Stop(next.status);
    next.host = nullptr;
    // Every thread's arena keeps what is freed in it: 220 MiB after 24 missions of 8 robots, of
    // which none was left.
    malloc_trim(0);
    next.stopped();
    absl::MutexLock lock(&mutex_);
    ++reaped_;
  }
}

}  // namespace plumescout::server
