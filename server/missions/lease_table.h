// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "core/types/ids.h"
#include "server/base/clock.h"

namespace plumescout::server {

// Who may write each robot's log. A lease is held while its ingest stream is open and for
// `hold` after its last use; then, or when told to, another client takes it over with a newer
// token, and the older one is fenced off for ever. Thread-safe.
//
// Invariants: 1. tokens of a robot only grow. 2. a robot has at most one open stream, and it is of
// its newest token.
class LeaseTable {
 public:
  // Ends a stream from outside; must not block.
  using EndStream = std::function<void(const absl::Status&)>;

  // `first_token` should differ between starts of the server, so that a token of an earlier life
  // is not mistaken for one of this.
  LeaseTable(absl::Duration hold, std::int64_t first_token, SteadyClock clock);

  // A token for a newer lease, not in force yet. LEASE_HELD unless the old one ran out or
  // `take_over`.
  absl::StatusOr<std::int64_t> Propose(const RobotId& robot, bool take_over);
  // Puts a proposed token in force, once the mission has registered the robot under it. Ends the
  // stream of the old one.
  void Grant(const RobotId& robot, std::int64_t token);

  // The robot has left the mission: its token is in force no more, its stream ends with
  // ROBOT_NOT_FOUND. No effect if there is none.
  void Remove(const RobotId& robot);

  // Counts as a use. ROBOT_NOT_FOUND; LEASE_SUPERSEDED unless `token` is the newest.
  absl::Status Check(const RobotId& robot, std::int64_t token);

  // As Check; a stream that is open on the same token is ended in favour of this one. `stream`
  // identifies it.
  absl::Status OpenStream(const RobotId& robot, std::int64_t token, const void* stream,
                          EndStream end);
  // No effect if a newer stream has taken its place.
  void CloseStream(const RobotId& robot, const void* stream);

  // Ends every stream, when the mission goes.
  void EndAll(const absl::Status& status);

  int robot_count() const;

 private:
  struct Lease {
    std::int64_t token = 0;
    SteadyTime last_use;
    const void* stream = nullptr;
    EndStream end_stream;
  };

  absl::StatusOr<Lease*> Find(const RobotId& robot, std::int64_t token)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const absl::Duration hold_;
  const SteadyClock clock_;

  mutable absl::Mutex mutex_;
  std::int64_t next_token_ ABSL_GUARDED_BY(mutex_);
  std::map<RobotId, Lease> leases_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
