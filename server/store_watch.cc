// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_watch.h"

#include <utility>

namespace plumescout::server {

StoreWatch::StoreWatch(const MissionStore* store, absl::Duration period, Changed changed)
    : store_(store), period_(period), changed_(std::move(changed)), thread_([this] { Run(); }) {}

StoreWatch::~StoreWatch() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void StoreWatch::Run() {
  absl::MutexLock lock(&mutex_);
  while (!mutex_.AwaitWithTimeout(absl::Condition(&stopping_), period_)) {
    mutex_.Unlock();
    Look();
    mutex_.Lock();
  }
}

void StoreWatch::Look() {
  const bool available = store_->state().status.ok();
  if (std::exchange(available_, available) != available) changed_(available);
}

}  // namespace plumescout::server
