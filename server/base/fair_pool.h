// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "core/types/stop.h"
#include "server/base/pool_load.h"

namespace plumescout::server {

struct FairPoolOptions {
  std::string name;  // for errors: "planning"
  int threads = 2;
  int max_queued = 64;            // in all
  int max_queued_per_group = 32;  // of these
  int max_queued_per_member = 4;  // of these
  int max_running_per_group = 1;
};

// For whom a task is: groups take turns, and within each its members do.
struct FairKey {
  std::string group;
  std::string member;
};

struct FairTask {
  std::function<void()> run;
  // Nobody wants it any more: it may be left out, and gives way when places are short. Must not
  // block.
  StopFn abandoned = NeverStop();
};

// Fixed threads over bounded queues, so that whoever asks much waits for itself: a group never has
// more than its share of the threads, a member never more than one, and one task at a time has its
// turn. Thread-safe.
class FairPool {
 public:
  explicit FairPool(const FairPoolOptions& options);
  // Runs what is queued, then joins.
  ~FairPool();
  FairPool(const FairPool&) = delete;
  FairPool& operator=(const FairPool&) = delete;

  // OVERLOADED, with a time to retry, if one of the three queues is full.
  absl::Status Submit(const FairKey& key, FairTask task);

  int queued() const;
  PoolLoad load() const;

 private:
  struct Member {
    std::deque<FairTask> tasks;
    bool running = false;

    bool MayRun() const { return !tasks.empty() && !running; }
    bool IsIdle() const { return tasks.empty() && !running; }
  };
  struct Group {
    std::map<std::string, Member> members;  // those who wait or run
    std::string last_member;                // who had the latest turn
    int queued = 0;
    int running = 0;
  };
  using Groups = std::map<std::string, Group>;

  void Run();
  bool MayRun(const Group& group) const;
  bool Ready() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status CheckRoom(const FairKey& key) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // What nobody wants any more, taken out of the queues.
  std::vector<FairTask> TakeAbandoned() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Whose turn it is; end() if nobody may run.
  Groups::iterator NextGroup() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // REQUIRES: the group may run. Its member is `last_member` then.
  FairTask TakeTask(Group& group) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void NoteEnd(const FairKey& key) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void EraseIfIdle(Groups::iterator group) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const FairPoolOptions options_;

  mutable absl::Mutex mutex_;
  Groups groups_ ABSL_GUARDED_BY(mutex_);  // those who wait or run
  std::string last_group_ ABSL_GUARDED_BY(mutex_);
  int queued_ ABSL_GUARDED_BY(mutex_) = 0;
  int busy_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t refused_ ABSL_GUARDED_BY(mutex_) = 0;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;

  std::vector<std::thread> threads_;
};

}  // namespace plumescout::server
