// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "core/types/ids.h"
#include "core/types/plan.h"

namespace plumescout::server {

// What each robot of a mission was told last, with everything it was chosen from, for people who
// ask why. It is no part of the mission: after a restart it begins empty. Thread-safe.
class LatestPlans {
 public:
  using PlanPtr = std::shared_ptr<const Plan>;
  // Of more robots than this, those whose plans are oldest are forgotten.
  static constexpr std::size_t kMaxRobots = 256;

  // The plan was committed and has its number.
  void Note(Plan plan) ABSL_LOCKS_EXCLUDED(mutex_);
  // The robot was removed. Nothing if it has no plan here.
  void Forget(const RobotId& robot) ABSL_LOCKS_EXCLUDED(mutex_);
  // By robot.
  std::vector<PlanPtr> All() const ABSL_LOCKS_EXCLUDED(mutex_);

 private:
  struct Entry {
    PlanPtr plan;
    std::int64_t noted = 0;  // counts up
  };

  mutable absl::Mutex mutex_;
  std::map<RobotId, Entry> entries_ ABSL_GUARDED_BY(mutex_);
  std::int64_t count_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace plumescout::server
