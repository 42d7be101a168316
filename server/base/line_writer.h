// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"

namespace plumescout::server {

// What became of lines.
struct LineCounts {
  std::int64_t written = 0;
  std::int64_t dropped = 0;  // for want of room, or of somebody who reads
};

// Writes lines to a file descriptor on a thread of its own. Whoever has a line never waits for who
// reads it: a line that finds no room is dropped and counted, and once there is room again, a line
// says how many were. Thread-safe.
class LineWriter {
 public:
  // The line that says how many were dropped.
  using DropNotice = std::function<std::string(std::int64_t dropped)>;

  // `fd` is not owned; that it blocks does no harm.
  LineWriter(int fd, std::size_t max_queued_bytes, DropNotice drop_notice);
  // Writes what is queued, as far as that is possible at once.
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  // The line ends with '\n'.
  void Push(std::string line);
  // Waits until what was pushed is written or dropped, but no longer than this. False if it is not.
  bool Flush(absl::Duration patience);

  LineCounts counts() const;

 private:
  void Run();
  // Lines for one write; empty if there is nothing left to do. Sets `lines` to their number.
  std::string TakeChunk(int& lines);
  bool Write(const std::string& chunk);
  bool MayWrite();

  bool HasWork() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return !lines_.empty() || unreported_drops_ > 0 || stopping_;
  }
  bool IsIdle() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return lines_.empty() && unreported_drops_ == 0 && !writing_;
  }
  bool IsStopping() const {
    absl::MutexLock lock(&mutex_);
    return stopping_;
  }
  void ReportDrops() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const int fd_;
  const std::size_t max_queued_bytes_;
  const DropNotice drop_notice_;

  mutable absl::Mutex mutex_;
  std::deque<std::string> lines_ ABSL_GUARDED_BY(mutex_);
  std::size_t queued_bytes_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t unreported_drops_ ABSL_GUARDED_BY(mutex_) = 0;
  LineCounts counts_ ABSL_GUARDED_BY(mutex_);
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::server
