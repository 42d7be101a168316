// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

#include "absl/time/time.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "server/base/worker_pool.h"
#include "server/missions/mission_journal.h"

namespace plumescout::server {

// What there is to replay, should the mission be recovered now.
struct JournalTail {
  std::int64_t snapshot_bytes = 0;  // of the newest snapshot; 0: there is none
  std::int64_t bytes = 0;           // of the events since then
  std::int64_t last_epoch = 0;      // revision at which an epoch was adopted last
};

// CPU time of the calling thread.
using ThreadClock = std::function<absl::Duration()>;
absl::Duration ThreadCpuNow();

// A snapshot needs an epoch that is adopted, and without one for so many events one is begun (see
// EpochHabit): to replay that many takes about two seconds. Of events, not of time or bytes, so
// that a mission that goes on after a crash has the same events as one that was left in peace.
inline constexpr std::int64_t kEventsPerEpoch = 8'000;

// Less than this is read before anybody notices who wakes a mission.
inline constexpr std::int64_t kLeastTail_bytes = 256 * 1024;

// Has snapshots of a mission taken, when an epoch is adopted and the events since the last one have
// grown larger than that, or would take long to replay. The writer makes the bytes; a pool packs
// them, and the journal keeps them once their events are durable. Single-threaded.
class SnapshotTaker {
 public:
  // The pool is not owned and outlives the last call.
  SnapshotTaker(std::shared_ptr<MissionJournal> journal, WorkerPool* pool,
                const JournalTail& tail = {}, ThreadClock clock = ThreadCpuNow);

  // The event was applied to the mission, and is so many bytes in the journal.
  void NoteEvent(const Event& event, std::int64_t bytes, const Mission& mission);
  // Whether more than this has come since the last snapshot. Then the next epoch that is adopted
  // has one taken.
  bool WantOne(std::int64_t least_tail_bytes);
  // A snapshot is being packed or stored. From any thread.
  bool is_busy() const { return on_its_way_->busy; }

 private:
  bool IsDue(const Event& event, const Mission& mission);
  void Take(const Mission& mission);

  // What outlives us while a snapshot is on its way.
  struct OnItsWay {
    std::atomic<bool> busy = false;
    std::atomic<std::int64_t> bytes = 0;  // of the last snapshot
  };

  const std::shared_ptr<MissionJournal> journal_;
  WorkerPool* const pool_;
  const ThreadClock clock_;
  const std::shared_ptr<OnItsWay> on_its_way_ = std::make_shared<OnItsWay>();
  std::int64_t tail_bytes_;
  bool is_wanted_ = false;
  absl::Duration tail_from_ = absl::InfiniteDuration();  // CPU time when the tail began
};

}  // namespace plumescout::server
