// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/idle_sweeper.h"

#include "core/mission/conduct/conduct_errors.h"
#include "server/base/log.h"

namespace plumescout::server {

IdleSweeper::IdleSweeper(MissionRegistry* registry, absl::Duration period)
    : registry_(registry), period_(period), thread_([this] { Run(); }) {}

IdleSweeper::~IdleSweeper() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void IdleSweeper::Run() {
  absl::MutexLock lock(&mutex_);
  while (!mutex_.AwaitWithTimeout(absl::Condition(&stopping_), period_)) {
    mutex_.Unlock();
    for (const MissionId& id : registry_->DeleteIdle()) {
      LogInfo("mission deleted", {{"mission", id}, {"why", "idle"}});
    }
    mutex_.Lock();
  }
}

}  // namespace plumescout::server
