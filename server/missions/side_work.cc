// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/side_work.h"

#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::server {

// Done by whoever claims it first.
class SideWork::Task {
 public:
  explicit Task(std::function<void()> work) : work_(std::move(work)) {}

  // Does it, unless somebody else does.
  void Run() {
    if (!Claim()) return;
    work_();
    absl::MutexLock lock(&mutex_);
    done_ = true;
  }
  void Await() {
    absl::MutexLock lock(&mutex_);
    mutex_.Await(absl::Condition(&done_));
  }
  // Whether the caller is the first: then nobody else does it.
  bool Claim() {
    absl::MutexLock lock(&mutex_);
    return !std::exchange(claimed_, true);
  }

 private:
  const std::function<void()> work_;  // the claimant's until done_

  absl::Mutex mutex_;
  bool claimed_ ABSL_GUARDED_BY(mutex_) = false;
  bool done_ ABSL_GUARDED_BY(mutex_) = false;
};

SideWork::~SideWork() { Drop(); }

void SideWork::Drop() {
  if (task_ != nullptr) task_->Claim();
}

void SideWork::Start(std::function<void()> work) {
  Drop();
  task_ = std::make_shared<Task>(std::move(work));
  if (pool_ == nullptr) return;
  // Refused: it waits for Finish.
  pool_->Submit([task = task_] { task->Run(); }).IgnoreError();
}

void SideWork::Finish() {
  if (task_ == nullptr) return;
  task_->Run();
  task_->Await();
  task_ = nullptr;
}

}  // namespace plumescout::server
