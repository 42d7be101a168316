// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "server/base/clock.h"
#include "server/base/fair_pool.h"
#include "server/history/past_missions.h"
#include "server/missions/end_listeners.h"
#include "server/missions/mission_host.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// Where tasks wait for a thread, and as whose. The pool is not owned.
struct PoolTurn {
  FairPool* pool = nullptr;
  FairKey key = {};
};

// Replays the journal of a mission, in short tasks on a pool, and notes its figures now and then,
// evenly over the events. It works while somebody asks, and goes on where it was. Thread-safe;
// nothing blocks.
class FigureReplay : public std::enable_shared_from_this<FigureReplay> {
 public:
  // Who has not asked for so long has left.
  static constexpr absl::Duration kPatience = absl::Seconds(10);

  // `missions` is not owned; it outlives what runs.
  FigureReplay(const std::shared_ptr<MissionHost>& host, PastMissions* missions,
               SteadyClock clock = SteadyNow);

  // What there is; sees to it that more comes if the mission has moved on. OVERLOADED if nothing
  // can begin. What kept the last attempt from its end, as PastMissions::Make, is told once; who
  // asks again then has it tried again.
  absl::StatusOr<v1::GetMissionFiguresResponse> Ask(const PoolTurn& turn)
      ABSL_LOCKS_EXCLUDED(mutex_);

 private:
  enum class Progress { kMore, kDone };

  // On the pool, one after the other, while running_.
  void Step(const PoolTurn& turn);
  absl::StatusOr<Progress> Advance(MissionHost& host);
  absl::Status Begin(MissionHost& host);
  absl::Status ApplyNext(const JournalRecord& record);
  void NoteFigures(const MissionId& mission) ABSL_LOCKS_EXCLUDED(mutex_);
  // The journal was replayed to where it ended when that began.
  void NoteEnd() ABSL_LOCKS_EXCLUDED(mutex_);
  // Lets go of what a mission takes.
  void Rest(const absl::Status& status) ABSL_LOCKS_EXCLUDED(mutex_);

  bool IsBehind(std::int64_t head) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status Queue(const PoolTurn& turn);
  // Nobody waits for it any more.
  bool IsAbandoned() const;

  const std::weak_ptr<MissionHost> host_;
  PastMissions& missions_;
  const SteadyClock clock_;
  std::atomic<SteadyTime> asked_;    // the last time
  std::atomic<bool> ended_ = false;  // the mission, or the server

  // Touched by the tasks only.
  PastMission past_;
  std::unique_ptr<JournalReader> journal_;
  EndListeners::Id end_listener_ = 0;
  std::int64_t begin_ns_ = 0;  // sample time of the first sample; 0: none yet
  std::int64_t due_ = 0;       // the next revision to take figures of

  absl::Mutex mutex_;
  bool running_ ABSL_GUARDED_BY(mutex_) = false;
  SteadyTime began_ ABSL_GUARDED_BY(mutex_);          // to run, the last time
  SteadyTime rests_until_ ABSL_GUARDED_BY(mutex_);    // after a replay to the end
  absl::Status failure_ ABSL_GUARDED_BY(mutex_);      // of the last attempt, not told yet
  std::int64_t reached_ ABSL_GUARDED_BY(mutex_) = 0;  // the last event that was replayed
  std::int64_t stride_ ABSL_GUARDED_BY(mutex_) = 0;   // events between figures; 0: not chosen
  std::vector<v1::MissionFigures> figures_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
