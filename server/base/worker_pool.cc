// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/worker_pool.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "server/base/errors.h"
#include "server/base/thread_priority.h"

namespace plumescout::server {

WorkerPool::WorkerPool(const WorkerPoolOptions& options) : options_(options) {
  for (int i = 0; i < options_.threads; ++i) threads_.emplace_back([this] { Run(); });
}

WorkerPool::~WorkerPool() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  for (std::thread& thread : threads_) thread.join();
}

absl::Status WorkerPool::Submit(std::function<void()> task) {
  absl::MutexLock lock(&mutex_);
  if (tasks_.size() >= static_cast<std::size_t>(options_.max_queued)) {
    ++refused_;
    return Overloaded(absl::StrCat("the ", options_.name, " queue is full"));
  }
  tasks_.push_back(std::move(task));
  return absl::OkStatus();
}

PoolLoad WorkerPool::load() const {
  absl::MutexLock lock(&mutex_);
  return {options_.name,       options_.threads, busy_, static_cast<int>(tasks_.size()),
          options_.max_queued, refused_};
}

void WorkerPool::Run() {
  if (options_.yields) YieldCpuToOthers();
  while (true) {
    std::function<void()> task;
    {
      absl::MutexLock lock(&mutex_);
      mutex_.Await(absl::Condition(this, &WorkerPool::Ready));
      if (tasks_.empty()) return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
      ++busy_;
    }
    task();
    task = nullptr;
    absl::MutexLock lock(&mutex_);
    --busy_;
  }
}

}  // namespace plumescout::server
