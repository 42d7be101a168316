// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "server/base/worker_pool.h"
#include "server/history/mission_import.h"
#include "server/missions/mission_registry.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// Takes imports in, a few at a time; one after the other they are worked on, on a thread of their
// own, for a mission may take as long to make as it took to drive. Thread-safe.
class ImportDesk {
 public:
  // Neither store nor registry is owned; both outlive the imports.
  ImportDesk(MissionStore* store, MissionRegistry* registry, const ImportLimits& limits);

  // OVERLOADED if there are too many; kUnavailable if the server has no room on its disk. The desk
  // outlives the import.
  absl::StatusOr<std::unique_ptr<MissionImport>> Open();
  // Where their work is done.
  WorkerPool& pool() { return pool_; }

 private:
  MissionStore& store_;
  MissionRegistry& registry_;
  const ImportLimits limits_;

  absl::Mutex mutex_;
  int open_ ABSL_GUARDED_BY(mutex_) = 0;

  WorkerPool pool_;
};

}  // namespace plumescout::server
