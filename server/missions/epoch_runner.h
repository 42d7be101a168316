// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/gas/gas_maps.h"
#include "server/base/worker_pool.h"
#include "server/missions/side_work.h"
#include "server/observe/mission_metrics.h"

namespace plumescout::server {

// Has the epochs of one mission recomputed on a pool, as SideWork. Single-threaded.
class EpochRunner {
 public:
  // `pool` as of SideWork; `metrics` is not owned either; they hear how long recomputations take.
  explicit EpochRunner(WorkerPool* pool, MissionMetrics* metrics = &MissionMetrics::Unread())
      : work_(pool), metrics_(metrics) {}

  // The epoch is not to be touched until Finish has returned.
  void Start(std::shared_ptr<GasEpochs> epoch);
  // Blocks until the epoch given to Start, if any, is recomputed.
  void Finish() { work_.Finish(); }

 private:
  SideWork work_;
  MissionMetrics* const metrics_;
};

}  // namespace plumescout::server
