// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission registry: places and the memory, which all missions share.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"
#include "server/missions/mission_registry.h"

namespace plumescout::server {

absl::Status MissionRegistry::CheckPlaces(const std::string& key) const {
  PLUMESCOUT_RETURN_IF_ERROR(CheckCount());
  const int most = options_.max_missions_per_tenant;
  if (most == 0) return absl::OkStatus();
  const std::string tenant = TenantOf(key);
  const auto is_of_tenant = [&tenant](const std::string& other) {
    return TenantOf(other) == tenant;
  };
  const auto held = std::count_if(hosts_.begin(), hosts_.end(),
                                  [&](const auto& host) { return is_of_tenant(host.first); }) +
                    std::count_if(being_made_.begin(), being_made_.end(), is_of_tenant);
  if (held < most) return absl::OkStatus();
  return LimitReached(
      absl::StrCat("the tenant has limits.max_missions_per_tenant = ", most, " missions"));
}

absl::Status MissionRegistry::CheckMemory(absl::string_view what, std::int64_t bytes) const {
  const std::int64_t left_bytes =
      options_.memory_budget_bytes - reserved_bytes_ - absent_.woken_memory_bytes();
  if (bytes <= left_bytes) return absl::OkStatus();
  return LimitReached(absl::StrCat(what, " may come to hold memory_budget_bytes = ", bytes, ", of ",
                                   left_bytes, " that limits.memory_budget_bytes has left"));
}

absl::StatusOr<std::shared_ptr<void>> MissionRegistry::HoldRoom(std::int64_t bytes) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckMemory("the mission as it was", bytes));
  reserved_bytes_ += bytes;
  return std::shared_ptr<void>(nullptr, [this, bytes](void*) {
    absl::MutexLock release(&mutex_);
    reserved_bytes_ -= bytes;
  });
}

std::int64_t MissionRegistry::reserved_bytes() const {
  absl::MutexLock lock(&mutex_);
  return reserved_bytes_ + absent_.woken_memory_bytes();
}

absl::StatusOr<std::int64_t> MissionRegistry::TakeRoomFor(const std::string& key, bool has_room) {
  // What cannot be read takes nothing; whoever revives it says why.
  const std::int64_t bytes = maker_.StoredBudget_bytes(key).value_or(0);
  absl::MutexLock lock(&mutex_);
  absent_.ForgetMemory(key);
  const absl::Status room = has_room ? absl::OkStatus() : CheckMemory("the mission", bytes);
  if (!room.ok()) {
    if (absent_.Contains(key)) absent_.PutToSleep(key, bytes);
    return room;
  }
  reserved_bytes_ += bytes;
  return bytes;
}

}  // namespace plumescout::server
