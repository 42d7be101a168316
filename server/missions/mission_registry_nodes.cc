// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission registry: a store that several servers share.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "absl/time/clock.h"
#include "core/mission/conduct/conduct_errors.h"
#include "server/base/errors.h"
#include "server/base/log.h"
#include "server/missions/mission_registry.h"
#include "server/store/store_nodes.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kSnapshotLook = absl::Milliseconds(2);

absl::Status LeaseLost() { return StoreTakesNothing("this node has no lease in it"); }

}  // namespace

absl::Status MissionRegistry::CheckLife(int life) const {
  return life == lives_ ? absl::OkStatus() : LeaseLost();
}

absl::Status MissionRegistry::CheckLease() const {
  return nodes_ == nullptr || clock_() < nodes_->lease_until() ? absl::OkStatus() : LeaseLost();
}

absl::StatusOr<std::shared_ptr<void>> MissionRegistry::HoldName(const std::string& key) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckName(MissionIdOf(key), key));
  being_made_.insert(key);
  return std::shared_ptr<void>(nullptr, [this, key](void*) {
    absl::MutexLock release(&mutex_);
    being_made_.erase(key);
  });
}

absl::Status MissionRegistry::Seek(const std::string& key) {
  if (being_made_.contains(key)) return Recovering(MissionIdOf(key));
  const absl::Status answer = sought_.CallFor(key, clock_());
  on_called_for_();
  return answer;
}

bool MissionRegistry::TakeSnapshots(SteadyTime deadline) {
  const auto hosts = List("", std::numeric_limits<int>::max());
  struct Begun {
    absl::Mutex mutex;
    std::size_t left ABSL_GUARDED_BY(mutex) = 0;
  };
  const auto begun = std::make_shared<Begun>();  // outlives us if a writer is slow
  for (const auto& host : hosts) {
    const auto note = [begun] {
      absl::MutexLock lock(&begun->mutex);
      --begun->left;
    };
    {
      absl::MutexLock lock(&begun->mutex);
      ++begun->left;
    }
    if (!host->BeginSnapshot(note).ok()) note();
  }
  {
    const auto have_all = [&begun] {
      begun->mutex.AssertHeld();
      return begun->left == 0;
    };
    absl::MutexLock lock(&begun->mutex);
    const absl::Duration left = absl::FromChrono(deadline - SteadyNow());
    if (!begun->mutex.AwaitWithTimeout(absl::Condition(&have_all), left)) return false;
  }
  for (const auto& host : hosts) {
    while (host->is_taking_snapshot()) {
      if (SteadyNow() >= deadline) return false;
      absl::SleepFor(kSnapshotLook);
    }
  }
  return true;
}

void MissionRegistry::LoseAll(const absl::Status& status) {
  Hosts hosts;
  {
    absl::MutexLock lock(&mutex_);
    ++lives_;
    absent_ = RecoveryList();
    hosts = hosts_;
    while (!hosts_.empty()) Reap(hosts_.begin(), status, [] {});
  }
  for (const auto& [key, host] : hosts) host->DropAll();
}

void MissionRegistry::ReleaseAll() {
  if (nodes_ == nullptr) return;
  std::map<std::string, std::int64_t> epochs;
  {
    absl::MutexLock lock(&mutex_);
    for (const auto& journal : journals_) epochs[journal->key()] = journal->epoch();
    for (const SleepingMission& mission : absent_.Sleeping()) epochs[mission.key] = mission.epoch;
  }
  for (const auto& [key, epoch] : epochs) {
    const absl::Status released = nodes_->Release(key, epoch);
    if (!released.ok()) {
      LogWarning("mission not released",
                 {{"mission", key}, {"why", std::string(released.message())}});
    }
  }
}

}  // namespace plumescout::server
