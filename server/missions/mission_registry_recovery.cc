// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission registry: missions that the store has and that do not run.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"
#include "server/base/log.h"
#include "server/missions/mission_registry.h"
#include "server/missions/standing_record.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

// What is said of a mission that could not be recovered.
absl::Status HeldWith(const std::string& key, const absl::Status& why) {
  if (absl::IsNotFound(why)) return MissionNotFound(MissionIdOf(key));
  const bool passes = absl::IsUnavailable(why) || absl::IsResourceExhausted(why);
  return passes ? why : MissionDamaged(MissionIdOf(key), why.message());
}

// `host`: null if it was not recovered.
void LogRecovery(const std::string& key, const MissionHost* host, const absl::Status& status,
                 SteadyTime::duration time) {
  if (host != nullptr) {
    LogInfo("mission recovered",
            {{"mission", key},
             {"revision", absl::StrCat(host->summary().revision)},
             {"took_ms", absl::StrCat(absl::ToInt64Milliseconds(absl::FromChrono(time)))}});
  } else if (!absl::IsCancelled(status) && !absl::IsNotFound(status) &&
             NodeElsewhere(status).empty()) {
    LogError("mission not recovered", {{"mission", key}, {"why", std::string(status.message())}});
  }
}

// What cannot be read of it is told to whoever calls for the mission.
absl::Duration IdleTimeToLiveOf(const StoredMission& mission) {
  const auto standing = DecodeStanding(mission.standing);
  return standing.ok() ? standing->idle_time_to_live : absl::InfiniteDuration();
}

}  // namespace

absl::Status MissionRegistry::FindStored() {
  if (store_ == nullptr || nodes_ != nullptr) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<StoredMission> stored, store_->List());
  std::stable_sort(stored.begin(), stored.end(),
                   [](const auto& a, const auto& b) { return a.head > b.head; });
  absl::MutexLock lock(&mutex_);
  for (const StoredMission& mission : stored) {
    if (hosts_.contains(mission.key)) continue;
    // Nobody knows who used it when: its time begins anew.
    const SteadyTime forget_at = After(clock_(), IdleTimeToLiveOf(mission));
    if (may_sleep() && !CheckCount().ok()) {
      absent_.AddAsleep({.key = mission.key,
                         .epoch = mission.epoch,
                         .head = mission.head,
                         .forget_at = forget_at});
    } else {
      absent_.Add(mission, forget_at);
    }
  }
  return absl::OkStatus();
}

void MissionRegistry::SetOnCalledFor(std::function<void()> on_called_for) {
  absl::MutexLock lock(&mutex_);
  on_called_for_ = std::move(on_called_for);
}

bool MissionRegistry::RecoverNext() {
  std::optional<std::string> key;
  {
    absl::MutexLock lock(&mutex_);
    if (!closed_.ok()) return false;
    key = sought_.Next();
    if (!key.has_value()) key = absent_.Next();
  }
  if (!key.has_value()) return false;
  if (key->starts_with('/')) {
    SeekName(*key);
    return true;
  }
  Recover(*key).IgnoreError();  // it is logged, and told to whoever calls for the mission
  return true;
}

absl::Status MissionRegistry::CheckRecovery(const std::string& key, bool holds_name) const {
  const absl::Status closed = Closed(key);
  if (!closed.ok() || holds_name) return closed;
  if (removals_->Contains(key)) return MissionNotFound(MissionIdOf(key));
  if (hosts_.contains(key) || being_made_.contains(key)) return MissionExists(MissionIdOf(key));
  return absent_.Contains(key) ? absl::OkStatus() : CheckCount();
}

absl::Status MissionRegistry::Recover(const std::string& key, bool holds_name) {
  if (store_ == nullptr) return absl::FailedPreconditionError("the server keeps no missions");
  const absl::Status recovered = RecoverNow(key, holds_name);
  std::vector<RecoveryWaiters::Look> waiters;
  {
    absl::MutexLock lock(&mutex_);
    // Whoever waits for one that sleeps on waits on: all it could do is wake it again at once.
    const bool sleeps_on = absl::IsUnavailable(recovered) && absent_.FindAsleep(key) != nullptr;
    if (!sleeps_on) waiters = waiters_.TakeOf(key);
  }
  for (const auto& look : waiters) look();
  return recovered;
}

absl::Status MissionRegistry::RecoverNow(const std::string& key, bool holds_name) {
  bool is_new = false;
  int life = 0;
  {
    absl::MutexLock lock(&mutex_);
    const absl::Status may = CheckRecovery(key, holds_name);
    if (!may.ok()) sought_.Settle(key, may, clock_());
    PLUMESCOUT_RETURN_IF_ERROR(may);
    life = lives_;
    is_new = !absent_.Contains(key);
    if (is_new && !holds_name) being_made_.insert(key);
  }
  const SteadyTime began = SteadyNow();
  const auto bytes = TakeRoomFor(key, holds_name);
  std::int64_t epoch = 0;  // under which it was taken over, if it was
  auto host = bytes.ok() ? maker_.Revive(
                               key, [closing = closing_] { return closing->load(); }, &epoch)
                         : absl::StatusOr<std::shared_ptr<MissionHost>>(bytes.status());
  absl::Status status = host.status();
  {
    absl::MutexLock lock(&mutex_);
    if (!holds_name) being_made_.erase(key);
    status.Update(closed_);
    status.Update(CheckLife(life));
    reserved_bytes_ -= bytes.value_or(0);
    if (status.ok()) {
      sought_.Erase(key);
      absent_.Erase(key);
      hosts_.emplace(key, *host);
      reserved_bytes_ += (*host)->options().memory_budget_bytes;
    } else if (nodes_ != nullptr) {
      absent_.Erase(key);
      sought_.Settle(key, HeldWith(key, status), clock_());
    } else if (closed_.ok() && !is_new && bytes.ok()) {
      const bool sleeps_on = absl::IsUnavailable(status) && absent_.SleepOn(key, epoch);
      if (!sleeps_on) absent_.Hold(key, HeldWith(key, status));
    }
  }
  // Those that nobody can read are nobody's to list.
  if (nodes_ != nullptr && absl::IsDataLoss(status)) {
    nodes_->NoteDamage(key, std::string(status.message())).IgnoreError();
  }
  LogRecovery(key, host.ok() ? host->get() : nullptr, status, SteadyNow() - began);
  return status;
}

std::vector<AbsentMission> MissionRegistry::ListAbsent(const std::string& after, int limit,
                                                       const WantedKey& wanted) const {
  absl::MutexLock lock(&mutex_);
  return absent_.After(after, limit, wanted);
}

AbsentCounts MissionRegistry::absent() const {
  absl::MutexLock lock(&mutex_);
  const int waking = absent_.woken();
  return {absent_.waiting() - waking, absent_.held(), absent_.asleep(), waking};
}

RecoveryWaiters::Id MissionRegistry::AwaitAnswer(const std::string& key,
                                                 RecoveryWaiters::Look look) {
  absl::MutexLock lock(&mutex_);
  const bool is_pending =
      sought_.IsAskedFor(key) || being_made_.contains(key) || absent_.IsWaiting(key);
  return is_pending && closed_.ok() ? waiters_.Add(key, std::move(look)) : 0;
}

void MissionRegistry::StopAwaiting(RecoveryWaiters::Id id) {
  RecoveryWaiters::Look look;  // nobody lets go of it under the lock
  absl::MutexLock lock(&mutex_);
  look = waiters_.Take(id);
}

absl::Status MissionRegistry::CallForAbsent(const std::string& key) {
  if (const SleepingMission* const sleeping = absent_.FindAsleep(key)) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckPlaces(key));
    PLUMESCOUT_RETURN_IF_ERROR(CheckMemory("the mission", sleeping->memory_bytes));
    const absl::Status called = absent_.CallFor(key);
    on_called_for_();
    return called;
  }
  return absent_.CallFor(key);
}

absl::Status MissionRegistry::Discard(const std::string& key, MissionJournal::Callback removed) {
  if (nodes_ == nullptr) {
    absl::MutexLock lock(&mutex_);
    if (!absl::IsDataLoss(absent_.CallFor(key))) return MissionNotFound(MissionIdOf(key));
  } else {
    PLUMESCOUT_RETURN_IF_ERROR(CheckLease());
  }
  const absl::StatusOr<AcquiredMission> stored = store_->Peek(key);
  if (!stored.ok() && !absl::IsDataLoss(stored.status())) return stored.status();
  {
    absl::MutexLock lock(&mutex_);
    absent_.Erase(key);
    sought_.Erase(key);
  }
  if (stored.ok()) {
    store_->Remove(key, stored->epoch, std::move(removed));
  } else {
    store_->Discard(key, std::move(removed));
  }
  return absl::OkStatus();
}

}  // namespace plumescout::server
