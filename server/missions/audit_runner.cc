// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/audit_runner.h"

#include <deque>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::server {

class AuditRunner::Task {
 public:
  Task(std::vector<std::shared_ptr<const AuditInputs>> inputs, std::function<void()> on_finding)
      : inputs_(std::move(inputs)), on_finding_(std::move(on_finding)) {}

  void Run() {
    for (const std::shared_ptr<const AuditInputs>& inputs : inputs_) {
      {
        absl::MutexLock lock(&mutex_);
        if (dropped_) return;
      }
      absl::StatusOr<AuditFinding> finding = RunAudit(*inputs);
      absl::MutexLock lock(&mutex_);
      findings_.push_back(std::move(finding));
      if (!dropped_ && on_finding_) on_finding_();
    }
  }
  void Drop() {
    absl::MutexLock lock(&mutex_);
    dropped_ = true;
  }
  std::optional<absl::StatusOr<AuditFinding>> Take() {
    absl::MutexLock lock(&mutex_);
    if (findings_.empty()) return std::nullopt;
    absl::StatusOr<AuditFinding> finding = std::move(findings_.front());
    findings_.pop_front();
    return finding;
  }

 private:
  const std::vector<std::shared_ptr<const AuditInputs>> inputs_;
  const std::function<void()> on_finding_;

  absl::Mutex mutex_;
  bool dropped_ ABSL_GUARDED_BY(mutex_) = false;
  std::deque<absl::StatusOr<AuditFinding>> findings_ ABSL_GUARDED_BY(mutex_);  // not taken yet
};

AuditRunner::~AuditRunner() {
  if (task_ != nullptr) task_->Drop();
}

void AuditRunner::Start(std::vector<std::shared_ptr<const AuditInputs>> inputs) {
  if (!is_free() || inputs.empty()) return;
  const std::size_t count = inputs.size();
  auto task = std::make_shared<Task>(std::move(inputs), on_finding_);
  if (!pool_->Submit([task] { task->Run(); }).ok()) return;
  task_ = std::move(task);
  to_be_taken_ = count;
}

std::optional<absl::StatusOr<AuditFinding>> AuditRunner::Take() {
  if (task_ == nullptr) return std::nullopt;
  std::optional<absl::StatusOr<AuditFinding>> finding = task_->Take();
  if (finding && --to_be_taken_ == 0) task_ = nullptr;
  return finding;
}

}  // namespace plumescout::server
