// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ingest_session.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

bool MustRejoin(const absl::Status& status) {
  return absl::IsNotFound(status) || ErrorReason(status) == kServerRestarted;
}

constexpr absl::string_view kForeignLog = "FOREIGN_LOG";

bool IsFinal(const absl::Status& status) {
  return ErrorReason(status) == kLeaseSuperseded || ErrorReason(status) == kForeignLog;
}

}  // namespace

IngestSession::IngestSession(PlannerClient& client, RobotSession session, IngestCallbacks callbacks,
                             const IngestOptions& options)
    : client_(client),
      callbacks_(std::move(callbacks)),
      options_(options),
      backoff_(options.backoff),
      session_(std::move(session)),
      log_(options.log, session_.ingest.applied_sequence),
      thread_([this] { Run(); }) {}

IngestSession::~IngestSession() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

std::int64_t IngestSession::Append(std::int64_t sample_time_ns, const Pose2& pose,
                                   std::variant<Scan, GasReading> payload) {
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

RobotSession IngestSession::session() const {
  absl::MutexLock lock(&mutex_);
  return session_;
}

IngestStatistics IngestSession::statistics() const {
  absl::MutexLock lock(&mutex_);
  IngestStatistics statistics = statistics_;
  statistics.last_sequence = log_.last_sequence();
  statistics.applied_sequence = log_.applied_sequence();
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
    if (MustRejoin(status)) status = Rejoin();
    if (IsFinal(status)) {
      absl::MutexLock lock(&mutex_);
      health_ = status;
      return;
    }
    if (!status.ok()) WaitBeforeRetry();
  }
}

// Returns OK only when the session is stopping.
absl::Status IngestSession::ServeOneStream() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::unique_ptr<ObservationStream> stream,
                              client_.OpenObservationStream(session()));
  PLUMESCOUT_RETURN_IF_ERROR(NoteOpened(stream->opened()));
  PLUMESCOUT_RETURN_IF_ERROR(Pump(*stream));
  return stream->Finish();
}

absl::Status IngestSession::Pump(ObservationStream& stream) {
  Cursor cursor{.next = stream.opened().applied_sequence + 1,
                .applied = stream.opened().applied_sequence,
                .credit = stream.opened().credit_sequence,
                .last_word = absl::Now()};
  while (!stopping()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool sent, Send(stream, cursor));
    const bool acks_due = cursor.applied + 1 < cursor.next;
    const bool word_due = acks_due || cursor.credit < cursor.next;
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
  cursor.credit = std::max(cursor.credit, state.credit_sequence);
  backoff_.Reset();
  NoteState(state);
}

absl::Status IngestSession::NoteOpened(const IngestState& opened) {
  {
    absl::MutexLock lock(&mutex_);
    if (opened.applied_sequence > log_.last_sequence()) {
      return absl::FailedPreconditionError(
          absl::StrCat(kForeignLog, ": the server holds ", opened.applied_sequence,
                       " observations of this robot, its own log only ", log_.last_sequence()));
    }
    statistics_.link_up = true;
  }
  NoteState(opened);
  if (callbacks_.on_link) callbacks_.on_link(absl::OkStatus());
  return absl::OkStatus();
}

void IngestSession::NoteState(const IngestState& state) {
  absl::MutexLock lock(&mutex_);
  log_.Acknowledge(state.applied_sequence, state.durable_sequence);
  statistics_.durable_sequence = state.durable_sequence;
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
  if (joined.server_boot_id != session_.server_boot_id) ++statistics_.server_restarts;
  session_ = std::move(joined);
  return absl::OkStatus();
}

void IngestSession::WaitForWork(const Cursor& cursor) {
  absl::MutexLock lock(&mutex_);
  const auto work = [this, &cursor]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return stopping_ || log_.last_sequence() >= cursor.next;
  };
  mutex_.AwaitWithTimeout(absl::Condition(&work), options_.idle_check);
}

void IngestSession::WaitBeforeRetry() {
  absl::MutexLock lock(&mutex_);
  mutex_.AwaitWithTimeout(absl::Condition(&stopping_), backoff_.Next());
}

bool IngestSession::stopping() const {
  absl::MutexLock lock(&mutex_);
  return stopping_;
}

}  // namespace plumescout::client
