// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/task_pool.h"

#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::lab {
namespace {

class TaskPool {
 public:
  TaskPool(std::size_t count, const std::function<absl::Status(std::size_t)>& task,
           const std::function<void(double)>& progress)
      : count_(count), task_(task), progress_(progress) {}

  // On as many threads as may work at once.
  void Work() {
    while (true) {
      mutex_.Lock();
      const std::size_t mine = next_;
      const bool over = mine >= count_ || !status_.ok();
      if (!over) ++next_;
      mutex_.Unlock();
      if (over) return;
      absl::Status status = task_(mine);
      absl::MutexLock lock(&mutex_);
      Note(mine, std::move(status));
    }
  }

  absl::Status status() {
    absl::MutexLock lock(&mutex_);
    return status_;
  }

 private:
  void Note(std::size_t task, absl::Status status) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    ++done_;
    if (!status.ok() && (status_.ok() || task < failed_)) {
      failed_ = task;
      status_ = std::move(status);
    }
    if (progress_) progress_(static_cast<double>(done_) / static_cast<double>(count_));
  }

  const std::size_t count_;
  const std::function<absl::Status(std::size_t)>& task_;
  const std::function<void(double)>& progress_;
  absl::Mutex mutex_;
  std::size_t next_ ABSL_GUARDED_BY(mutex_) = 0;
  std::size_t done_ ABSL_GUARDED_BY(mutex_) = 0;
  std::size_t failed_ ABSL_GUARDED_BY(mutex_) = 0;
  absl::Status status_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace

absl::Status RunTasks(std::size_t count, int jobs,
                      const std::function<absl::Status(std::size_t)>& task,
                      const std::function<void(double)>& progress) {
  TaskPool pool(count, task, progress);
  const std::size_t helpers = std::min(count, static_cast<std::size_t>(std::max(1, jobs)));
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < helpers; ++i) threads.emplace_back([&pool] { pool.Work(); });
  pool.Work();
  for (std::thread& thread : threads) thread.join();
  return pool.status();
}

}  // namespace plumescout::lab
