// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission registry: a store that several servers share.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/hash/hash.h"
#include "absl/strings/str_cat.h"
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

// Of one that nobody reaches anyway.
constexpr absl::Duration kLongestGivingUp = absl::Seconds(5);
// Who calls here all the same is sent on for so long: it is to move, not to come back at once.
constexpr absl::Duration kGivenAway = absl::Seconds(5);

constexpr absl::Duration kLongestRemoval = absl::Seconds(5);
constexpr int kListedAtOnce = 1000;
constexpr int kForgottenAtOnce = 100;

// By which missions of a name are sought, whosever they are: no mission's key begins with a slash.
std::string NameKey(const MissionId& id) { return absl::StrCat("/", id); }

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

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::FindByName(const MissionId& id) {
  if (nodes_ == nullptr) return MissionNotFound(id);
  const std::string name_key = NameKey(id);
  std::string key;
  {
    absl::MutexLock lock(&mutex_);
    const absl::Status answer = sought_.CallFor(name_key, clock_());
    on_called_for_();
    key = AwaitedMission(answer);
    if (key.empty()) return WithAwaitedMission(answer, name_key);
  }
  return Find(id, TenantOf(key));
}

void MissionRegistry::SeekName(const std::string& key) {
  const MissionId id = MissionIdOf(key);
  const auto named = nodes_->ListMissions({.last_part = id, .limit = 2});
  absl::Status answer = named.status();
  if (named.ok()) {
    answer = named->empty()       ? MissionNotFound(id)
             : named->size() == 1 ? WithAwaitedMission(Recovering(id), named->front().key)
                                  : NameOfSeveral(id);
  }
  std::vector<RecoveryWaiters::Look> waiters;
  {
    absl::MutexLock lock(&mutex_);
    sought_.Settle(key, answer, clock_());
    waiters = waiters_.TakeOf(key);
  }
  for (const auto& look : waiters) look();
}

absl::StatusOr<std::vector<OwnedMission>> MissionRegistry::ListElsewhere(
    const std::string& after, int limit, const std::string& begins_with,
    const WantedKey& wanted) const {
  std::vector<OwnedMission> elsewhere;
  if (nodes_ == nullptr) return elsewhere;
  OwnedMissionQuery query{.after = after, .begins_with = begins_with, .limit = kListedAtOnce};
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<OwnedMission> page, nodes_->ListMissions(query));
    for (OwnedMission& mission : page) {
      query.after = mission.key;
      const bool is_here = mission.node == node() && mission.damage.empty();
      if (is_here || !wanted(mission.key)) continue;
      elsewhere.push_back(std::move(mission));
      if (std::ssize(elsewhere) == limit) return elsewhere;
    }
    if (std::ssize(page) < query.limit) return elsewhere;
  }
}

std::vector<KeptMission> MissionRegistry::KeptMissions(absl::Duration longer) {
  std::vector<KeptMission> missions;
  absl::MutexLock lock(&mutex_);
  const SteadyTime now = clock_();
  const auto keep = [&](const std::string& key, SteadyTime forget_at) {
    const bool for_good = forget_at == SteadyTime::max();
    missions.push_back(
        {key, for_good ? absl::InfiniteDuration() : absl::FromChrono(forget_at - now) + longer});
  };
  for (const auto& [key, host] : hosts_) keep(key, host->standing().forget_at());
  for (const SleepingMission& mission : absent_.Sleeping()) keep(mission.key, mission.forget_at);
  return missions;
}

absl::StatusOr<std::vector<MissionId>> MissionRegistry::DeleteForgotten(absl::Duration period) {
  std::vector<MissionId> deleted;
  if (nodes_ == nullptr) return deleted;
  PLUMESCOUT_RETURN_IF_ERROR(nodes_->KeepFor(KeptMissions(2 * period)));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<ForgottenMission> forgotten,
                              nodes_->ListForgotten(kForgottenAtOnce));
  for (const ForgottenMission& mission : forgotten) {
    const absl::Status status = Forget(mission);
    if (status.ok()) deleted.push_back(MissionIdOf(mission.key));
    if (absl::IsUnavailable(status) && NodeElsewhere(status).empty()) break;  // all would wait
  }
  return deleted;
}

absl::Status MissionRegistry::Forget(const ForgottenMission& mission) {
  const std::string& key = mission.key;
  {
    absl::MutexLock lock(&mutex_);
    PLUMESCOUT_RETURN_IF_ERROR(Closed(key));
    const bool is_used = hosts_.contains(key) || being_made_.contains(key) ||
                         absent_.Contains(key) || sought_.IsAskedFor(key);
    if (is_used) return absl::AbortedError("somebody calls for it");
    being_made_.insert(key);
  }
  const absl::Status status = RemoveForgotten(mission);
  std::vector<RecoveryWaiters::Look> waiters;
  {
    absl::MutexLock lock(&mutex_);
    being_made_.erase(key);
    waiters = waiters_.TakeOf(key);
  }
  for (const auto& look : waiters) look();
  return status;
}

absl::Status MissionRegistry::RemoveForgotten(const ForgottenMission& mission) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const AcquiredMission acquired, store_->Acquire(mission.key));
  if (acquired.epoch != mission.epoch + 1) {
    Release(mission.key, acquired.epoch);
    return absl::AbortedError("somebody has used it meanwhile");
  }
  struct Removal {
    absl::Notification done;
    absl::Status status;
  };
  const auto removal = std::make_shared<Removal>();  // outlives us if the store is slow
  store_->Remove(mission.key, acquired.epoch, [removal](const absl::Status& status) {
    removal->status = status;
    removal->done.Notify();
  });
  if (removal->done.WaitForNotificationWithTimeout(kLongestRemoval)) return removal->status;
  return StoreTakesNothing("a mission is not removed");
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

absl::Status MissionRegistry::RestAndRelease(MissionHost& host, SteadyTime deadline) {
  struct Rest {
    absl::Notification begun;
    absl::Status status;
  };
  const auto rest = std::make_shared<Rest>();  // outlives us if the store is slow
  PLUMESCOUT_RETURN_IF_ERROR(host.BeginRest([rest](const absl::Status& durable) {
    rest->status = durable;
    rest->begun.Notify();
  }));
  if (!rest->begun.WaitForNotificationWithTimeout(absl::FromChrono(deadline - SteadyNow()))) {
    return absl::DeadlineExceededError("it does not come to rest");
  }
  PLUMESCOUT_RETURN_IF_ERROR(rest->status);
  return nodes_->Release(host.journal().key(), host.journal().epoch());
}

void MissionRegistry::HandOver(const std::shared_ptr<MissionHost>& host, SteadyTime deadline) {
  const absl::Status status = RestAndRelease(*host, deadline);
  const std::string& key = host->journal().key();
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

absl::Status MissionRegistry::GiveUp(const StrayMission& stray) {
  const std::string& key = stray.key;
  std::shared_ptr<MissionHost> host;
  {
    absl::MutexLock lock(&mutex_);
    PLUMESCOUT_RETURN_IF_ERROR(Closed(key));
    // Whoever took it over would keep what is to go.
    if (removals_->Contains(key)) return MissionNotFound(MissionIdOf(key));
    const auto found = hosts_.find(key);
    if (found != hosts_.end()) host = found->second;
    const bool is_read = being_made_.contains(key) || sought_.IsAskedFor(key) ||
                         (absent_.Contains(key) && absent_.FindAsleep(key) == nullptr);
    if (host == nullptr && is_read) return absl::AbortedError("it is being read");
    absent_.Erase(key);
  }
  const absl::Status status = host != nullptr
                                  ? RestAndRelease(*host, After(SteadyNow(), kLongestGivingUp))
                                  : nodes_->Release(key, stray.epoch);
  {
    const absl::Status told = status.ok() ? MissionElsewhere(key, stray.came_to) : Draining();
    absl::MutexLock lock(&mutex_);
    const auto found = hosts_.find(key);
    if (host != nullptr && found != hosts_.end() && found->second == host) {
      Reap(found, told, [] {});
    }
    if (status.ok()) sought_.Tell(key, told, After(clock_(), kGivenAway));
  }
  if (host != nullptr) host->DropAll();
  return status;
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
