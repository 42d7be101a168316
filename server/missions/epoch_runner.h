// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/gas/gas_epoch.h"
#include "server/base/worker_pool.h"
#include "server/observe/mission_metrics.h"

namespace plumescout::server {

// Has the epochs of one mission recomputed on a pool. An epoch that the pool has no room for, or
// has not come to when it is needed, is computed by the caller of Finish: what is adopted when does
// not depend on the pool. Single-threaded.
class EpochRunner {
 public:
  // `pool` is not owned and outlives the last Start; null: callers of Finish compute.
  // `metrics` as well; they hear how long recomputations take.
  explicit EpochRunner(WorkerPool* pool, MissionMetrics* metrics = &MissionMetrics::Unread())
      : pool_(pool), metrics_(metrics) {}
  // An epoch that runs is left to its end, one that waits never runs.
  ~EpochRunner();
  EpochRunner(const EpochRunner&) = delete;
  EpochRunner& operator=(const EpochRunner&) = delete;

  // The epoch is not to be touched until Finish has returned. One that was started before and not
  // finished is no longer wanted: it is left as by the destructor.
  void Start(std::shared_ptr<GasEpoch> epoch);
  // Blocks until the epoch given to Start, if any, is recomputed. What was written to it is then
  // seen by the caller.
  void Finish();

 private:
  class Task;

  void Drop();

  WorkerPool* const pool_;
  MissionMetrics* const metrics_;
  std::shared_ptr<Task> task_;  // of the epoch started last; null if it is finished
};

}  // namespace plumescout::server
