// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/types/stop.h"
#include "server/base/clock.h"

namespace plumescout::server {

using BeliefCallback = std::function<void(absl::StatusOr<std::shared_ptr<const Belief>>)>;

// Somebody who wants a belief.
struct BeliefRequest {
  BeliefWish wish;
  SteadyTime deadline = SteadyTime::max();
  StopFn abandoned = NeverStop();  // nobody wants it any more
};

// Those who wait for a belief, served in the order in which they came. Single-threaded; each
// callback is called exactly once.
class BeliefWaiters {
 public:
  explicit BeliefWaiters(int max_waiters) : max_waiters_(max_waiters) {}

  void Add(BeliefRequest request, BeliefCallback done);
  // Serves whom the mission can serve now; drops whom time or interest has left.
  void Serve(MissionConduct& conduct, SteadyTime now);
  void FailAll(const absl::Status& status);

  // When Serve has something to drop; max() if never.
  SteadyTime next_deadline() const;

 private:
  struct Waiter {
    BeliefRequest request;
    BeliefCallback done;
  };

  const int max_waiters_;
  std::vector<Waiter> waiters_;
};

}  // namespace plumescout::server
