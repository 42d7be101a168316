// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "absl/status/statusor.h"
#include "core/gas/field_audit.h"
#include "server/base/worker_pool.h"

namespace plumescout::server {

// Has the gas posterior of one mission audited on a pool, one audit at a time. Nobody waits for
// them: an audit that the pool has no room for is passed over. Single-threaded.
class AuditRunner {
 public:
  // `pool` is not owned and outlives the last Start; null: nothing is audited.
  explicit AuditRunner(WorkerPool* pool) : pool_(pool) {}
  // An audit that runs is left to its end, one that waits never runs.
  ~AuditRunner();
  AuditRunner(const AuditRunner&) = delete;
  AuditRunner& operator=(const AuditRunner&) = delete;

  // Whether Start would start one: there is a pool, and no audit whose finding was not taken.
  bool is_free() const { return pool_ != nullptr && task_ == nullptr; }
  // No effect unless is_free().
  void Start(std::shared_ptr<const AuditInputs> inputs);
  // What the audit found, once it has ended; only once.
  std::optional<absl::StatusOr<AuditFinding>> Take();

 private:
  class Task;

  WorkerPool* const pool_;
  std::shared_ptr<Task> task_;  // null: none
};

}  // namespace plumescout::server
