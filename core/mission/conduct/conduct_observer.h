// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "core/mission/mission.h"
#include "core/types/event.h"

namespace plumescout {

// What a mission's gas posterior needs now and then: EpochAdopted, PosteriorRefreshed, EpochBegun.
enum class GasStep { kAdoptEpoch, kRefresh, kBeginEpoch };

// Hears what the conduct of a mission does, while it does it. Whoever keeps a journal, has epochs
// recomputed beside the mission or takes times, does it from here; none of it changes an event.
class ConductObserver {
 public:
  virtual ~ConductObserver() = default;

  // Every event in the order of their numbers, once it is applied, and before the command that it
  // comes of has returned.
  virtual void OnEvent(const Event& event, const Applied& applied) = 0;

  // Each step is told before its event, and again after it, or after it came to no event. Before
  // kAdoptEpoch nobody else may touch the mission's epoch any more; after a kBeginEpoch that is OK
  // somebody may recompute it, on any thread.
  virtual void BeforeGasStep(GasStep) {}
  virtual void AfterGasStep(GasStep, const absl::Status&) {}

  // The same of the map when it is rebuilt: before a MapRebuilt nobody else may touch the mission's
  // rebuild any more; after a MapRebuildBegun somebody may recompute it, on any thread.
  virtual void BeforeMapRebuilt() {}
  virtual void AfterMapRebuildBegun() {}
};

}  // namespace plumescout
