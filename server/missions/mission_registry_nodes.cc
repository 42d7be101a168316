// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission registry: a store that several servers share.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/hash/hash.h"
#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"
#include "server/base/log.h"
#include "server/missions/mission_registry.h"
#include "server/store/store_errors.h"
#include "server/store/store_nodes.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kSnapshotLook = absl::Milliseconds(2);
constexpr absl::Duration kLongestSettling = absl::Seconds(2);
// Of one mission; so long calls wait at most that come meanwhile.
constexpr absl::Duration kLongestHandOver = absl::Seconds(1);

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

absl::Status MissionRegistry::Closed(const std::string& key) const {
  if (successors_.empty()) return closed_;
  // Any of them would do: those of one server are spread over all others.
  return MissionElsewhere(key, successors_[absl::HashOf(key) % successors_.size()]);
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

bool MissionRegistry::HandOverAll(SteadyTime deadline) {
  if (nodes_ == nullptr) return false;
  // Whoever takes a mission over is to read it quickly; until then it is served here.
  TakeSnapshots(std::min(deadline, After(SteadyNow(), kLongestSettling)));
  std::vector<std::string> successors;
  for (StoreNode& node : nodes_->ListLiving().value_or(std::vector<StoreNode>())) {
    if (node.name != nodes_->self().name) successors.push_back(std::move(node.name));
  }
  if (successors.empty()) return false;
  {
    absl::MutexLock lock(&mutex_);
    successors_ = std::move(successors);
    const auto none_is_made = [this] {
      mutex_.AssertHeld();
      return being_made_.empty();
    };
    // Those under way are given away, too.
    const SteadyTime limit = std::min(deadline, After(SteadyNow(), kLongestHandOver));
    mutex_.AwaitWithTimeout(absl::Condition(&none_is_made), absl::FromChrono(limit - SteadyNow()));
  }
  ReleaseSleeping();
  for (const auto& host : List("", std::numeric_limits<int>::max())) {
    HandOver(host, std::min(deadline, After(SteadyNow(), kLongestHandOver)));
  }
  return true;
}

void MissionRegistry::HandOver(const std::shared_ptr<MissionHost>& host, SteadyTime deadline) {
  struct Rest {
    absl::Notification begun;
    absl::Status status;
  };
  const auto rest = std::make_shared<Rest>();  // outlives us if the store is slow
  absl::Status status = host->BeginRest([rest](const absl::Status& durable) {
    rest->status = durable;
    rest->begun.Notify();
  });
  const std::string& key = host->journal().key();
  if (status.ok()) {
    const absl::Duration left = absl::FromChrono(deadline - SteadyNow());
    status = rest->begun.WaitForNotificationWithTimeout(left)
                 ? rest->status
                 : absl::DeadlineExceededError("it does not come to rest");
  }
  if (status.ok()) status = nodes_->Release(key, host->journal().epoch());
  if (status.ok()) {
    absl::MutexLock lock(&mutex_);
    const auto found = hosts_.find(key);
    if (found != hosts_.end() && found->second == host) Reap(found, Closed(key), [] {});
  } else {
    LogWarning("mission not handed over",
               {{"mission", key}, {"why", std::string(status.message())}});
    host->BeginStop(Draining());
  }
  host->DropAll();
}

void MissionRegistry::ReleaseSleeping() {
  std::vector<SleepingMission> sleeping;
  {
    absl::MutexLock lock(&mutex_);
    sleeping = absent_.Sleeping();
    for (const SleepingMission& mission : sleeping) absent_.Erase(mission.key);
  }
  for (const SleepingMission& mission : sleeping) Release(mission.key, mission.epoch);
}

void MissionRegistry::Release(const std::string& key, std::int64_t epoch) {
  const absl::Status released = nodes_->Release(key, epoch);
  if (released.ok()) return;
  LogWarning("mission not released", {{"mission", key}, {"why", std::string(released.message())}});
}

void MissionRegistry::LoseAll(const absl::Status& status) {
  Hosts hosts;
  std::vector<RecoveryWaiters::Look> waiters;
  {
    absl::MutexLock lock(&mutex_);
    ++lives_;
    waiters = waiters_.TakeAll();
    absent_ = RecoveryList();
    hosts = hosts_;
    while (!hosts_.empty()) Reap(hosts_.begin(), status, [] {});
  }
  for (const auto& [key, host] : hosts) host->DropAll();
  for (const auto& look : waiters) look();
}

void MissionRegistry::ReleaseAll() {
  if (nodes_ == nullptr) return;
  std::vector<std::shared_ptr<MissionJournal>> journals;
  {
    absl::MutexLock lock(&mutex_);
    journals = journals_;
  }
  for (const auto& journal : journals) Release(journal->key(), journal->epoch());
  ReleaseSleeping();
}

}  // namespace plumescout::server
