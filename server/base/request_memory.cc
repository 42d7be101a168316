// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/request_memory.h"

#include <algorithm>
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

void RequestMemory::Conclude(const RequestKey& key, std::optional<KeptAnswer> answer) {
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

void RequestMemory::Settle(const RequestKey& key, const Proviso* proviso, bool came_true) {
  absl::MutexLock lock(&mutex_);
  const auto found = entries_.find(key);
  // It may have made room for another, also of the same key.
  if (found == entries_.end() || found->second.answer.proviso.get() != proviso) return;
  if (!came_true) return Erase(key);
  found->second.answer.proviso = nullptr;
}

void RequestMemory::Forget(const RequestKey& key) {
  absl::MutexLock lock(&mutex_);
  const auto found = entries_.find(key);
  if (found != entries_.end() && !found->second.running) Erase(key);
}

void RequestMemory::Keep(const RequestKey& key, Entry& entry, KeptAnswer answer) {
  bytes_ += static_cast<std::int64_t>(answer.bytes.size());
  entry.running = false;
  entry.answer = std::move(answer);
  entry.answered = options_.clock();
  Shelf& shelf = shelves_[{key.caller, key.method}];
  shelf.bytes += static_cast<std::int64_t>(entry.answer.bytes.size());
  entry.place = shelf.keys.insert(shelf.keys.end(), key);
  ++answers_;
}

void RequestMemory::Erase(const RequestKey& key) {
  const auto found = entries_.find(key);
  const auto shelf = shelves_.find({key.caller, key.method});
  const auto bytes = static_cast<std::int64_t>(found->second.answer.bytes.size());
  bytes_ -= bytes;
  shelf->second.bytes -= bytes;
  --answers_;
  shelf->second.keys.erase(found->second.place);
  if (shelf->second.keys.empty()) shelves_.erase(shelf);
  entries_.erase(found);
}

void RequestMemory::DropOld() {
  const SteadyTime now = options_.clock();
  const auto is_too_old = [&](const RequestKey& key) {
    mutex_.AssertHeld();
    return now >= After(entries_.at(key).answered, options_.max_age);
  };
  for (auto shelf = shelves_.begin(); shelf != shelves_.end();) {
    const auto here = shelf++;
    while (is_too_old(here->second.keys.front())) {
      const bool is_last = here->second.keys.size() == 1;
      Erase(RequestKey(here->second.keys.front()));
      if (is_last) break;
    }
  }
  const auto drop_of_the_largest = [this](const auto& size_of) {
    mutex_.AssertHeld();
    const auto largest = std::max_element(
        shelves_.begin(), shelves_.end(),
        [&](const auto& a, const auto& b) { return size_of(a.second) < size_of(b.second); });
    Erase(RequestKey(largest->second.keys.front()));
  };
  while (answers_ > static_cast<std::size_t>(options_.max_answers)) {
    drop_of_the_largest([](const Shelf& shelf) { return shelf.keys.size(); });
  }
  while (bytes_ > options_.max_bytes) {
    drop_of_the_largest([](const Shelf& shelf) { return shelf.bytes; });
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
