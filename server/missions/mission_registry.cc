// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_registry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"

namespace plumescout::server {

std::int64_t CellBound(const OccupancyOptions& options) {
  const double side = std::ceil(options.max_extent_m / options.resolution_m);
  return static_cast<std::int64_t>(
      std::min(side * side, static_cast<double>(options.max_cell_count)));
}

MissionRegistry::MissionRegistry(const RegistryOptions& options, RegistryHooks hooks)
    : options_(options), hooks_(std::move(hooks)) {}

absl::Status MissionRegistry::CheckRoom(const MissionId& id, std::int64_t cells) const {
  if (hosts_.contains(id)) return MissionExists(id);
  if (hosts_.size() >= static_cast<std::size_t>(options_.max_missions)) {
    return LimitReached(absl::StrCat("the server holds ", options_.max_missions, " missions"));
  }
  if (cells > options_.max_total_cells - reserved_cells_) {
    return LimitReached(absl::StrCat("the mission's map may reach ", cells, " cells, of ",
                                     options_.max_total_cells - reserved_cells_,
                                     " left; lower max_extent_m or max_cell_count"));
  }
  return absl::OkStatus();
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::Create(
    const MissionId& id, const MissionOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(auto strategy, hooks_.make_strategy(options.planning));
  const std::int64_t cells = CellBound(options.occupancy);
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckRoom(id, cells));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(options));
  MissionHost::Parts parts{id,      std::move(mission), std::move(strategy),
                           nullptr, hooks_.epoch_pool,  hooks_.audit_pool};
  if (hooks_.make_event_sink) parts.sink = hooks_.make_event_sink(id, options);
  auto host = std::make_shared<MissionHost>(std::move(parts), options_.host);
  hosts_.emplace(id, host);
  reserved_cells_ += cells;
  return host;
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::Find(const MissionId& id) const {
  absl::MutexLock lock(&mutex_);
  const auto found = hosts_.find(id);
  if (found == hosts_.end()) return MissionNotFound(id);
  return found->second;
}

std::vector<std::shared_ptr<MissionHost>> MissionRegistry::List(const MissionId& after,
                                                                int limit) const {
  std::vector<std::shared_ptr<MissionHost>> page;
  absl::MutexLock lock(&mutex_);
  for (auto it = hosts_.upper_bound(after); it != hosts_.end(); ++it) {
    if (page.size() == static_cast<std::size_t>(limit)) break;
    page.push_back(it->second);
  }
  return page;
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionRegistry::Remove(const MissionId& id) {
  absl::MutexLock lock(&mutex_);
  const auto found = hosts_.find(id);
  if (found == hosts_.end()) return MissionNotFound(id);
  auto host = std::move(found->second);
  hosts_.erase(found);
  reserved_cells_ -= CellBound(host->options().occupancy);
  return host;
}

void MissionRegistry::StopAll(const absl::Status& status) {
  std::map<MissionId, std::shared_ptr<MissionHost>> hosts;
  {
    absl::MutexLock lock(&mutex_);
    hosts.swap(hosts_);
    reserved_cells_ = 0;
  }
  for (const auto& [id, host] : hosts) host->Stop(status);
}

}  // namespace plumescout::server
