// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "server/base/worker_pool.h"

namespace plumescout::server {

// One piece of work at a time, done on a pool while its owner goes on. What the pool has no room
// for, or has not come to when it is needed, is done by the caller of Finish: what comes of it does
// not depend on the pool. Single-threaded.
class SideWork {
 public:
  // `pool` is not owned and outlives the last Start; null: callers of Finish work.
  explicit SideWork(WorkerPool* pool) : pool_(pool) {}
  // Work that runs is left to its end, work that waits never runs.
  ~SideWork();
  SideWork(const SideWork&) = delete;
  SideWork& operator=(const SideWork&) = delete;

  // What the work touches is not to be touched until Finish has returned. Work that was started
  // before and not finished is no longer wanted: it is left as by the destructor.
  void Start(std::function<void()> work);
  // Blocks until the work given to Start, if any, is done. What it wrote is then seen by the
  // caller.
  void Finish();

 private:
  class Task;

  void Drop();

  WorkerPool* const pool_;
  std::shared_ptr<Task> task_;  // started last; null if it is finished
};

}  // namespace plumescout::server
