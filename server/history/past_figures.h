// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "server/history/figure_replay.h"
#include "server/history/past_missions.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

// How figures of missions came about, for however many ask: what was found is kept, of the missions
// that were asked for last. Thread-safe; nothing blocks.
class PastFigures {
 public:
  explicit PastFigures(PastMissions* missions) : missions_(*missions) {}

  // As FigureReplay::Ask.
  absl::StatusOr<v1::GetMissionFiguresResponse> Ask(const std::shared_ptr<MissionHost>& host,
                                                    const PoolTurn& turn)
      ABSL_LOCKS_EXCLUDED(mutex_);

 private:
  struct Kept {
    std::weak_ptr<MissionHost> host;  // another mission may get its name
    std::shared_ptr<FigureReplay> replay;
  };

  std::shared_ptr<FigureReplay> Find(const std::shared_ptr<MissionHost>& host)
      ABSL_LOCKS_EXCLUDED(mutex_);

  PastMissions& missions_;

  absl::Mutex mutex_;
  std::deque<Kept> kept_ ABSL_GUARDED_BY(mutex_);  // the newest last
};

}  // namespace plumescout::server
