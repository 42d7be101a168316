// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "core/mission/conduct/lease_book.h"
#include "core/types/ids.h"
#include "server/base/clock.h"

namespace plumescout::server {

// A mission's LeaseBook by the server's clock, for the mission's writer and for the threads of
// calls and streams alike; it tells streams when they have ended. Thread-safe.
class LeaseTable final : public Leases {
 public:
  // Ends a stream from outside; must not block.
  using EndStream = std::function<void(const absl::Status&)>;

  // `first_token`: as LeaseBook.
  LeaseTable(absl::Duration hold, std::int64_t first_token, SteadyClock clock);

  absl::StatusOr<std::int64_t> Propose(const RobotId& robot, bool take_over) override;
  void Grant(const RobotId& robot, std::int64_t token) override;
  // Its stream ends with ROBOT_NOT_FOUND.
  void Remove(const RobotId& robot) override;

  // Gives up the lease of this token, or whoever's it is; see LeaseBook::Release. Its stream ends
  // with LEASE_SUPERSEDED.
  absl::Status Release(const RobotId& robot, std::optional<std::int64_t> token);
  LeaseStanding Standing(const RobotId& robot) const;
  // As LeaseBook; infinite until its stream closes.
  absl::Duration TimeLeft(const RobotId& robot) const;
  // As LeaseBook.
  std::map<RobotId, std::int64_t> Released() const;

  // As LeaseBook.
  absl::Status Check(const RobotId& robot, std::int64_t token) const;
  // LEASE_SUPERSEDED if the lease of this token was released, or is not the newest any more: what
  // was under way then comes too late.
  absl::Status CheckNotReleased(const RobotId& robot, std::int64_t token) const;
  // Counts as a use. ROBOT_NOT_FOUND; LEASE_SUPERSEDED unless `token` is the newest.
  absl::Status Use(const RobotId& robot, std::int64_t token);

  // As Use; a stream that is open on the same token is ended in favour of this one.
  absl::StatusOr<StreamId> OpenStream(const RobotId& robot, std::int64_t token, EndStream end);
  // No effect if the stream has ended already.
  void CloseStream(const RobotId& robot, StreamId stream);

  // Ends every stream, when the mission goes.
  void EndAll(const absl::Status& status);

  int robot_count() const;

 private:
  EndStream TakeEnd(StreamId stream) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const SteadyClock clock_;

  mutable absl::Mutex mutex_;
  LeaseBook book_ ABSL_GUARDED_BY(mutex_);
  std::map<StreamId, EndStream> ends_ ABSL_GUARDED_BY(mutex_);  // of the open streams
};

}  // namespace plumescout::server
