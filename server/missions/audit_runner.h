// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/field_audit.h"
#include "server/base/worker_pool.h"

namespace plumescout::server {

// Has the gas fields of one mission audited on a pool, one round at a time and one field after the
// other. Nobody waits for them: a round that the pool has no room for is passed over.
// Single-threaded.
class AuditRunner {
 public:
  // `pool` is not owned and outlives the last Start; null: nothing is audited.
  explicit AuditRunner(WorkerPool* pool) : pool_(pool) {}
  // `told`, on the pool, whenever Take has something more to give; it must not block, and is not
  // called once the destructor has returned. Of rounds that start after this.
  void OnFinding(std::function<void()> told) { on_finding_ = std::move(told); }
  // An audit that runs is left to its end, those that wait never run.
  ~AuditRunner();
  AuditRunner(const AuditRunner&) = delete;
  AuditRunner& operator=(const AuditRunner&) = delete;

  // Whether Start would start a round: there is a pool, and no audit whose finding was not taken.
  bool is_free() const { return pool_ != nullptr && task_ == nullptr; }
  // No effect unless is_free().
  // `inputs`: of each field, not null.
  void Start(std::vector<std::shared_ptr<const AuditInputs>> inputs);
  // What the next audit of the round found, once it has ended; only once.
  std::optional<absl::StatusOr<AuditFinding>> Take();

 private:
  class Task;

  WorkerPool* const pool_;
  std::function<void()> on_finding_;  // may be empty
  std::shared_ptr<Task> task_;        // null: none
  std::size_t to_be_taken_ = 0;       // of its findings
};

}  // namespace plumescout::server
