// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "server/base/clock.h"

namespace plumescout::server {

struct SoughtOptions {
  // How long an answer of the store holds.
  absl::Duration answer_holds = absl::Milliseconds(500);
  // The same of a mission that another node has: as long as all take to hear it who waited for it.
  // It may move at any time, and who is sent to the next node must not be sent back.
  absl::Duration elsewhere_holds = absl::Milliseconds(20);
  // The same until somebody has heard it: longer than any caller waits who is to ask again. One
  // whose answer was gone each time that it came back would be told RECOVERING for ever.
  absl::Duration unheard_holds = absl::Seconds(10);
  std::size_t max_missions = 4096;
};

// Missions that somebody has called for and that this server, which shares its store with others,
// does not have: the store has to be asked whether there is one, and whose it is. Calls do not wait
// for it. Thread-compatible.
class SoughtMissions {
 public:
  explicit SoughtMissions(const SoughtOptions& options = {}) : options_(options) {}

  // Somebody calls for the mission. What the store has answered, if that was lately; else
  // RECOVERING, and it is among those to ask for. OVERLOADED if too many are.
  absl::Status CallFor(const std::string& key, SteadyTime now);
  // The next to ask for. Nothing if none waits.
  std::optional<std::string> Next();
  // The store has answered; no effect for others than were given out.
  void Settle(const std::string& key, const absl::Status& status, SteadyTime now);
  // What is said of the mission until then, though the store was not asked.
  void Tell(const std::string& key, const absl::Status& status, SteadyTime until);
  void Erase(const std::string& key) { missions_.erase(key); }
  // Whether the store is being asked for it.
  bool IsAskedFor(const std::string& key) const {
    const auto found = missions_.find(key);
    return found != missions_.end() && found->second.is_asked_for;
  }

 private:
  struct Entry {
    bool is_asked_for = true;  // no answer yet
    absl::Status answer = {};
    SteadyTime holds_until = {};
    SteadyTime unheard_until = {};  // the epoch of the clock once it is heard
  };

  SoughtOptions options_;
  std::map<std::string, Entry> missions_;  // by key
  std::deque<std::string> waiting_;        // keys
};

}  // namespace plumescout::server
