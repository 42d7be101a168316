// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace plumescout::server {

// Calls that wait until it is known what becomes of a mission that is not in memory yet.
// Thread-compatible. What is taken off the list is handed out, for somebody to let go of it without
// a lock.
class RecoveryWaiters {
 public:
  // Must not block.
  using Look = std::function<void()>;
  using Id = std::int64_t;  // 0: of none

  explicit RecoveryWaiters(std::size_t max_waiters = 1024) : max_waiters_(max_waiters) {}

  // 0 if there is no room.
  Id Add(const std::string& key, Look look);
  // Null if there is none of this id.
  Look Take(Id id);
  // Those of a mission, or all, in the order in which they came.
  std::vector<Look> TakeOf(const std::string& key);
  std::vector<Look> TakeAll();

 private:
  struct Waiter {
    std::string key;
    Look look;
  };

  std::size_t max_waiters_;
  std::map<Id, Waiter> waiters_;
  Id last_id_ = 0;
};

}  // namespace plumescout::server
