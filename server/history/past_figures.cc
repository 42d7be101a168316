// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/past_figures.h"

#include <algorithm>
#include <cstddef>

namespace plumescout::server {
namespace {

// Missions whose figures are kept, of some 100 kB each.
constexpr std::size_t kMaxReplays = 32;

}  // namespace

absl::StatusOr<v1::GetMissionFiguresResponse> PastFigures::Ask(
    const std::shared_ptr<MissionHost>& host, const PoolTurn& turn) {
  return Find(host)->Ask(turn);
}

std::shared_ptr<FigureReplay> PastFigures::Find(const std::shared_ptr<MissionHost>& host) {
  absl::MutexLock lock(&mutex_);
  auto found = std::find_if(kept_.begin(), kept_.end(),
                            [&](const Kept& kept) { return kept.host.lock() == host; });
  Kept kept =
      found == kept_.end() ? Kept{host, std::make_shared<FigureReplay>(host, &missions_)} : *found;
  if (found != kept_.end()) kept_.erase(found);
  kept_.push_back(kept);
  while (kept_.size() > kMaxReplays) kept_.pop_front();
  return kept.replay;
}

}  // namespace plumescout::server
