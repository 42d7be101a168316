// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/types/ids.h"

namespace plumescout {

using StreamId = std::int64_t;  // of one mission; 0: none

// Tokens stay below this, so that clients whose numbers are doubles hold them exactly.
inline constexpr std::int64_t kLeaseTokenEnd = std::int64_t{1} << 53;

// The first token of a server's life. Random bits set it far from those of other lives, and it is
// below half of kLeaseTokenEnd: there is room to count up for ever.
std::int64_t FirstLeaseToken(std::uint64_t random_bits);

// How a robot's lease stands.
struct LeaseStanding {
  bool held = false;
  bool streaming = false;  // a stream is open on it

  friend bool operator==(const LeaseStanding&, const LeaseStanding&) = default;
};

// What the conduct of a mission needs of its robots' leases.
class Leases {
 public:
  virtual ~Leases() = default;

  // A token for a newer lease, not in force yet. LEASE_HELD unless the old one ran out or
  // `take_over`.
  virtual absl::StatusOr<std::int64_t> Propose(const RobotId& robot, bool take_over) = 0;
  // Puts a proposed token in force, once the mission has registered the robot under it. The stream
  // of the old one has ended.
  virtual void Grant(const RobotId& robot, std::int64_t token) = 0;
  // The robot has left: no token of its is in force, its stream has ended. No effect if there is
  // none.
  virtual void Remove(const RobotId& robot) = 0;
};

// Who may write each robot's log. A lease is held while its ingest stream is open and for a time
// after its last use; then, or when told to, another client takes it over with a newer token, and
// the older one is fenced off for ever. Times come from one clock that never goes back.
//
// Invariants: 1. tokens of a robot only grow. 2. a robot has at most one open stream, and it is of
// its newest token. Thread-compatible.
class LeaseBook {
 public:
  struct OpenedStream {
    StreamId stream = 0;
    StreamId replaced = 0;  // ended in favour of it
  };

  // `first_token` > 0 should differ between starts of a server, so that a token of an earlier life
  // is not mistaken for one of this.
  LeaseBook(std::int64_t hold_ns, std::int64_t first_token)
      : hold_ns_(hold_ns), next_token_(first_token) {}

  // As Leases, at `now_ns`. A proposal that is not granted leaves no trace.
  absl::StatusOr<std::int64_t> Propose(const RobotId& robot, bool take_over,
                                       std::int64_t now_ns) const;
  // Returns the stream that it ended. REQUIRES: the token is newer than the robot's last.
  StreamId Grant(const RobotId& robot, std::int64_t token, std::int64_t now_ns);
  // As Leases. Returns the stream that it ended.
  StreamId Remove(const RobotId& robot);

  // Gives up a lease: nothing is written under its token any more, and anybody may take a newer one
  // at once. No token: whichever is the newest. ROBOT_NOT_FOUND, LEASE_SUPERSEDED. Returns the
  // stream that it ended.
  absl::StatusOr<StreamId> Release(const RobotId& robot, std::optional<std::int64_t> token);

  // Of a robot that is not there: not held.
  LeaseStanding Standing(const RobotId& robot, std::int64_t now_ns) const;

  // How long the lease is held if nobody uses it: 0 if it is not; none: until its stream closes.
  std::optional<std::int64_t> TimeLeft_ns(const RobotId& robot, std::int64_t now_ns) const;

  // ROBOT_NOT_FOUND; LEASE_SUPERSEDED unless `token` is the newest, and was not given up.
  absl::Status Check(const RobotId& robot, std::int64_t token) const;
  // As Check, and counts as a use.
  absl::Status Use(const RobotId& robot, std::int64_t token, std::int64_t now_ns);

  // As Use; a stream that is open on the same token has ended.
  absl::StatusOr<OpenedStream> OpenStream(const RobotId& robot, std::int64_t token,
                                          std::int64_t now_ns);
  // As Check; STREAM_REPLACED unless `stream` is the robot's open one.
  absl::Status CheckStream(const RobotId& robot, std::int64_t token, StreamId stream) const;
  // No effect if the stream has ended already.
  void CloseStream(const RobotId& robot, StreamId stream, std::int64_t now_ns);
  void CloseAllStreams();

  // Tokens that were given up and not replaced by newer ones.
  std::map<RobotId, std::int64_t> Released() const;

  int robot_count() const { return static_cast<int>(leases_.size()); }

 private:
  struct Lease {
    std::int64_t token = 0;
    std::int64_t last_use_ns = 0;
    StreamId stream = 0;
    bool released = false;
  };

  const std::int64_t hold_ns_;
  std::int64_t next_token_;
  StreamId last_stream_ = 0;
  std::map<RobotId, Lease> leases_;
};

// A book as it stands at one instant.
class LeasesAt final : public Leases {
 public:
  // The book outlives this.
  LeasesAt(LeaseBook& book, std::int64_t now_ns) : book_(book), now_ns_(now_ns) {}

  absl::StatusOr<std::int64_t> Propose(const RobotId& robot, bool take_over) override {
    return book_.Propose(robot, take_over, now_ns_);
  }
  void Grant(const RobotId& robot, std::int64_t token) override {
    book_.Grant(robot, token, now_ns_);
  }
  void Remove(const RobotId& robot) override { book_.Remove(robot); }

 private:
  LeaseBook& book_;
  const std::int64_t now_ns_;
};

}  // namespace plumescout
