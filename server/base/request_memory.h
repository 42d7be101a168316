// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/base/clock.h"

namespace plumescout::server {

// What names a request: who sent it, to which method, and how the sender calls it.
struct RequestKey {
  std::string caller;
  std::string method;
  std::string request_id;

  friend auto operator<=>(const RequestKey&, const RequestKey&) = default;
};

// What an answer depends on that is not certain yet. Thread-safe.
class Proviso {
 public:
  using Heard = std::function<void(const absl::Status&)>;

  virtual ~Proviso() = default;
  // `heard` is called once, perhaps before this returns: with OK when it has come true, with an
  // error when it will not, or has not in time. Must not block, neither of them.
  virtual void Await(Heard heard) const = 0;
  // Whether it may come true after an error.
  virtual bool IsOpen() const = 0;
};

struct KeptAnswer {
  std::string bytes;
  std::shared_ptr<const Proviso> proviso = nullptr;  // null: there is none
};

struct RequestMemoryOptions {
  int max_answers = 256;
  std::int64_t max_bytes = 1 << 20;  // of all answers
  absl::Duration max_age = absl::Minutes(10);
  int max_waiting = 16;  // for one request that runs
  SteadyClock clock = SteadyNow;
};

// Answers by request id, so that a request whose answer was lost on its way can be sent again. Only
// answers that are OK are kept, or would be but for a proviso: any other error has changed nothing,
// so the request may as well be made anew. Bounded; the oldest answers go first, of whoever has
// most of one method: plans do not push out what other robots, or the same one, were told
// otherwise. Thread-safe.
class RequestMemory {
 public:
  // Called with the answer of an equal request; with null if that came to nothing and it is this
  // one's turn to run. False if nobody is there any more. On any thread, under no lock.
  using Waiter = std::function<bool(const KeptAnswer* answer)>;

  struct Begun {
    bool run = false;                  // nobody made the request before: Conclude follows
    std::optional<KeptAnswer> answer;  // given before
  };                                   // neither: `waiter` will be called

  explicit RequestMemory(RequestMemoryOptions options = {}) : options_(std::move(options)) {}

  // `fingerprint`: of everything in the request. kInvalidArgument if the same id stands for another
  // request; OVERLOADED if too many wait.
  absl::StatusOr<Begun> Begin(const RequestKey& key, std::uint64_t fingerprint, Waiter waiter);
  // The request ran: with this answer, or with none that is worth keeping.
  void Conclude(const RequestKey& key, std::optional<KeptAnswer> answer);
  // What became of the proviso of a kept answer: it holds from now on without one, or is forgotten.
  void Settle(const RequestKey& key, const Proviso* proviso, bool came_true);
  // Of a request that does not run: what was done then has been undone.
  void Forget(const RequestKey& key);

 private:
  struct Entry {
    std::uint64_t fingerprint = 0;
    bool running = true;
    std::deque<Waiter> waiters = {};  // while running
    KeptAnswer answer = {};
    SteadyTime answered = {};
    std::list<RequestKey>::iterator place = {};  // in its shelf, unless running
  };
  // Answers of one caller to one method, the oldest first.
  struct Shelf {
    std::list<RequestKey> keys;
    std::int64_t bytes = 0;
  };
  using Shelves = std::map<std::pair<std::string, std::string>, Shelf>;

  void Keep(const RequestKey& key, Entry& entry, KeptAnswer answer)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Erase(const RequestKey& key) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void DropOld() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // The next that waits, or null; then the request is forgotten.
  Waiter NextInLine(const RequestKey& key) ABSL_LOCKS_EXCLUDED(mutex_);

  const RequestMemoryOptions options_;

  absl::Mutex mutex_;
  std::map<RequestKey, Entry> entries_ ABSL_GUARDED_BY(mutex_);
  Shelves shelves_ ABSL_GUARDED_BY(mutex_);  // with an answer at least
  std::size_t answers_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t bytes_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace plumescout::server
