// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/committer.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kBetweenWarnings = absl::Minutes(1);

absl::Duration Since(SteadyTime begin) { return absl::FromChrono(SteadyNow() - begin); }

// Takes those that `leaves` out of `from`, in order.
template <typename Writes, typename Predicate>
void MoveOut(Writes& from, std::vector<StoreWrite>& to, const Predicate& leaves) {
  const auto kept = std::stable_partition(from.begin(), from.end(),
                                          [&](const StoreWrite& write) { return !leaves(write); });
  std::move(kept, from.end(), std::back_inserter(to));
  from.erase(kept, from.end());
}

// Takes back what the disk may have taken although it gave an error.
StoreWrite UndoOf(const StoreWrite& create) {
  StoreWrite undo;
  undo.kind = StoreWrite::Kind::kUndoCreate;
  undo.key = create.key;
  undo.bytes = create.bytes;
  undo.tried = true;
  return undo;
}

}  // namespace

Committer::Committer(const CommitterOptions& options, WriteEngine* engine)
    : options_(options), engine_(engine), thread_([this] { Run(); }) {}

Committer::~Committer() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  stop_.Stop();
  thread_.join();
}

void Committer::Submit(StoreWrite write) {
  absl::MutexLock lock(&mutex_);
  state_.backlog_bytes += write.payload_bytes();
  state_.backlog_records += static_cast<std::int64_t>(write.records.size());
  queue_.push_back(std::move(write));
}

absl::Status Committer::SubmitAndWait(StoreWrite write) {
  absl::Status answer;
  absl::Notification answered;
  write.done = [&](const absl::Status& status) {
    answer = status;
    answered.Notify();
  };
  Submit(std::move(write));
  answered.WaitForNotification();
  return answer;
}

StoreState Committer::state() const {
  absl::MutexLock lock(&mutex_);
  return state_;
}

void Committer::Run() {
  for (Batch batch; Take(batch); batch.clear()) {
    CommitBatch(std::move(batch));
    engine_->Tidy();
  }
  Batch rest;
  {
    absl::MutexLock lock(&mutex_);
    MoveOut(queue_, rest, [](const StoreWrite&) { return true; });
  }
  Answer(rest, absl::CancelledError("the store is closed"));
}

bool Committer::Take(Batch& batch) {
  const bool has_chores = engine_->has_chores();
  const bool has_trouble = !state().status.ok();
  if (has_trouble && !AwaitRetry()) return false;
  absl::MutexLock lock(&mutex_);
  if (!has_trouble && !has_chores) mutex_.Await(absl::Condition(this, &Committer::Ready));
  if (stopping_) return false;
  // Chores take turns with batches.
  if (!has_chores || !chore_is_next_) TakeQueued(batch);
  chore_is_next_ = has_chores && !batch.empty();
  return true;
}

void Committer::TakeQueued(Batch& batch) {
  std::int64_t bytes = 0;
  std::int64_t records = 0;
  while (!queue_.empty()) {
    const StoreWrite& next = queue_.front();
    bytes += next.payload_bytes();
    records += static_cast<std::int64_t>(next.records.size());
    const bool has_room =
        bytes <= options_.max_batch_bytes && records <= options_.max_batch_records;
    // A snapshot is large, and its failure must not be that of others.
    const bool is_snapshot = next.kind == StoreWrite::Kind::kSnapshot;
    if (!batch.empty() && (!has_room || is_snapshot)) return;
    batch.push_back(std::move(queue_.front()));
    queue_.pop_front();
    if (is_snapshot) return;
  }
}

void Committer::CommitBatch(Batch batch) {
  while (true) {
    const absl::Status status = Commit(batch);
    if (status.ok()) return Answer(batch);
    if (!absl::IsUnavailable(status)) {
      if (batch.size() <= 1) return Answer(batch, status);
      // Who is to blame shows when each has a commit of its own.
      for (StoreWrite& write : batch) {
        Batch alone;
        write.tried = true;  // an engine may have written some of them
        alone.push_back(std::move(write));
        CommitBatch(std::move(alone));
      }
      return;
    }
    AnswerImpatient(status, batch);
    if (batch.empty()) return;
    for (StoreWrite& write : batch) write.tried = true;
    if (!AwaitRetry()) return Answer(batch, absl::CancelledError("the store is closed"));
  }
}

absl::Status Committer::Commit(Batch& batch) {
  const SteadyTime begin = SteadyNow();
  const absl::Status status = engine_->Commit(std::span<StoreWrite>(batch));
  NoteCommit(status, Since(begin), batch.empty());
  return status;
}

void Committer::NoteCommit(const absl::Status& status, absl::Duration took, bool is_empty) {
  const bool is_refused = absl::IsUnavailable(status);
  absl::Status before;
  bool is_slow = false;
  {
    absl::MutexLock lock(&mutex_);
    // Damage is an answer to whom it concerns; the disk works.
    before = std::exchange(state_.status, is_refused ? status : absl::OkStatus());
    if (status.ok() && !is_empty) {
      is_slow = took > options_.slow_commit;
      ++state_.commits;
      state_.slow_commits += is_slow ? 1 : 0;
      state_.last_commit = took;
    }
  }
  if (!status.ok() && (before.ok() || !is_refused)) options_.warn(status.message());
  if (!before.ok() && status.ok()) options_.warn("the store works again");
  if (is_slow && SteadyNow() >= no_warning_before_) {
    no_warning_before_ = After(SteadyNow(), kBetweenWarnings);
    options_.warn(absl::StrCat("a commit took ", absl::FormatDuration(took), ", more than ",
                               absl::FormatDuration(options_.slow_commit)));
  }
}

void Committer::AnswerImpatient(const absl::Status& status, Batch& batch) {
  const auto is_impatient = [](const StoreWrite& write) { return write.is_impatient(); };
  Batch undone;
  for (StoreWrite& write : batch) {
    const bool may_stand = write.kind == StoreWrite::Kind::kCreate && write.inserted;
    if (may_stand) undone.push_back(UndoOf(write));
  }
  Batch answered;
  MoveOut(batch, answered, is_impatient);
  {
    absl::MutexLock lock(&mutex_);
    MoveOut(queue_, answered, is_impatient);
    for (const StoreWrite& undo : undone) state_.backlog_bytes += undo.payload_bytes();
  }
  std::move(undone.begin(), undone.end(), std::back_inserter(batch));
  Answer(answered, status);
}

bool Committer::AwaitRetry() { return !stop_.AwaitStop(After(SteadyNow(), options_.retry_period)); }

void Committer::Answer(Batch& batch) {
  {
    absl::MutexLock lock(&mutex_);
    for (const StoreWrite& write : batch) {
      state_.backlog_bytes -= write.payload_bytes();
      state_.backlog_records -= static_cast<std::int64_t>(write.records.size());
    }
  }
  for (const StoreWrite& write : batch) {
    if (write.done) write.done(write.result);
  }
}

void Committer::Answer(Batch& batch, const absl::Status& status) {
  for (StoreWrite& write : batch) write.result = status;
  Answer(batch);
}

}  // namespace plumescout::server
