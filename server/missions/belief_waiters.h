// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
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
  StopFn abandoned = NeverStop();  // nobody wants it any more; must not block
};

// Those who wait for a belief, served in the order in which they came. Each callback is called
// exactly once. Add and Serve are for one thread, that of the mission; the rest may come from any,
// and does not wait for a belief that is being made.
class BeliefWaiters {
 public:
  explicit BeliefWaiters(int max_waiters) : max_waiters_(max_waiters) {}

  // OVERLOADED if there are too many whom neither time nor interest has left.
  void Add(BeliefRequest request, BeliefCallback done, const MissionConduct& conduct,
           SteadyTime now);
  // Serves whom the mission can serve now; drops whom time or interest has left.
  void Serve(MissionConduct& conduct, SteadyTime now);

  // Drops whom interest has left.
  void DropAbandoned();
  // Fails all, also those who come later. The first status counts.
  void Close(const absl::Status& status);

  // When Serve has something to drop; max() if never.
  SteadyTime next_deadline() const;
  int size() const;

 private:
  using Ticket = std::int64_t;
  struct Waiter {
    BeliefRequest request;
    BeliefCallback done;
  };
  // What is to be told to one of them; OK: that its belief can be made.
  struct Verdict {
    Ticket ticket = 0;
    BeliefWish wish;
    absl::Status status;
  };

  // The first verdict on those after `last`.
  std::optional<Verdict> NextVerdict(Ticket last, const MissionConduct& conduct,
                                     SteadyTime now) const;
  // Null if somebody else took it.
  BeliefCallback Take(Ticket ticket);
  void DropOver(const MissionConduct& conduct, SteadyTime now);
  bool IsFull() const;

  const int max_waiters_;
  mutable absl::Mutex mutex_;
  std::map<Ticket, Waiter> waiters_ ABSL_GUARDED_BY(mutex_);
  Ticket last_ticket_ ABSL_GUARDED_BY(mutex_) = 0;
  absl::Status closed_ ABSL_GUARDED_BY(mutex_);  // OK while they may come
};

}  // namespace plumescout::server
