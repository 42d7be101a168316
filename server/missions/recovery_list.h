// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// A mission that its store has and that does not run.
struct AbsentMission {
  std::string key;
  absl::Status status;  // RECOVERING, or why it cannot be recovered

  friend bool operator==(const AbsentMission&, const AbsentMission&) = default;
};

// Missions that wait to be recovered, and those that cannot be. Thread-compatible.
class RecoveryList {
 public:
  void Add(const StoredMission& mission);
  // The next to recover, which is off the queue, but not off the list: of those that somebody has
  // called for, or else of all, the one with most events. Nothing if none waits.
  std::optional<std::string> Next();
  // It cannot be recovered; `status` is for whoever calls for it.
  void Hold(const std::string& key, const absl::Status& status);
  void Erase(const std::string& key) { missions_.erase(key); }

  bool Contains(const std::string& key) const { return missions_.count(key) > 0; }
  // Why the mission does not answer; OK if it is not on the list. Puts it before others.
  absl::Status CallFor(const std::string& key);
  // After this key, in order.
  std::vector<AbsentMission> After(const std::string& key) const;

  int waiting() const;  // those that are being recovered too
  int held() const;

 private:
  struct Entry {
    std::int64_t head = 0;
    bool is_called_for = false;
    bool has_begun = false;
    absl::Status held = {};  // OK: it is yet to be recovered
  };

  static absl::Status StatusOf(const std::string& key, const Entry& entry);

  std::map<std::string, Entry> missions_;  // by key
};

// The mission's name in its key.
std::string MissionIdOf(const std::string& key);
std::string TenantOf(const std::string& key);

}  // namespace plumescout::server
