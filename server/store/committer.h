// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <thread>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/base/clock.h"
#include "server/base/stop_signal.h"
#include "server/store/mission_store.h"
#include "server/store/store_write.h"

namespace plumescout::server {

struct CommitterOptions {
  int max_batch_records = 1000;
  std::int64_t max_batch_bytes = 8 << 20;
  absl::Duration retry_period = absl::Milliseconds(200);
  absl::Duration slow_commit = absl::Seconds(1);  // who takes longer is warned of
  // Hears what an operator should know. On the committer's thread; must not block.
  std::function<void(absl::string_view)> warn = [](absl::string_view) {};
};

// One thread that writes what all missions have ready: whatever gathers while one commit runs goes
// into the next. A batch that the disk refuses is tried again until it works; nothing overtakes it
// meanwhile. Callbacks run on the thread, without locks. Thread-safe.
class Committer {
 public:
  // `engine` outlives the committer.
  Committer(const CommitterOptions& options, WriteEngine* engine);
  // Ends the commit that runs; what else waits hears kCancelled. Not from a callback.
  ~Committer();
  Committer(const Committer&) = delete;
  Committer& operator=(const Committer&) = delete;

  void Submit(StoreWrite write);
  // Not from a callback.
  absl::Status SubmitAndWait(StoreWrite write);

  StoreState state() const;

 private:
  using Batch = std::vector<StoreWrite>;

  void Run();
  // False: the committer goes down. An empty batch is a probe or a chore.
  bool Take(Batch& batch);
  void TakeQueued(Batch& batch) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool Ready() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return !queue_.empty() || stopping_; }
  void CommitBatch(Batch batch);
  absl::Status Commit(Batch& batch);
  void NoteCommit(const absl::Status& status, absl::Duration took, bool is_empty);
  // Answers those of the batch and of the queue that are not tried again.
  void AnswerImpatient(const absl::Status& status, Batch& batch);
  // False: the committer goes down.
  bool AwaitRetry();
  void Answer(Batch& batch);
  void Answer(Batch& batch, const absl::Status& status);

  const CommitterOptions options_;
  WriteEngine* const engine_;

  mutable absl::Mutex mutex_;
  std::deque<StoreWrite> queue_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  StoreState state_ ABSL_GUARDED_BY(mutex_);

  // Of the thread.
  bool chore_is_next_ = false;
  SteadyTime no_warning_before_ = SteadyTime::min();  // of slow commits

  StopSignal stop_;
  std::thread thread_;  // last: it uses the others
};

}  // namespace plumescout::server
