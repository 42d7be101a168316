// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/epoch_runner.h"

#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "server/base/clock.h"

namespace plumescout::server {

// One epoch, recomputed by whoever claims it first.
class EpochRunner::Task {
 public:
  Task(std::shared_ptr<GasEpoch> epoch, MissionMetrics* metrics)
      : epoch_(std::move(epoch)), metrics_(metrics) {}

  // Recomputes, unless somebody else does.
  void Run() {
    if (!Claim()) return;
    const SteadyTime from = SteadyNow();
    epoch_->Recompute();
    metrics_->NoteEpoch(absl::FromChrono(SteadyNow() - from));
    absl::MutexLock lock(&mutex_);
    done_ = true;
  }
  void Await() {
    absl::MutexLock lock(&mutex_);
    mutex_.Await(absl::Condition(&done_));
  }
  // Whether the caller is the first: then nobody else touches the epoch.
  bool Claim() {
    absl::MutexLock lock(&mutex_);
    return !std::exchange(claimed_, true);
  }

 private:
  const std::shared_ptr<GasEpoch> epoch_;  // what it points to is the claimant's until done_
  MissionMetrics* const metrics_;

  absl::Mutex mutex_;
  bool claimed_ ABSL_GUARDED_BY(mutex_) = false;
  bool done_ ABSL_GUARDED_BY(mutex_) = false;
};

EpochRunner::~EpochRunner() { Drop(); }

void EpochRunner::Drop() {
  if (task_ != nullptr) task_->Claim();
}

void EpochRunner::Start(std::shared_ptr<GasEpoch> epoch) {
  Drop();
  task_ = std::make_shared<Task>(std::move(epoch), metrics_);
  if (pool_ == nullptr) return;
  // Refused: it waits for Finish.
  pool_->Submit([task = task_] { task->Run(); }).IgnoreError();
}

void EpochRunner::Finish() {
  if (task_ == nullptr) return;
  task_->Run();
  task_->Await();
  task_ = nullptr;
}

}  // namespace plumescout::server
