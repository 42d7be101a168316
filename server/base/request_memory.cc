// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/request_memory.h"

#include <utility>

#include "proto/convert/field.h"
#include "server/base/errors.h"

namespace plumescout::server {

absl::StatusOr<RequestMemory::Begun> RequestMemory::Begin(const RequestKey& key,
                                                          std::uint64_t fingerprint,
                                                          Waiter waiter) {
  absl::MutexLock lock(&mutex_);
  DropOld();
  const auto found = entries_.find(key);
  if (found == entries_.end()) {
    entries_.emplace(key, Entry{fingerprint});
    return Begun{.run = true, .answer = std::nullopt};
  }
  Entry& entry = found->second;
  if (entry.fingerprint != fingerprint) {
    return FieldError("request_id", key.request_id, "stands for another request already");
  }
  if (!entry.running) return Begun{.run = false, .answer = entry.answer};
  if (entry.waiters.size() >= static_cast<std::size_t>(options_.max_waiting)) {
    return Overloaded("too many calls wait for the same request");
  }
  entry.waiters.push_back(std::move(waiter));
  return Begun{};
}

void RequestMemory::Conclude(const RequestKey& key, std::optional<std::string> answer) {
  if (!answer) {
    Waiter next;
    do {
      next = NextInLine(key);
    } while (next && !next(nullptr));
    return;
  }
  std::deque<Waiter> waiters;
  {
    absl::MutexLock lock(&mutex_);
    const auto found = entries_.find(key);
    if (found == entries_.end()) return;
    waiters.swap(found->second.waiters);
    Keep(key, found->second, *answer);
    DropOld();
  }
  for (const Waiter& waiter : waiters) waiter(&*answer);
}

void RequestMemory::Forget(const RequestKey& key) {
  absl::MutexLock lock(&mutex_);
  const auto found = entries_.find(key);
  if (found != entries_.end() && !found->second.running) Erase(key);
}

void RequestMemory::Keep(const RequestKey& key, Entry& entry, std::string answer) {
  bytes_ += static_cast<std::int64_t>(answer.size());
  entry.running = false;
  entry.answer = std::move(answer);
  entry.answered = options_.clock();
  entry.place = oldest_first_.insert(oldest_first_.end(), key);
}

void RequestMemory::Erase(const RequestKey& key) {
  const auto found = entries_.find(key);
  bytes_ -= static_cast<std::int64_t>(found->second.answer.size());
  oldest_first_.erase(found->second.place);
  entries_.erase(found);
}

void RequestMemory::DropOld() {
  const SteadyTime now = options_.clock();
  while (!oldest_first_.empty()) {
    const RequestKey oldest = oldest_first_.front();
    const bool too_many = oldest_first_.size() > static_cast<std::size_t>(options_.max_answers) ||
                          bytes_ > options_.max_bytes;
    const bool too_old = now >= After(entries_.at(oldest).answered, options_.max_age);
    if (!too_many && !too_old) return;
    Erase(oldest);
  }
}

RequestMemory::Waiter RequestMemory::NextInLine(const RequestKey& key) {
  absl::MutexLock lock(&mutex_);
  const auto found = entries_.find(key);
  if (found == entries_.end()) return nullptr;
  std::deque<Waiter>& waiters = found->second.waiters;
  if (waiters.empty()) {
    entries_.erase(found);
    return nullptr;
  }
  Waiter next = std::move(waiters.front());
  waiters.pop_front();
  return next;
}

}  // namespace plumescout::server
