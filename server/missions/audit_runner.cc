// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/audit_runner.h"

#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::server {

class AuditRunner::Task {
 public:
  explicit Task(std::shared_ptr<const AuditInputs> inputs) : inputs_(std::move(inputs)) {}

  void Run() {
    {
      absl::MutexLock lock(&mutex_);
      if (dropped_) return;
    }
    absl::StatusOr<AuditFinding> finding = RunAudit(*inputs_);
    absl::MutexLock lock(&mutex_);
    finding_ = std::move(finding);
  }
  void Drop() {
    absl::MutexLock lock(&mutex_);
    dropped_ = true;
  }
  std::optional<absl::StatusOr<AuditFinding>> finding() const {
    absl::MutexLock lock(&mutex_);
    return finding_;
  }

 private:
  const std::shared_ptr<const AuditInputs> inputs_;

  mutable absl::Mutex mutex_;
  bool dropped_ ABSL_GUARDED_BY(mutex_) = false;
  std::optional<absl::StatusOr<AuditFinding>> finding_ ABSL_GUARDED_BY(mutex_);
};

AuditRunner::~AuditRunner() {
  if (task_ != nullptr) task_->Drop();
}

void AuditRunner::Start(std::shared_ptr<const AuditInputs> inputs) {
  if (!is_free()) return;
  auto task = std::make_shared<Task>(std::move(inputs));
  if (pool_->Submit([task] { task->Run(); }).ok()) task_ = std::move(task);
}

std::optional<absl::StatusOr<AuditFinding>> AuditRunner::Take() {
  if (task_ == nullptr) return std::nullopt;
  std::optional<absl::StatusOr<AuditFinding>> finding = task_->finding();
  if (finding) task_ = nullptr;
  return finding;
}

}  // namespace plumescout::server
