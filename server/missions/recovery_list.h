// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "server/base/clock.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// A mission that its store has and that does not run.
struct AbsentMission {
  std::string key;
  absl::Status status;     // RECOVERING, or why it cannot be recovered
  bool is_asleep = false;  // whoever calls for it wakes it

  friend bool operator==(const AbsentMission&, const AbsentMission&) = default;
};

// A mission that has left memory because nobody used it.
struct SleepingMission {
  std::string key;
  std::int64_t epoch = 0;
  std::int64_t head = 0;
  std::int64_t memory_bytes = 0;             // that it may come to hold awake; 0: not known
  SteadyTime forget_at = SteadyTime::max();  // if nobody calls for it before
};

using WantedKey = std::function<bool(const std::string& key)>;

// Missions that wait to be recovered, those that sleep until somebody calls for them, and those
// that cannot be recovered. Thread-compatible.
class RecoveryList {
 public:
  // `forget_at`: should it sleep.
  void Add(const StoredMission& mission, SteadyTime forget_at = SteadyTime::max());
  void AddAsleep(const SleepingMission& mission);
  // The next to recover, which is off the queue, but not off the list: of those that somebody has
  // called for, or else of all, the one with most events. Nothing if none waits.
  std::optional<std::string> Next();
  // It cannot be recovered; `status` is for whoever calls for it.
  void Hold(const std::string& key, const absl::Status& status);
  void Erase(const std::string& key) { missions_.erase(key); }
  // A mission that was yet to be recovered could not be, now: the next call wakes it, whether it
  // slept before or not. `epoch`: the newest of it; 0: as before. False if it is another.
  bool SleepOn(const std::string& key, std::int64_t epoch);
  // There is no room for so much memory now: it sleeps until somebody calls for it.
  // REQUIRES: Contains(key).
  void PutToSleep(const std::string& key, std::int64_t memory_bytes);
  // Its memory is counted elsewhere from now on, not in woken_memory_bytes().
  void ForgetMemory(const std::string& key);
  // Those that sleep and are to be forgotten; they are off the list.
  std::vector<SleepingMission> TakeForgotten(SteadyTime now);

  bool Contains(const std::string& key) const { return missions_.count(key) > 0; }
  // Whether it is yet to be recovered.
  bool IsWaiting(const std::string& key) const;
  std::vector<SleepingMission> Sleeping() const;
  // The one of this key, if it sleeps; null if it does not.
  const SleepingMission* FindAsleep(const std::string& key) const;
  // Why the mission does not answer; OK if it is not on the list. Puts it before others; one that
  // sleeps wakes.
  absl::Status CallFor(const std::string& key);
  // At most `limit` after this key, of those whose keys are `wanted`, in order.
  std::vector<AbsentMission> After(const std::string& key, int limit,
                                   const WantedKey& wanted) const;

  int waiting() const;  // those that are being recovered too
  int held() const;
  int asleep() const;
  int woken() const;                        // of those that wait
  std::int64_t woken_memory_bytes() const;  // that these may come to hold

 private:
  struct Entry {
    std::int64_t head = 0;
    std::int64_t epoch = 0;
    SteadyTime forget_at = SteadyTime::max();
    bool is_called_for = false;
    bool has_begun = false;
    absl::Status held = {};                               // OK: it is yet to be recovered
    std::optional<SleepingMission> sleep = std::nullopt;  // of one that sleeps, or was woken
    bool is_asleep = false;
  };

  static absl::Status StatusOf(const std::string& key, const Entry& entry);
  static bool IsWoken(const Entry& entry) {
    return entry.sleep.has_value() && !entry.is_asleep && entry.held.ok();
  }
  int Count(bool (*wanted)(const Entry&)) const;

  std::map<std::string, Entry> missions_;  // by key
};

// The mission's name in its key.
std::string MissionIdOf(const std::string& key);
std::string TenantOf(const std::string& key);

}  // namespace plumescout::server
