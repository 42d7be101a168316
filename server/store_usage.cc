// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_usage.h"

#include <utility>

namespace plumescout::server {

StoreUsage::StoreUsage(MissionStore* store, absl::Duration period)
    : store_(store), period_(period), thread_([this] { Run(); }) {}

StoreUsage::~StoreUsage() {
  stop_.Stop();
  thread_.join();
}

void StoreUsage::Run() {
  do {
    Look();
  } while (!stop_.AwaitStop(After(SteadyNow(), period_)));
}

void StoreUsage::Look() {
  if (!store_->state().status.ok()) return;
  const auto missions = store_->List();
  if (!missions.ok()) return;
  Sizes found;
  found.disk_bytes = store_->disk_bytes();
  for (const StoredMission& mission : *missions) {
    found.mission_bytes[mission.key] = mission.bytes;
    found.damaged_missions += mission.is_damaged ? 1 : 0;
  }
  absl::MutexLock lock(&mutex_);
  sizes_ = std::move(found);
}

StoreUsage::Sizes StoreUsage::sizes() const {
  absl::MutexLock lock(&mutex_);
  return sizes_;
}

}  // namespace plumescout::server
