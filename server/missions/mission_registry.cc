// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_registry.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"

namespace plumescout::server {

MissionRegistry::MissionRegistry(const RegistryOptions& options, RegistryHooks hooks)
    : options_(options),
      store_(hooks.store),
      nodes_(store_ != nullptr ? store_->nodes() : nullptr),
      clock_(hooks.clock ? hooks.clock : options.host.clock),
      maker_(options, std::move(hooks)) {}

absl::Status MissionRegistry::CheckRoom(const MissionId& id, const std::string& key,
                                        std::int64_t bytes) const {
  PLUMESCOUT_RETURN_IF_ERROR(CheckName(id, key));
  return CheckMemory("the mission", bytes);
}

absl::Status MissionRegistry::CheckName(const MissionId& id, const std::string& key) const {
  PLUMESCOUT_RETURN_IF_ERROR(Closed(key));
  if (sought_.IsAskedFor(key)) return Recovering(id);
  if (hosts_.contains(key) || being_made_.contains(key) || absent_.Contains(key)) {
    return MissionExists(id);
  }
  return CheckPlaces(key);
}

absl::Status MissionRegistry::CheckCount() const {
  if (held_missions() < options_.max_missions) return absl::OkStatus();
  return LimitReached(absl::StrCat("the server holds ", options_.max_missions, " missions"));
}

int MissionRegistry::held_missions() const {
  return static_cast<int>(hosts_.size() + being_made_.size()) + stopping_missions_ +
         absent_.waiting() + absent_.held();
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::Create(const MissionId& id,
                                                                     const MissionOptions& options,
                                                                     const MissionOwner& owner) {
  PLUMESCOUT_RETURN_IF_ERROR(maker_.CheckChoices(options));
  const std::string key = MissionKey(owner.tenant, id);
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease());
  PLUMESCOUT_ASSIGN_OR_RETURN(const int life, Reserve(id, key, options.memory_budget_bytes));
  auto host = maker_.Make(id, options, owner);
  absl::Status status = host.status();
  std::vector<RecoveryWaiters::Look> waiters;
  {
    absl::MutexLock lock(&mutex_);
    waiters = waiters_.TakeOf(key);
    being_made_.erase(key);
    status.Update(closed_);
    status.Update(CheckLife(life));
    sought_.Erase(key);
    if (status.ok()) {
      hosts_.emplace(key, *host);
    } else {
      reserved_bytes_ -= options.memory_budget_bytes;
    }
  }
  for (const auto& look : waiters) look();
  if (!status.ok()) return status;
  return host;
}

absl::StatusOr<int> MissionRegistry::Reserve(const MissionId& id, const std::string& key,
                                             std::int64_t bytes) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckRoom(id, key, bytes));
  being_made_.insert(key);
  reserved_bytes_ += bytes;
  return lives_;
}

bool MissionRegistry::AwaitStored(SteadyTime deadline) {
  std::vector<std::shared_ptr<MissionJournal>> journals;
  {
    absl::MutexLock lock(&mutex_);
    journals = journals_;
  }
  bool all = true;
  for (const auto& journal : journals) all = journal->AwaitStored(deadline) && all;
  return all;
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::Find(const MissionId& id,
                                                                   absl::string_view tenant) {
  absl::MutexLock lock(&mutex_);
  const std::string key = MissionKey(tenant, id);
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease());
  const auto found = hosts_.find(key);
  const bool is_gone =
      found != hosts_.end() && nodes_ != nullptr && found->second->journal().is_lost();
  if (is_gone) Reap(found, Recovering(id), [] {});
  if (found != hosts_.end() && !is_gone) return found->second;
  if (!successors_.empty()) return Closed(key);
  if (removals_->Contains(key)) return MissionNotFound(id);
  PLUMESCOUT_RETURN_IF_ERROR(WithAwaitedMission(CallForAbsent(key), key));
  return nodes_ == nullptr ? MissionNotFound(id) : WithAwaitedMission(Seek(key), key);
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::FindOfAnyTenant(const MissionId& id) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease());
  const auto found = List("", 2, [&id](const MissionHost& host) { return host.id() == id; });
  const std::vector<AbsentMission> absent =
      ListAbsent("", 2, [&id](const std::string& key) { return MissionIdOf(key) == id; });
  if (found.empty() && absent.empty()) return FindByName(id);
  if (found.size() == 1 && absent.empty()) return found[0];
  if (found.empty() && absent.size() == 1) return Find(id, TenantOf(absent[0].key));
  return NameOfSeveral(id);
}

std::vector<std::shared_ptr<MissionHost>> MissionRegistry::List(
    const std::string& after, int limit,
    const std::function<bool(const MissionHost&)>& wanted) const {
  std::vector<std::shared_ptr<MissionHost>> page;
  absl::MutexLock lock(&mutex_);
  for (auto it = hosts_.upper_bound(after); it != hosts_.end(); ++it) {
    if (page.size() == static_cast<std::size_t>(limit)) break;
    if (wanted(*it->second)) page.push_back(it->second);
  }
  return page;
}

absl::Status MissionRegistry::Delete(const MissionId& id, absl::string_view tenant,
                                     MissionJournal::Callback removed) {
  absl::MutexLock lock(&mutex_);
  const auto found = hosts_.find(MissionKey(tenant, id));
  if (found == hosts_.end()) return MissionNotFound(id);
  Remove(found, std::move(removed));
  return absl::OkStatus();
}

std::vector<MissionId> MissionRegistry::DeleteIdle() {
  std::vector<MissionId> deleted;
  absl::MutexLock lock(&mutex_);
  for (auto it = hosts_.begin(); it != hosts_.end();) {
    const auto here = it++;
    if (here->second.use_count() > 1) {
      here->second->standing().Touch();
    } else if (here->second->standing().has_outlived_its_use()) {
      deleted.push_back(here->second->id());
      Remove(here, [](const absl::Status&) {});
    }
  }
  for (const SleepingMission& forgotten : absent_.TakeForgotten(clock_())) {
    deleted.push_back(MissionIdOf(forgotten.key));
    store_->Remove(forgotten.key, forgotten.epoch, [](const absl::Status&) {});
  }
  return deleted;
}

std::vector<MissionId> MissionRegistry::SleepIdle() {
  std::vector<MissionId> slept;
  if (!may_sleep()) return slept;
  absl::MutexLock lock(&mutex_);
  if (!closed_.ok()) return slept;
  for (auto it = hosts_.begin(); it != hosts_.end();) {
    const auto here = it++;
    const std::shared_ptr<MissionHost>& host = here->second;
    const bool is_idle =
        host.use_count() == 1 && host->standing().idle_time() >= options_.sleep_after;
    if (!is_idle || !host->IsReadyToSleep()) continue;
    absent_.AddAsleep({.key = here->first,
                       .epoch = host->journal().epoch(),
                       .head = host->journal().durable_revision(),
                       .memory_bytes = host->options().memory_budget_bytes,
                       .forget_at = host->standing().forget_at()});
    slept.push_back(host->id());
    Reap(here, Recovering(slept.back()), [] {});
  }
  return slept;
}

void MissionRegistry::Remove(Hosts::iterator found, MissionJournal::Callback removed) {
  removals_->Add(found->first);
  auto answered = [removals = removals_, key = found->first,
                   removed = std::move(removed)](const absl::Status& status) {
    removals->Erase(key);
    removed(status);
  };
  Reap(found, MissionNotFound(found->second->id()),
       [journal = found->second->shared_journal(), answered = std::move(answered)] {
         journal->Remove(answered);
       });
}

void MissionRegistry::Reap(Hosts::iterator found, const absl::Status& status,
                           std::function<void()> then) {
  auto host = std::move(found->second);
  hosts_.erase(found);
  ++stopping_missions_;
  const std::int64_t bytes = host->options().memory_budget_bytes;
  reaper_.Take(std::move(host), status, [this, bytes, then = std::move(then)] {
    {
      absl::MutexLock lock(&mutex_);
      reserved_bytes_ -= bytes;
      --stopping_missions_;
    }
    then();
  });
}

void MissionRegistry::EndWaits(const absl::Status& status) {
  *closing_ = true;
  std::vector<std::shared_ptr<MissionHost>> hosts;
  std::vector<RecoveryWaiters::Look> waiters;
  {
    absl::MutexLock lock(&mutex_);
    if (closed_.ok()) closed_ = status;
    for (const auto& [id, host] : hosts_) hosts.push_back(host);
    waiters = waiters_.TakeAll();
  }
  for (const auto& host : hosts) host->EndWaits(status);
  for (const auto& look : waiters) look();
}

void MissionRegistry::StopAll(const absl::Status& status) {
  *closing_ = true;
  std::map<std::string, std::shared_ptr<MissionHost>> hosts;
  {
    absl::MutexLock lock(&mutex_);
    hosts.swap(hosts_);
    for (const auto& [id, host] : hosts) {
      reserved_bytes_ -= host->options().memory_budget_bytes;
      journals_.push_back(host->shared_journal());
    }
    if (closed_.ok()) closed_ = status;
  }
  for (const auto& [id, host] : hosts) host->BeginStop(status);
  for (const auto& [id, host] : hosts) host->DropAll();
  for (auto& [id, host] : hosts) reaper_.Take(std::move(host), status);
}

}  // namespace plumescout::server
