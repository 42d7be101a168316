// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/belief_waiters.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "server/base/errors.h"

namespace plumescout::server {
namespace {

// What to tell the waiter now; nothing if it has to wait on.
std::optional<absl::Status> Verdict(const BeliefRequest& request, const MissionConduct& conduct,
                                    SteadyTime now) {
  if (request.abandoned()) return absl::CancelledError("the caller gave up");
  const std::optional<absl::Status> verdict = conduct.Verdict(request.wish);
  if (verdict.has_value() || now < request.deadline) return verdict;
  return conduct.WaitedInVain(request.wish);
}

}  // namespace

void BeliefWaiters::Add(BeliefRequest request, BeliefCallback done) {
  if (waiters_.size() >= static_cast<std::size_t>(max_waiters_)) {
    done(Overloaded("too many calls wait for this mission"));
    return;
  }
  waiters_.push_back({std::move(request), std::move(done)});
}

void BeliefWaiters::Serve(MissionConduct& conduct, SteadyTime now) {
  std::vector<Waiter> waiting;
  std::swap(waiting, waiters_);
  for (Waiter& waiter : waiting) {
    const auto verdict = Verdict(waiter.request, conduct, now);
    if (!verdict.has_value()) {
      waiters_.push_back(std::move(waiter));
    } else if (verdict->ok()) {
      waiter.done(conduct.BeliefFor(waiter.request.wish));
    } else {
      waiter.done(*verdict);
    }
  }
}

void BeliefWaiters::FailAll(const absl::Status& status) {
  for (Waiter& waiter : std::exchange(waiters_, {})) waiter.done(status);
}

SteadyTime BeliefWaiters::next_deadline() const {
  SteadyTime next = SteadyTime::max();
  for (const Waiter& waiter : waiters_) next = std::min(next, waiter.request.deadline);
  return next;
}

}  // namespace plumescout::server
