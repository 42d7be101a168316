// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "core/types/stop.h"
#include "server/base/clock.h"
#include "server/base/pool_load.h"

namespace plumescout::server {

struct FairPoolOptions {
  std::string name;  // for errors: "planning"
  int threads = 2;
  int max_queued = 64;            // in all
  int max_queued_per_group = 32;  // of these
  int max_queued_per_member = 4;  // of these
  int max_running_per_group = 1;
  int max_running_per_member = 1;
  bool groups_leave_room = false;  // to one another, as tenants do
  bool yields = false;             // to all other threads, see YieldCpuToOthers
};

// For whom a task is: tenants take turns, within each its groups do, and within these their
// members.
struct FairKey {
  std::string group;
  std::string member;
  std::string tenant = {};
};

struct FairTask {
  std::function<void()> run;
  // Nobody wants it any more: it may be left out, and gives way when places are short. Must not
  // block.
  StopFn abandoned = NeverStop();
};

// Fixed threads over bounded queues, so that whoever asks much waits for itself: a group never has
// more than its share of the threads, a member neither, and one task at a time has its turn. A
// tenant that is alone may have everything; while others ask too it leaves them a thread and a
// quarter of the queue. Groups whose tasks take long leave two threads to those whose do not, as
// long as one is left to themselves. Thread-safe.
class FairPool {
 public:
  // Who asked within this is company.
  static constexpr absl::Duration kCompany = absl::Seconds(60);
  // A task that takes more than this takes long, and its group is known for it for so much time.
  static constexpr absl::Duration kLong = absl::Milliseconds(250);
  static constexpr absl::Duration kLongKnown = absl::Seconds(10);

  explicit FairPool(const FairPoolOptions& options, SteadyClock clock = SteadyNow);
  // Runs what is queued, then joins.
  ~FairPool();
  FairPool(const FairPool&) = delete;
  FairPool& operator=(const FairPool&) = delete;

  // OVERLOADED, with a time to retry, if one of the queues is full.
  absl::Status Submit(const FairKey& key, FairTask task);

  int queued() const;
  PoolLoad load() const;

 private:
  struct Member {
    std::deque<FairTask> tasks;
    int running = 0;

    bool IsIdle() const { return tasks.empty() && running == 0; }
  };
  // Of one tenant or group: those who wait or run below it, and who had the latest turn.
  template <typename Child>
  struct Party {
    std::map<std::string, Child> children;
    std::string last;
    int queued = 0;
    int running = 0;

    bool IsIdle() const { return queued == 0 && running == 0; }
  };
  using Group = Party<Member>;
  using Tenant = Party<Group>;
  // Of a group that asked lately.
  struct Pace {
    SteadyTime asked;
    SteadyTime long_at = {};  // when a task of it ended that took long, the last time
  };
  using GroupName = std::pair<std::string, std::string>;  // tenant and group
  // Who asked lately.
  class Company {
   public:
    void Note(const std::string& who, SteadyTime now);
    bool IsAlone(const std::string& who, SteadyTime now) const;

   private:
    std::string latest_;
    SteadyTime latest_at_;
    SteadyTime others_at_;  // the last time that anybody but `latest_` asked
  };

  // What is the same for all who wait, as they are looked through: found once, for it costs a look
  // at everybody's pace.
  struct Moment {
    SteadyTime now;
    bool holds_long = false;  // too few threads would be left if another took long
  };

  void Run();
  // Of how many threads whoever is `alone`, or not, may have.
  int Threads(bool alone) const;
  bool MayRun(const Member& member) const;
  bool MayRun(const GroupName& name, const Group& group, const Moment& moment) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  static bool TakesLong(const Pace& pace, SteadyTime now);
  bool TakesLong(const GroupName& name, SteadyTime now) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Tasks of groups that take long.
  int RunningLong(SteadyTime now) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  Moment Present() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void NoteAsked(const FairKey& key) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool MayRun(const std::string& name, const Tenant& tenant, const Moment& moment) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool Ready() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status CheckRoom(const FairKey& key) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Of those that may be queued in all when the key's task comes.
  int Places(const FairKey& key, const Tenant* tenant, const Group* group) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // What nobody wants any more, taken out of the queues.
  std::vector<FairTask> TakeAbandoned() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void TakeAbandoned(Group& group, std::vector<FairTask>& taken)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // The task whose turn it is; none if nobody may run.
  struct Turn {
    FairKey key;
    FairTask task;
  };
  std::optional<Turn> TakeTurn() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void NoteEnd(const FairKey& key, bool is_long) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const FairPoolOptions options_;
  const SteadyClock clock_;

  mutable absl::Mutex mutex_;
  Party<Tenant> all_ ABSL_GUARDED_BY(mutex_);
  Company tenants_ ABSL_GUARDED_BY(mutex_);
  Company groups_ ABSL_GUARDED_BY(mutex_);  // by name alone: whoever shares one shares its fate
  std::map<GroupName, Pace> paces_ ABSL_GUARDED_BY(mutex_);
  std::int64_t refused_ ABSL_GUARDED_BY(mutex_) = 0;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;

  std::vector<std::thread> threads_;
};

}  // namespace plumescout::server
