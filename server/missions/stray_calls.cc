// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/stray_calls.h"

#include <utility>

#include "absl/strings/str_join.h"
#include "core/types/status_macros.h"
#include "server/base/log.h"

namespace plumescout::server {

void StrayCalls::Note(const OwnedMission& mission) {
  absl::MutexLock lock(&mutex_);
  ++figures_.calls;
  if (nodes_by_key_.size() < kMaxMissions) nodes_by_key_[mission.key] = mission.node;
}

absl::Status StrayCalls::Tell() {
  std::vector<OwnedMission> strayed;
  {
    absl::MutexLock lock(&mutex_);
    for (const auto& [key, node] : nodes_by_key_) strayed.push_back({key, node});
    nodes_by_key_.clear();
  }
  return strayed.empty() ? absl::OkStatus() : nodes_->NoteStrays(strayed);
}

absl::StatusOr<Strays> StrayCalls::Exchange() {
  PLUMESCOUT_RETURN_IF_ERROR(Tell());
  return nodes_->TakeStrays(kGivenUpAtOnce);
}

void StrayCalls::Follow() {
  if (nodes_ == nullptr) return;
  // What cannot be told now is not kept: those who call come again.
  const Strays strays = Exchange().value_or(Strays());
  std::vector<std::string> known;
  {
    absl::MutexLock lock(&mutex_);
    known = std::exchange(figures_.unreached, strays.unreached);
  }
  if (!strays.unreached.empty() && strays.unreached != known) {
    LogWarning("calls do not reach nodes", {{"nodes", absl::StrJoin(strays.unreached, " ")}});
  }
  for (const StrayMission& mission : strays.missions) {
    const absl::Status given_up = give_up_(mission);
    LogWarning("mission given up", {{"mission", mission.key},
                                    {"why", "its calls do not reach this node"},
                                    {"came_to", mission.came_to},
                                    {"code", absl::StatusCodeToString(given_up.code())},
                                    {"trouble", std::string(given_up.message())}});
    absl::MutexLock lock(&mutex_);
    figures_.given_up += given_up.ok() ? 1 : 0;
  }
}

StrayFigures StrayCalls::figures() const {
  absl::MutexLock lock(&mutex_);
  return figures_;
}

}  // namespace plumescout::server
