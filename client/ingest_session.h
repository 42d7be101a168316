// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "client/backoff.h"
#include "client/log_keeper.h"
#include "client/log_store.h"
#include "client/planner_client.h"
#include "client/robot_log.h"

namespace plumescout::client {

struct IngestOptions {
  RobotLogOptions log;
  LogStoreOptions store;  // its folder is opened by who makes the session
  BackoffOptions backoff;
  std::size_t max_batch_observations = 64;
  std::size_t max_batch_bytes = std::size_t{1} << 17;  // the stream cuts it as the server likes
  // While acknowledgements are due, new observations wait at most this long for the stream.
  absl::Duration read_slice = absl::Milliseconds(5);
  absl::Duration idle_check = absl::Milliseconds(200);  // how often a quiet stream is looked at
  absl::Duration ack_timeout = absl::Seconds(10);       // no word for so long: the link is dead
  // A lease that is not in force although nobody is known to have taken it, as after a server was
  // set back: how long another may hold it meanwhile. More than servers hold leases of the dead.
  absl::Duration lease_patience = absl::Seconds(15);
  std::function<std::int64_t()> robot_clock_ns = nullptr;  // see RobotSession
};

// Called on the session's own thread; they must not call back into the session.
struct IngestCallbacks {
  // The server does not know the robot (any more): create the mission if need be and register.
  std::function<absl::StatusOr<RobotSession>()> rejoin;
  std::function<void(const ObservationRejected&)> on_rejected = nullptr;  // may be empty
  // OK when a stream has opened, otherwise why it ended. May be empty.
  std::function<void(const absl::Status&)> on_link = nullptr;
  // Registers without taking over a lease that another holds: for a robot whose lease is not in
  // force when it comes back. Empty: then the session has ended.
  std::function<absl::StatusOr<RobotSession>()> reclaim = nullptr;
  // The server was set back and holds the log up to this number only; so many of those that follow
  // were durable once and are forgotten here too. May be empty.
  std::function<void(std::int64_t applied_sequence, std::int64_t forgotten)> on_rolled_back =
      nullptr;
  // Why the log on disk cannot be written when that begins; OK once it can again. May be empty.
  std::function<void(const absl::Status&)> on_disk = nullptr;  // on a thread of its own
};

struct IngestStatistics {
  std::int64_t last_sequence = 0;     // appended up to here
  std::int64_t applied_sequence = 0;  // as last acknowledged
  std::int64_t durable_sequence = 0;  // likewise; 0 from a server that keeps nothing on disk
  std::int64_t sent = 0;              // observations written to a stream, repetitions included
  std::int64_t rejected = 0;          // refused by the server; they count as applied
  std::int64_t lost = 0;              // dropped from a full log before any server had applied them
  std::int64_t reconnects = 0;
  std::int64_t server_restarts = 0;
  std::int64_t rollbacks = 0;  // times that a server had been set back to older data
  std::int64_t forgotten = 0;  // durable once, asked for again by such a server, and gone here
  bool link_up = false;
};

// Brings a robot's log to the server and keeps it there, whatever the link does. Appending never
// waits: a thread of the session's own moves the data within the server's credit, reopens a broken
// stream with growing waits, resumes where the server says, and tells a server that restarted, or
// was set back, everything again that it lacks. Another thread writes the log to disk, if there is
// a store for it. Thread-safe.
class IngestSession {
 public:
  // Starts the threads. `client` must outlive the session. `opened`: the log to go on with, and
  // where to keep it; `session` was registered with its epoch.
  IngestSession(PlannerClient& client, RobotSession session, IngestCallbacks callbacks,
                const IngestOptions& options, OpenedLog opened = {});
  // Ends the stream; what is not acknowledged by now is not waited for. The log is on disk then.
  ~IngestSession();
  IngestSession(const IngestSession&) = delete;
  IngestSession& operator=(const IngestSession&) = delete;

  // Numbers an observation and leaves it to the session. Returns its number.
  std::int64_t Append(std::int64_t sample_time_ns, const Pose2& pose, ObservationPayload payload);

  // Waits until the server has applied the log up to `sequence`. kDeadlineExceeded if it has not in
  // time; kFailedPrecondition once the session has ended for good: another client has the lease
  // (LEASE_SUPERSEDED), or the server's log of this robot is longer than ours.
  absl::Status WaitApplied(std::int64_t sequence, absl::Duration timeout);

  // As WaitApplied, and if the server keeps anything on disk, until that is safe there: the log is
  // not needed any more.
  absl::Status WaitSafe(std::int64_t sequence, absl::Duration timeout);

  // The standing to plan with; a rejoin changes it.
  RobotSession session() const;
  IngestStatistics statistics() const;
  // OK while the session lives; why it ended for good otherwise.
  absl::Status health() const;

 private:
  // Positions on one stream.
  struct Cursor {
    std::int64_t next = 1;     // to send
    std::int64_t applied = 0;  // acknowledged
    std::int64_t durable = 0;  // 0 if the server keeps nothing
    std::int64_t credit = 0;
    absl::Time last_word;  // from the server
  };

  void Run();
  absl::Status ServeOneStream();
  absl::Status Pump(ObservationStream& stream);
  absl::StatusOr<bool> Send(ObservationStream& stream, Cursor& cursor);
  absl::Status Receive(ObservationStream& stream, absl::Duration timeout, Cursor& cursor);
  void Digest(const IngestReply& reply, Cursor& cursor);
  absl::Status NoteOpened(const ObservationStream& stream);
  void NoteEnded(const absl::Status& status);
  void NoteState(const IngestState& state);
  absl::Status Recover(const absl::Status& ended);
  absl::Status Rejoin();
  absl::Status Reclaim(const absl::Status& superseded);
  void GoBack(const absl::Status& rolled_back);
  void TakeStanding(RobotSession joined) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void NoteBoot(const std::string& boot_id) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  LogNews FeedKeeper(std::int64_t next_sequence, absl::Duration timeout);
  void WaitForWork(const Cursor& cursor);
  void WaitBeforeRetry(const absl::Status& status);
  bool stopping() const;

  PlannerClient& client_;
  const IngestCallbacks callbacks_;
  const IngestOptions options_;
  // Of the thread alone.
  Backoff backoff_;
  bool stream_opened_ = false;                // the stream that was last tried
  std::optional<absl::Time> homeless_since_;  // first refused by its lease

  mutable absl::Mutex mutex_;
  RobotSession session_ ABSL_GUARDED_BY(mutex_);
  RobotLog log_ ABSL_GUARDED_BY(mutex_);
  IngestStatistics statistics_ ABSL_GUARDED_BY(mutex_);
  absl::Status health_ ABSL_GUARDED_BY(mutex_);
  std::int64_t sent_sequence_ ABSL_GUARDED_BY(mutex_) = 0;         // of this log, ever
  std::int64_t durable_sequence_ ABSL_GUARDED_BY(mutex_) = 0;      // as any server told of this log
  std::vector<Renumbering> renumberings_ ABSL_GUARDED_BY(mutex_);  // the keeper has to hear of
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;

  std::unique_ptr<LogKeeper> keeper_;  // null: the log is in memory alone
  std::thread thread_;                 // last: it uses everything above
};

}  // namespace plumescout::client
