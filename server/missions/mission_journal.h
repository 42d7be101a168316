// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "core/types/event.h"
#include "core/types/ids.h"
#include "server/base/clock.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// Where the journal of a mission is, and who writes it.
struct JournalHome {
  MissionStore* store = nullptr;  // not owned, outlives the journal; null: nothing is kept
  std::string key = {};
  std::int64_t epoch = 0;
  std::int64_t head = 0;  // what the store has of the mission already
  // Of all missions; beyond it nothing more is taken.
  std::int64_t max_backlog_bytes = std::int64_t{64} << 20;
};

// Keeps a mission in a store while it runs: its writer adds events and hands them over in batches,
// and whoever owes an answer hears when what it tells of is durable. Of a mission that no store
// keeps, everything is as durable as it will be at once. Owned by a shared_ptr; thread-safe, but
// for Add and the flushes, which are the writer's.
class MissionJournal : public std::enable_shared_from_this<MissionJournal> {
 public:
  // Must not block. On any thread.
  using Callback = std::function<void(const absl::Status&)>;

  explicit MissionJournal(JournalHome home = {});
  MissionJournal(const MissionJournal&) = delete;
  MissionJournal& operator=(const MissionJournal&) = delete;

  // Whether anything outlives the process.
  bool is_durable() const { return is_durable_; }

  // The mission's next event. It leaves with one of the flushes, or when many have come. Returns
  // how many bytes it takes.
  std::int64_t Add(const Event& event);
  // Hands over what was added: always; or unless the store still works on the last batch, so that
  // batches grow while it is slow.
  void Flush();
  void FlushIfIdle();

  // Replaces what is kept beside the events. Callers take turns.
  void PutStanding(std::string standing);

  // Of a revision that is durable. `done` hears what becomes of it.
  void PutSnapshot(StoredSnapshot snapshot, Callback done);
  // Whether events go, from the next snapshot on, that no recovery needs any more.
  void set_trims(bool trims) { trims_ = trims; }

  std::int64_t durable_revision() const { return durable_revision_; }
  // How far a robot's log is durable that was applied up to `applied_sequence`; 0 if nothing is.
  std::int64_t DurableSequence(const RobotId& robot, std::int64_t applied_sequence) const;

  // `done` hears once events up to `revision`, and every PutStanding so far, are durable, perhaps
  // before this returns; an error if they will not be, or once somebody calls DropOverdue after
  // the deadline (STORE_UNAVAILABLE) or Close.
  void WhenDurable(std::int64_t revision, SteadyTime deadline, Callback done);
  SteadyTime next_deadline() const;
  void DropOverdue(SteadyTime now);

  // STORE_UNAVAILABLE while the store cannot keep more; FENCED once another server has the mission.
  absl::Status CheckTakesMore() const;
  // Of this window, what the store's backlog leaves; at least 1.
  int WindowNow(int window) const;

  // Called once nothing more will be durable, with FENCED or what else went wrong for good.
  void WhenLost(Callback lost);
  // Nobody waits any more: who does hears this status. What was added still goes to the store.
  void Close(const absl::Status& status);
  // False if something that was flushed is not durable by then, and may still become so.
  bool AwaitStored(SteadyTime deadline);
  // Whether all that was handed over is durable, or never will be.
  bool is_stored() const {
    absl::MutexLock lock(&mutex_);
    return IsStored();
  }
  // Whether another server that shares the store has the mission now.
  bool is_lost() const {
    absl::MutexLock lock(&mutex_);
    return !lost_.ok();
  }
  // Whether what is not durable may become so, for all who wait to hear of.
  bool is_open() const {
    absl::MutexLock lock(&mutex_);
    return lost_.ok() && closed_.ok();
  }
  std::int64_t epoch() const { return home_.epoch; }
  const std::string& key() const { return home_.key; }
  // The store forgets the mission. `done` may hear after long.
  void Remove(Callback done);

 private:
  // Of a robot's log: observations up to `sequence` are durable once event `number` is.
  struct Mark {
    std::int64_t number = 0;
    RobotId robot;
    std::int64_t sequence = 0;
  };
  struct LogEnd {
    std::int64_t durable_sequence = 0;
    int marks = 0;  // that are not durable
  };
  struct Waiter {
    std::int64_t revision = 0;
    std::int64_t standing = 0;
    SteadyTime deadline;
    Callback done;
  };

  void NoteObservation(std::int64_t number, const ObservationReceived& received)
      ABSL_LOCKS_EXCLUDED(mutex_);
  void EventsStored(std::int64_t last, const absl::Status& status) ABSL_LOCKS_EXCLUDED(mutex_);
  void StandingStored(std::int64_t standing, const absl::Status& status)
      ABSL_LOCKS_EXCLUDED(mutex_);
  void Settle(const absl::Status& status) ABSL_LOCKS_EXCLUDED(mutex_);
  void PassMarks(std::int64_t last) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool IsKept(std::int64_t revision, std::int64_t standing) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return revision <= durable_revision_ && standing <= durable_standing_;
  }
  bool IsStored() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return in_flight_ == 0; }
  std::vector<Waiter> TakeWaiters(const std::function<bool(const Waiter&)>& wanted)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const JournalHome home_;
  const bool is_durable_;
  std::atomic<std::int64_t> durable_revision_;
  std::atomic<bool> trims_ = false;
  std::atomic<int> events_in_flight_ = 0;  // batches

  // Of the writer.
  std::vector<std::string> records_;  // not handed over
  std::int64_t flushed_revision_;

  mutable absl::Mutex mutex_;
  int in_flight_ ABSL_GUARDED_BY(mutex_) = 0;  // batches and standings
  std::int64_t last_standing_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t durable_standing_ ABSL_GUARDED_BY(mutex_) = 0;
  std::deque<Mark> marks_ ABSL_GUARDED_BY(mutex_);  // in order of number
  std::map<RobotId, LogEnd> logs_ ABSL_GUARDED_BY(mutex_);
  std::vector<Waiter> waiters_ ABSL_GUARDED_BY(mutex_);
  absl::Status lost_ ABSL_GUARDED_BY(mutex_);
  absl::Status closed_ ABSL_GUARDED_BY(mutex_);
  Callback when_lost_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
