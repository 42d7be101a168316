// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/recovery_waiters.h"

#include <utility>

namespace plumescout::server {

RecoveryWaiters::Id RecoveryWaiters::Add(const std::string& key, Look look) {
  if (waiters_.size() >= max_waiters_) return 0;
  waiters_[++last_id_] = {key, std::move(look)};
  return last_id_;
}

RecoveryWaiters::Look RecoveryWaiters::Take(Id id) {
  const auto found = waiters_.find(id);
  if (found == waiters_.end()) return nullptr;
  Look look = std::move(found->second.look);
  waiters_.erase(found);
  return look;
}

std::vector<RecoveryWaiters::Look> RecoveryWaiters::TakeOf(const std::string& key) {
  std::vector<Look> looks;
  std::erase_if(waiters_, [&](auto& waiter) {
    if (waiter.second.key != key) return false;
    looks.push_back(std::move(waiter.second.look));
    return true;
  });
  return looks;
}

std::vector<RecoveryWaiters::Look> RecoveryWaiters::TakeAll() {
  std::vector<Look> looks;
  for (auto& [id, waiter] : waiters_) looks.push_back(std::move(waiter.look));
  waiters_.clear();
  return looks;
}

}  // namespace plumescout::server
