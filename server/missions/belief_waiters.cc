// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/belief_waiters.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "server/base/errors.h"

namespace plumescout::server {
namespace {

// Whether time or interest has left the waiter, and what to tell it then.
std::optional<absl::Status> EndOf(const BeliefRequest& request, const MissionConduct& conduct,
                                  SteadyTime now) {
  if (request.abandoned()) return GivenUp();
  if (now >= request.deadline) return conduct.WaitedInVain(request.wish);
  return std::nullopt;
}

// What to tell the waiter now; nothing if it has to wait on. What can be served is not too late.
std::optional<absl::Status> AnswerTo(const BeliefRequest& request, const MissionConduct& conduct,
                                     SteadyTime now) {
  if (request.abandoned()) return GivenUp();
  const std::optional<absl::Status> verdict = conduct.Verdict(request.wish);
  return verdict.has_value() ? verdict : EndOf(request, conduct, now);
}

}  // namespace

void BeliefWaiters::Add(BeliefRequest request, BeliefCallback done, const MissionConduct& conduct,
                        SteadyTime now) {
  if (IsFull()) DropOver(conduct, now);
  absl::Status refusal;
  {
    absl::MutexLock lock(&mutex_);
    refusal = closed_;
    if (refusal.ok() && waiters_.size() >= static_cast<std::size_t>(max_waiters_)) {
      refusal = Overloaded("too many calls wait for this mission");
    }
    if (refusal.ok()) {
      waiters_.emplace(++last_ticket_, Waiter{std::move(request), std::move(done)});
    }
  }
  if (!refusal.ok()) done(refusal);
}

void BeliefWaiters::Serve(MissionConduct& conduct, SteadyTime now) {
  Ticket last = 0;
  while (const auto verdict = NextVerdict(last, conduct, now)) {
    last = verdict->ticket;
    // It stays with the others meanwhile: what takes long must not keep anybody from failing it.
    absl::StatusOr<std::shared_ptr<const Belief>> answer =
        verdict->status.ok() ? conduct.BeliefFor(verdict->wish) : verdict->status;
    if (const BeliefCallback done = Take(last)) done(std::move(answer));
  }
}

std::optional<BeliefWaiters::Verdict> BeliefWaiters::NextVerdict(Ticket last,
                                                                 const MissionConduct& conduct,
                                                                 SteadyTime now) const {
  absl::MutexLock lock(&mutex_);
  for (auto it = waiters_.upper_bound(last); it != waiters_.end(); ++it) {
    const BeliefRequest& request = it->second.request;
    const auto status = AnswerTo(request, conduct, now);
    if (status.has_value()) return Verdict{it->first, request.wish, *status};
  }
  return std::nullopt;
}

BeliefCallback BeliefWaiters::Take(Ticket ticket) {
  std::map<Ticket, Waiter>::node_type found;  // what it holds goes outside the lock
  absl::MutexLock lock(&mutex_);
  found = waiters_.extract(ticket);
  return found.empty() ? nullptr : std::move(found.mapped().done);
}

void BeliefWaiters::DropOver(const MissionConduct& conduct, SteadyTime now) {
  std::vector<std::pair<BeliefCallback, absl::Status>> over;
  {
    absl::MutexLock lock(&mutex_);
    for (auto it = waiters_.begin(); it != waiters_.end();) {
      const auto end = EndOf(it->second.request, conduct, now);
      if (end.has_value()) over.emplace_back(std::move(it->second.done), *end);
      it = end.has_value() ? waiters_.erase(it) : std::next(it);
    }
  }
  for (const auto& [done, status] : over) done(status);
}

void BeliefWaiters::DropAbandoned() {
  std::vector<BeliefCallback> gone;
  {
    absl::MutexLock lock(&mutex_);
    for (auto it = waiters_.begin(); it != waiters_.end();) {
      const bool abandoned = it->second.request.abandoned();
      if (abandoned) gone.push_back(std::move(it->second.done));
      it = abandoned ? waiters_.erase(it) : std::next(it);
    }
  }
  for (const BeliefCallback& done : gone) done(GivenUp());
}

void BeliefWaiters::Close(const absl::Status& status) {
  std::map<Ticket, Waiter> failed;
  absl::Status closed;
  {
    absl::MutexLock lock(&mutex_);
    if (closed_.ok()) closed_ = status;
    closed = closed_;
    failed.swap(waiters_);
  }
  for (const auto& [ticket, waiter] : failed) waiter.done(closed);
}

SteadyTime BeliefWaiters::next_deadline() const {
  SteadyTime next = SteadyTime::max();
  absl::MutexLock lock(&mutex_);
  for (const auto& [ticket, waiter] : waiters_) next = std::min(next, waiter.request.deadline);
  return next;
}

int BeliefWaiters::size() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(waiters_.size());
}

bool BeliefWaiters::IsFull() const { return size() >= max_waiters_; }

}  // namespace plumescout::server
