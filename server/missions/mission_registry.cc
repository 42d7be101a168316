// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_registry.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"

namespace plumescout::server {

std::string MissionKey(absl::string_view tenant, const MissionId& id) {
  return tenant.empty() ? id : absl::StrCat(tenant, "/", id);  // no id has a slash
}

MissionRegistry::MissionRegistry(const RegistryOptions& options, RegistryHooks hooks)
    : options_(options), hooks_(std::move(hooks)) {}

absl::Status MissionRegistry::CheckChoices(const MissionOptions& options) const {
  const auto must_be_at_most = [](auto limit, absl::string_view option) {
    return absl::StrCat("must be at most the server's ", option, " = ", limit);
  };
  return Checker()
      .Require(options.memory_budget_bytes <= options_.mission_memory_budget_bytes,
               "memory_budget_bytes", static_cast<double>(options.memory_budget_bytes),
               must_be_at_most(options_.mission_memory_budget_bytes,
                               "limits.mission_memory_budget_bytes"))
      .Require(options.occupancy.max_cell_count <= options_.max_map_cell_count,
               "occupancy.max_cell_count", static_cast<double>(options.occupancy.max_cell_count),
               must_be_at_most(options_.max_map_cell_count, "limits.max_map_cell_count"))
      .Require(options.max_beam_count <= options_.max_beam_count, "max_beam_count",
               options.max_beam_count,
               must_be_at_most(options_.max_beam_count, "limits.max_beam_count"))
      .Require(options.max_range_m <= options_.max_range_m, "max_range_m", options.max_range_m,
               must_be_at_most(options_.max_range_m, "limits.max_range_m"))
      .status();
}

absl::Status MissionRegistry::CheckRoom(const MissionId& id, const std::string& key,
                                        std::int64_t bytes) const {
  if (!closed_.ok()) return closed_;
  if (hosts_.contains(key) || being_made_.contains(key)) return MissionExists(id);
  const int held = static_cast<int>(hosts_.size() + being_made_.size()) + stopping_missions_;
  if (held >= options_.max_missions) {
    return LimitReached(absl::StrCat("the server holds ", options_.max_missions, " missions"));
  }
  if (bytes > options_.memory_budget_bytes - reserved_bytes_) {
    return LimitReached(absl::StrCat("the mission may come to hold memory_budget_bytes = ", bytes,
                                     ", of ", options_.memory_budget_bytes - reserved_bytes_,
                                     " that limits.memory_budget_bytes has left"));
  }
  return absl::OkStatus();
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::Create(const MissionId& id,
                                                                     const MissionOptions& options,
                                                                     const MissionOwner& owner) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckChoices(options));
  const std::string key = MissionKey(owner.tenant, id);
  PLUMESCOUT_RETURN_IF_ERROR(Reserve(id, key, options.memory_budget_bytes));
  auto host = Make(id, options, owner);
  absl::Status status = host.status();
  {
    absl::MutexLock lock(&mutex_);
    being_made_.erase(key);
    status.Update(closed_);
    if (status.ok()) {
      hosts_.emplace(key, *host);
    } else {
      reserved_bytes_ -= options.memory_budget_bytes;
    }
  }
  if (!status.ok()) return status;
  return host;
}

absl::Status MissionRegistry::Reserve(const MissionId& id, const std::string& key,
                                      std::int64_t bytes) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckRoom(id, key, bytes));
  being_made_.insert(key);
  reserved_bytes_ += bytes;
  return absl::OkStatus();
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::Make(
    const MissionId& id, const MissionOptions& options, const MissionOwner& owner) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(auto strategy, hooks_.make_strategy(options.planning));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(options));
  const MissionOptions fitted = mission->options();
  MissionHost::Parts parts{id,      std::move(mission), std::move(strategy),
                           nullptr, hooks_.epoch_pool,  hooks_.audit_pool,
                           owner,   hooks_.metrics};
  if (hooks_.make_event_sink) parts.sink = hooks_.make_event_sink(id, fitted);
  return std::make_shared<MissionHost>(std::move(parts), options_.host);
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::Find(const MissionId& id,
                                                                   absl::string_view tenant) const {
  absl::MutexLock lock(&mutex_);
  const auto found = hosts_.find(MissionKey(tenant, id));
  if (found == hosts_.end()) return MissionNotFound(id);
  return found->second;
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::FindOfAnyTenant(
    const MissionId& id) const {
  const auto found = List("", 2, [&id](const MissionHost& host) { return host.id() == id; });
  if (found.empty()) return MissionNotFound(id);
  if (found.size() == 1) return found[0];
  return absl::FailedPreconditionError(
      absl::StrCat("missions/", id, " is the name of several tenants' missions"));
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
                                     std::function<void()> stopped) {
  absl::MutexLock lock(&mutex_);
  const auto found = hosts_.find(MissionKey(tenant, id));
  if (found == hosts_.end()) return MissionNotFound(id);
  Reap(found, std::move(stopped));
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
      Reap(here, [] {});
    }
  }
  return deleted;
}

void MissionRegistry::Reap(Hosts::iterator found, std::function<void()> stopped) {
  auto host = std::move(found->second);
  hosts_.erase(found);
  ++stopping_missions_;
  const std::int64_t bytes = host->options().memory_budget_bytes;
  const absl::Status status = MissionNotFound(host->id());
  reaper_.Take(std::move(host), status, [this, bytes, stopped = std::move(stopped)] {
    {
      absl::MutexLock lock(&mutex_);
      reserved_bytes_ -= bytes;
      --stopping_missions_;
    }
    stopped();
  });
}

void MissionRegistry::EndWaits(const absl::Status& status) {
  std::vector<std::shared_ptr<MissionHost>> hosts;
  {
    absl::MutexLock lock(&mutex_);
    if (closed_.ok()) closed_ = status;
    for (const auto& [id, host] : hosts_) hosts.push_back(host);
  }
  for (const auto& host : hosts) host->EndWaits(status);
}

void MissionRegistry::StopAll(const absl::Status& status) {
  std::map<std::string, std::shared_ptr<MissionHost>> hosts;
  {
    absl::MutexLock lock(&mutex_);
    hosts.swap(hosts_);
    for (const auto& [id, host] : hosts) reserved_bytes_ -= host->options().memory_budget_bytes;
    if (closed_.ok()) closed_ = status;
  }
  for (const auto& [id, host] : hosts) host->BeginStop(status);
  for (const auto& [id, host] : hosts) host->DropAll();
  for (auto& [id, host] : hosts) reaper_.Take(std::move(host), status);
}

}  // namespace plumescout::server
