// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/sought_missions.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "server/base/errors.h"
#include "server/missions/recovery_list.h"
#include "server/store/store_errors.h"

namespace plumescout::server {

absl::Status SoughtMissions::CallFor(const std::string& key, SteadyTime now) {
  const auto found = missions_.find(key);
  if (found != missions_.end()) {
    if (found->second.is_asked_for) return Recovering(MissionIdOf(key));
    Entry& entry = found->second;
    const SteadyTime unheard_until = std::exchange(entry.unheard_until, SteadyTime());
    if (now < std::max(entry.holds_until, unheard_until)) return entry.answer;
  }
  if (missions_.size() >= options_.max_missions) {
    std::erase_if(missions_, [now](const auto& mission) {
      return !mission.second.is_asked_for && now >= mission.second.holds_until;
    });
  }
  if (missions_.size() >= options_.max_missions) {
    return Overloaded(absl::StrCat("the store is asked for ", missions_.size(), " missions"));
  }
  missions_[key] = Entry{};
  waiting_.push_back(key);
  return Recovering(MissionIdOf(key));
}

std::optional<std::string> SoughtMissions::Next() {
  if (waiting_.empty()) return std::nullopt;
  std::string key = std::move(waiting_.front());
  waiting_.pop_front();
  return key;
}

void SoughtMissions::Settle(const std::string& key, const absl::Status& status, SteadyTime now) {
  const auto found = missions_.find(key);
  if (found == missions_.end()) return;
  const absl::Duration holds =
      NodeElsewhere(status).empty() ? options_.answer_holds : options_.elsewhere_holds;
  found->second = Entry{.is_asked_for = false,
                        .answer = status,
                        .holds_until = After(now, holds),
                        .unheard_until = After(now, options_.unheard_holds)};
}

void SoughtMissions::Tell(const std::string& key, const absl::Status& status, SteadyTime until) {
  missions_[key] = Entry{.is_asked_for = false, .answer = status, .holds_until = until};
}

}  // namespace plumescout::server
