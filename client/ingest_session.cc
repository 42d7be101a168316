// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ingest_session.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

// What the keeper of the log takes in one go.
constexpr ReadLimits kKeeperLimits = {.through_sequence = std::numeric_limits<std::int64_t>::max(),
                                      .max_observations = 64,
                                      .max_bytes = std::size_t{1} << 20};

constexpr absl::string_view kForeignLog = "FOREIGN_LOG";

bool IsFinal(const absl::Status& status) {
  return ErrorReason(status) == kLeaseSuperseded || ErrorReason(status) == kForeignLog;
}

}  // namespace

IngestSession::IngestSession(PlannerClient& client, RobotSession session, IngestCallbacks callbacks,
                             const IngestOptions& options, OpenedLog opened)
    : client_(client),
      callbacks_(std::move(callbacks)),
      options_(options),
      backoff_(options.backoff),
      log_(options.log) {
  const std::int64_t next_sequence = opened.log.last_sequence + 1;
  {
    absl::MutexLock lock(&mutex_);
    // Whatever an earlier process of this log wrote down, it may have sent.
    sent_sequence_ = std::max(opened.log.last_sequence,
                              opened.log.last_sequence > 0 ? session.ingest.applied_sequence : 0);
    durable_sequence_ = opened.log.durable_sequence;
    log_.Restore(std::move(opened.log));
    session_.server_boot_id = session.server_boot_id;
    TakeStanding(std::move(session));
  }
  if (opened.store != nullptr) {
    keeper_ = std::make_unique<LogKeeper>(
        std::move(opened.store), next_sequence,
        LogKeeping{options.store.sync_period, options.store.retry_period},
        [this](std::int64_t next, absl::Duration timeout) { return FeedKeeper(next, timeout); },
        callbacks_.on_disk);
  }
  thread_ = std::thread([this] { Run(); });
}

IngestSession::~IngestSession() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
  keeper_.reset();
}

std::int64_t IngestSession::Append(std::int64_t sample_time_ns, const Pose2& pose,
                                   ObservationPayload payload) {
  absl::MutexLock lock(&mutex_);
  return log_.Append(sample_time_ns, pose, std::move(payload));
}

absl::Status IngestSession::WaitApplied(std::int64_t sequence, absl::Duration timeout) {
  absl::MutexLock lock(&mutex_);
  const auto settled = [this, sequence]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return log_.applied_sequence() >= sequence || !health_.ok();
  };
  mutex_.AwaitWithTimeout(absl::Condition(&settled), timeout);
  if (log_.applied_sequence() >= sequence) return absl::OkStatus();
  if (!health_.ok()) return health_;
  return absl::DeadlineExceededError(absl::StrCat(
      "observation ", sequence, " is not applied yet: the server holds ", log_.applied_sequence()));
}

absl::Status IngestSession::WaitSafe(std::int64_t sequence, absl::Duration timeout) {
  const absl::Time deadline = absl::Now() + timeout;
  PLUMESCOUT_RETURN_IF_ERROR(WaitApplied(sequence, timeout));
  absl::MutexLock lock(&mutex_);
  const auto settled = [this, sequence]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return durable_sequence_ == 0 || log_.durable_sequence() >= sequence || !health_.ok();
  };
  const bool in_time = mutex_.AwaitWithDeadline(absl::Condition(&settled), deadline);
  if (durable_sequence_ == 0 || log_.durable_sequence() >= sequence) return absl::OkStatus();
  if (in_time) return health_;
  return absl::DeadlineExceededError(absl::StrCat("observation ", sequence,
                                                  " is not durable yet: the server's disk holds ",
                                                  log_.durable_sequence()));
}

RobotSession IngestSession::session() const {
  absl::MutexLock lock(&mutex_);
  return session_;
}

IngestStatistics IngestSession::statistics() const {
  absl::MutexLock lock(&mutex_);
  IngestStatistics statistics = statistics_;
  statistics.last_sequence = log_.last_sequence();
  statistics.applied_sequence = log_.applied_sequence();
  statistics.durable_sequence = log_.durable_sequence();
  statistics.lost = log_.lost_observations();
  return statistics;
}

absl::Status IngestSession::health() const {
  absl::MutexLock lock(&mutex_);
  return health_;
}

void IngestSession::Run() {
  while (!stopping()) {
    absl::Status status = ServeOneStream();
    if (stopping()) return;
    NoteEnded(status);
    status = Recover(status);
    if (IsFinal(status) || (stream_opened_ && absl::IsNotFound(status))) {
      absl::MutexLock lock(&mutex_);
      health_ = status;
      return;
    }
    if (!status.ok()) WaitBeforeRetry(status);
  }
}

// Does what can be done about the end of a stream. Whatever is left may pass by itself: a server
// that is down, recovers or has no room on its disk is tried for ever.
absl::Status IngestSession::Recover(const absl::Status& ended) {
  // A server that restarts breaks the link. One that ends an open stream so was told to, by whoever
  // removed the robot or deleted the mission: it stays away.
  if (absl::IsNotFound(ended)) return stream_opened_ ? ended : Rejoin();
  if (ErrorReason(ended) == kStoreRolledBack) GoBack(ended);
  if (ErrorReason(ended) == kLeaseSuperseded) return Reclaim(ended);
  return ended;
}

// Returns OK only when the session is stopping.
absl::Status IngestSession::ServeOneStream() {
  RobotSession standing = session();
  {
    absl::MutexLock lock(&mutex_);
    standing.durable_sequence = durable_sequence_;
  }
  standing.robot_clock_ns = options_.robot_clock_ns;
  stream_opened_ = false;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::unique_ptr<ObservationStream> stream,
                              client_.OpenObservationStream(standing));
  PLUMESCOUT_RETURN_IF_ERROR(NoteOpened(*stream));
  PLUMESCOUT_RETURN_IF_ERROR(Pump(*stream));
  return stream->Finish();
}

absl::Status IngestSession::Pump(ObservationStream& stream) {
  Cursor cursor{.next = stream.opened().applied_sequence + 1,
                .applied = stream.opened().applied_sequence,
                .durable = stream.opened().durable_sequence,
                .credit = stream.opened().credit_sequence,
                .last_word = absl::Now()};
  while (!stopping()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool sent, Send(stream, cursor));
    const bool acks_due = cursor.applied + 1 < cursor.next;
    const bool disk_lags = cursor.durable > 0 && cursor.durable < cursor.applied;
    const bool word_due = acks_due || disk_lags || cursor.credit < cursor.next;
    if (!sent && !word_due) WaitForWork(cursor);
    PLUMESCOUT_RETURN_IF_ERROR(
        Receive(stream, !sent && word_due ? options_.read_slice : absl::ZeroDuration(), cursor));
    if (!acks_due) cursor.last_word = absl::Now();
    if (absl::Now() - cursor.last_word > options_.ack_timeout) {
      return absl::UnavailableError(
          absl::StrCat("no word from the server for ", absl::FormatDuration(options_.ack_timeout)));
    }
  }
  return absl::OkStatus();
}

// Writes one batch, if the log has anything to send within the credit.
absl::StatusOr<bool> IngestSession::Send(ObservationStream& stream, Cursor& cursor) {
  std::vector<Observation> batch;
  {
    absl::MutexLock lock(&mutex_);
    batch = log_.Read(cursor.next, {.through_sequence = cursor.credit,
                                    .max_observations = options_.max_batch_observations,
                                    .max_bytes = options_.max_batch_bytes});
    statistics_.sent += static_cast<std::int64_t>(batch.size());
    if (!batch.empty()) sent_sequence_ = std::max(sent_sequence_, LastSequence(batch.back()));
  }
  if (batch.empty()) return false;
  PLUMESCOUT_RETURN_IF_ERROR(stream.Write(batch));
  cursor.next = LastSequence(batch.back()) + 1;
  return true;
}

// Takes in every reply that is there, waiting up to `timeout` for the first.
absl::Status IngestSession::Receive(ObservationStream& stream, absl::Duration timeout,
                                    Cursor& cursor) {
  while (true) {
    const absl::StatusOr<IngestReply> reply = stream.Read(timeout);
    if (absl::IsDeadlineExceeded(reply.status())) return absl::OkStatus();
    PLUMESCOUT_RETURN_IF_ERROR(reply.status());
    Digest(*reply, cursor);
    timeout = absl::ZeroDuration();
  }
}

void IngestSession::Digest(const IngestReply& reply, Cursor& cursor) {
  cursor.last_word = absl::Now();
  if (const auto* rejected = std::get_if<ObservationRejected>(&reply)) {
    {
      absl::MutexLock lock(&mutex_);
      ++statistics_.rejected;
    }
    if (callbacks_.on_rejected) callbacks_.on_rejected(*rejected);
    return;
  }
  const auto& state = std::get<IngestState>(reply);
  cursor.applied = std::max(cursor.applied, state.applied_sequence);
  cursor.durable = state.durable_sequence;
  cursor.credit = std::max(cursor.credit, state.credit_sequence);
  backoff_.Reset();
  NoteState(state);
}

absl::Status IngestSession::NoteOpened(const ObservationStream& stream) {
  const IngestState& opened = stream.opened();
  {
    absl::MutexLock lock(&mutex_);
    if (opened.applied_sequence > log_.last_sequence()) {
      return absl::FailedPreconditionError(
          absl::StrCat(kForeignLog, ": the server holds ", opened.applied_sequence,
                       " observations of this robot, its own log only ", log_.last_sequence()));
    }
    statistics_.link_up = true;
    NoteBoot(stream.server_boot_id());
  }
  stream_opened_ = true;
  homeless_since_.reset();
  NoteState(opened);
  if (callbacks_.on_link) callbacks_.on_link(absl::OkStatus());
  return absl::OkStatus();
}

void IngestSession::NoteState(const IngestState& state) {
  absl::MutexLock lock(&mutex_);
  log_.Acknowledge(state.applied_sequence, state.durable_sequence);
  durable_sequence_ = std::max(durable_sequence_, state.durable_sequence);
}

void IngestSession::NoteEnded(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    statistics_.link_up = false;
    ++statistics_.reconnects;
  }
  if (callbacks_.on_link) callbacks_.on_link(status);
}

absl::Status IngestSession::Rejoin() {
  PLUMESCOUT_ASSIGN_OR_RETURN(RobotSession joined, callbacks_.rejoin());
  absl::MutexLock lock(&mutex_);
  TakeStanding(std::move(joined));
  return absl::OkStatus();
}

// A lease that is lost while its stream is open was taken by another client. One that is not in
// force at the opening may have been forgotten, by a server that was set back.
absl::Status IngestSession::Reclaim(const absl::Status& superseded) {
  if (stream_opened_ || !callbacks_.reclaim) return superseded;
  if (!homeless_since_.has_value()) homeless_since_ = absl::Now();
  absl::StatusOr<RobotSession> joined = callbacks_.reclaim();
  if (joined.ok()) {
    absl::MutexLock lock(&mutex_);
    TakeStanding(*std::move(joined));
    return absl::OkStatus();
  }
  const bool taken = ErrorReason(joined.status()) == kLeaseHeld &&
                     absl::Now() - *homeless_since_ > options_.lease_patience;
  return taken ? superseded : joined.status();
}

void IngestSession::GoBack(const absl::Status& rolled_back) {
  const std::int64_t applied_sequence = RolledBackTo(rolled_back);
  std::int64_t forgotten = 0;
  {
    absl::MutexLock lock(&mutex_);
    forgotten = std::max<std::int64_t>(log_.first_held_sequence() - applied_sequence - 1, 0);
    ++statistics_.rollbacks;
    statistics_.forgotten += forgotten;
    durable_sequence_ = applied_sequence;
    log_.Acknowledge(applied_sequence, std::min(log_.durable_sequence(), applied_sequence));
  }
  if (callbacks_.on_rolled_back) callbacks_.on_rolled_back(applied_sequence, forgotten);
}

// Numbers beyond what was ever sent are another log's, whatever the server says of a registration
// of which it may have given the first answer in vain.
void IngestSession::TakeStanding(RobotSession joined) {
  NoteBoot(joined.server_boot_id);
  session_ = std::move(joined);
  const std::int64_t applied_sequence = session_.ingest.applied_sequence;
  if (!session_.log_continues || applied_sequence > sent_sequence_) {
    renumberings_.push_back(log_.RebaseAfter(applied_sequence));
    sent_sequence_ = applied_sequence;
    durable_sequence_ = 0;
  } else {
    log_.SkipTo(applied_sequence);
    log_.Acknowledge(applied_sequence, session_.ingest.durable_sequence);
  }
}

void IngestSession::NoteBoot(const std::string& boot_id) {
  if (boot_id != session_.server_boot_id) ++statistics_.server_restarts;
  session_.server_boot_id = boot_id;
}

LogNews IngestSession::FeedKeeper(std::int64_t next_sequence, absl::Duration timeout) {
  absl::MutexLock lock(&mutex_);
  const auto news = [this, next_sequence]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return stopping_ || log_.last_sequence() >= next_sequence || !renumberings_.empty();
  };
  mutex_.AwaitWithTimeout(absl::Condition(&news), timeout);
  LogNews told{.renumberings = std::exchange(renumberings_, {}),
               .entries = {},
               .first_held_sequence = log_.first_held_sequence(),
               .mark = {log_.applied_sequence(), log_.durable_sequence()},
               .ended = stopping_};
  for (const Renumbering& renumbering : told.renumberings) {
    next_sequence = std::max(next_sequence, renumbering.from) + renumbering.to - renumbering.from;
  }
  told.entries = log_.Read(next_sequence, kKeeperLimits);
  return told;
}

void IngestSession::WaitForWork(const Cursor& cursor) {
  absl::MutexLock lock(&mutex_);
  const auto work = [this, &cursor]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return stopping_ || log_.last_sequence() >= cursor.next;
  };
  mutex_.AwaitWithTimeout(absl::Condition(&work), options_.idle_check);
}

void IngestSession::WaitBeforeRetry(const absl::Status& status) {
  const absl::Duration wait = std::max(backoff_.Next(), RetryDelayOf(status));
  absl::MutexLock lock(&mutex_);
  mutex_.AwaitWithTimeout(absl::Condition(&stopping_), wait);
}

bool IngestSession::stopping() const {
  absl::MutexLock lock(&mutex_);
  return stopping_;
}

}  // namespace plumescout::client
