// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/recovery_list.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "server/base/errors.h"

namespace plumescout::server {

void RecoveryList::Add(const StoredMission& mission, SteadyTime forget_at) {
  missions_[mission.key] =
      Entry{.head = mission.head, .epoch = mission.epoch, .forget_at = forget_at};
}

void RecoveryList::AddAsleep(const SleepingMission& mission) {
  missions_[mission.key] =
      Entry{.head = mission.head, .epoch = mission.epoch, .sleep = mission, .is_asleep = true};
}

bool RecoveryList::SleepOn(const std::string& key, std::int64_t epoch) {
  const auto found = missions_.find(key);
  if (found == missions_.end() || found->second.is_asleep || !found->second.held.ok()) return false;
  Entry& entry = found->second;
  if (epoch > 0) {
    entry.epoch = epoch;
    if (entry.sleep) entry.sleep->epoch = epoch;
  }
  PutToSleep(key, entry.sleep ? entry.sleep->memory_bytes : 0);
  return true;
}

void RecoveryList::PutToSleep(const std::string& key, std::int64_t memory_bytes) {
  const Entry& entry = missions_.at(key);
  SleepingMission mission = entry.sleep.value_or(SleepingMission{
      .key = key, .epoch = entry.epoch, .head = entry.head, .forget_at = entry.forget_at});
  mission.memory_bytes = memory_bytes;
  AddAsleep(mission);
}

void RecoveryList::ForgetMemory(const std::string& key) {
  const auto found = missions_.find(key);
  if (found != missions_.end() && found->second.sleep) found->second.sleep->memory_bytes = 0;
}

std::vector<SleepingMission> RecoveryList::TakeForgotten(SteadyTime now) {
  std::vector<SleepingMission> forgotten;
  std::erase_if(missions_, [&](const auto& mission) {
    const Entry& entry = mission.second;
    if (!entry.is_asleep || now < entry.sleep->forget_at) return false;
    forgotten.push_back(*entry.sleep);
    return true;
  });
  return forgotten;
}

bool RecoveryList::IsWaiting(const std::string& key) const {
  const auto found = missions_.find(key);
  return found != missions_.end() && found->second.held.ok() && !found->second.is_asleep;
}

std::vector<SleepingMission> RecoveryList::Sleeping() const {
  std::vector<SleepingMission> sleeping;
  for (const auto& [key, entry] : missions_) {
    if (entry.is_asleep) sleeping.push_back(*entry.sleep);
  }
  return sleeping;
}

const SleepingMission* RecoveryList::FindAsleep(const std::string& key) const {
  const auto found = missions_.find(key);
  if (found == missions_.end() || !found->second.is_asleep) return nullptr;
  return &*found->second.sleep;
}

std::optional<std::string> RecoveryList::Next() {
  const auto urgency = [](const Entry& entry) {
    return std::pair(entry.is_called_for, entry.head);
  };
  auto next = missions_.end();
  for (auto it = missions_.begin(); it != missions_.end(); ++it) {
    if (it->second.has_begun || it->second.is_asleep) continue;
    if (next == missions_.end() || urgency(it->second) > urgency(next->second)) next = it;
  }
  if (next == missions_.end()) return std::nullopt;
  next->second.has_begun = true;
  return next->first;
}

void RecoveryList::Hold(const std::string& key, const absl::Status& status) {
  Entry& entry = missions_[key];
  entry.has_begun = true;
  entry.held = status;
}

absl::Status RecoveryList::CallFor(const std::string& key) {
  const auto found = missions_.find(key);
  if (found == missions_.end()) return absl::OkStatus();
  found->second.is_called_for = true;
  found->second.is_asleep = false;
  return StatusOf(key, found->second);
}

absl::Status RecoveryList::StatusOf(const std::string& key, const Entry& entry) {
  return entry.held.ok() ? Recovering(MissionIdOf(key)) : entry.held;
}

std::vector<AbsentMission> RecoveryList::After(const std::string& key, int limit,
                                               const WantedKey& wanted) const {
  std::vector<AbsentMission> absent;
  for (auto it = missions_.upper_bound(key); it != missions_.end(); ++it) {
    if (absent.size() == static_cast<std::size_t>(limit)) break;
    if (!wanted(it->first)) continue;
    absent.push_back({it->first, StatusOf(it->first, it->second), it->second.is_asleep});
  }
  return absent;
}

int RecoveryList::Count(bool (*wanted)(const Entry&)) const {
  return static_cast<int>(
      std::count_if(missions_.begin(), missions_.end(),
                    [wanted](const auto& mission) { return wanted(mission.second); }));
}

int RecoveryList::waiting() const {
  return Count([](const Entry& entry) { return entry.held.ok() && !entry.is_asleep; });
}

int RecoveryList::held() const {
  return Count([](const Entry& entry) { return !entry.held.ok(); });
}

int RecoveryList::asleep() const {
  return Count([](const Entry& entry) { return entry.is_asleep; });
}

int RecoveryList::woken() const { return Count(IsWoken); }

std::int64_t RecoveryList::woken_memory_bytes() const {
  std::int64_t bytes = 0;
  for (const auto& [key, entry] : missions_) {
    if (IsWoken(entry)) bytes += entry.sleep->memory_bytes;
  }
  return bytes;
}

std::string MissionIdOf(const std::string& key) { return key.substr(key.rfind('/') + 1); }

std::string TenantOf(const std::string& key) {
  const std::size_t slash = key.rfind('/');
  return slash == std::string::npos ? "" : key.substr(0, slash);
}

}  // namespace plumescout::server
