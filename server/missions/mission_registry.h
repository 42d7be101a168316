// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/synchronization/mutex.h"
#include "core/types/options.h"
#include "server/missions/mission_host.h"
#include "server/missions/mission_maker.h"
#include "server/missions/mission_reaper.h"
#include "server/missions/recovery_list.h"
#include "server/missions/recovery_waiters.h"
#include "server/missions/removal_list.h"
#include "server/missions/sought_missions.h"
#include "server/store/mission_store.h"
#include "server/store/store_nodes.h"

namespace plumescout::server {

// How many missions of the store do not run.
struct AbsentCounts {
  int recovering = 0;
  int damaged = 0;  // or not to be recovered for another reason
  int sleeping = 0;
  int waking = 0;
};

// All missions of a server, by key. Thread-safe; what makes, recovers and awaits missions blocks,
// the rest does not. Missions are made outside the lock: a name and its room are reserved first,
// and nobody finds the mission before it is made.
class MissionRegistry {
 public:
  MissionRegistry(const RegistryOptions& options, RegistryHooks hooks);

  // ALREADY_EXISTS; kInvalidArgument naming the option if one is beyond what missions may choose;
  // before anything is allocated LIMIT_REACHED if the mission could outgrow the server, and
  // BUDGET_REACHED if its known map outgrows its own budget. May take long for a mission that
  // begins with a map.
  absl::StatusOr<std::shared_ptr<MissionHost>> Create(const MissionId& id,
                                                      const MissionOptions& options,
                                                      const MissionOwner& owner = {});
  // kInvalidArgument naming the option if one is beyond what missions may choose.
  absl::Status CheckChoices(const MissionOptions& options) const {
    return maker_.CheckChoices(options);
  }
  // RECOVERING or STORE_DAMAGED of a mission that the store has and that does not run. One that
  // sleeps wakes; LIMIT_REACHED if there is no room for it. On a store of several servers,
  // MISSION_ELSEWHERE of a mission that another one has; RECOVERING until that is known, and of one
  // that is nobody's: it will be this server's. STORE_UNAVAILABLE without a lease.
  absl::StatusOr<std::shared_ptr<MissionHost>> Find(const MissionId& id,
                                                    absl::string_view tenant = {});
  // The one of this name, whosever it is; kFailedPrecondition if several tenants have one.
  absl::StatusOr<std::shared_ptr<MissionHost>> FindOfAnyTenant(const MissionId& id);
  // `look` is called once it is known what becomes of a mission that Find said is RECOVERING (key:
  // AwaitedMission), on another thread, unless StopAwaiting comes before. 0 if that is known by
  // now, or too many wait. Must not block.
  RecoveryWaiters::Id AwaitAnswer(const std::string& key, RecoveryWaiters::Look look)
      ABSL_LOCKS_EXCLUDED(mutex_);
  void StopAwaiting(RecoveryWaiters::Id id) ABSL_LOCKS_EXCLUDED(mutex_);
  // At most `limit` missions whose keys come after `after`, of those that are `wanted`, in order
  // of key.
  std::vector<std::shared_ptr<MissionHost>> List(
      const std::string& after, int limit,
      const std::function<bool(const MissionHost&)>& wanted = [](const MissionHost&) {
        return true;
      }) const;
  // The mission is off the list and ends with MISSION_NOT_FOUND. Its room is free once it has
  // stopped; `removed` hears, on another thread, when the store has forgotten it too. On error it
  // is not called.
  absl::Status Delete(
      const MissionId& id, absl::string_view tenant = {},
      MissionJournal::Callback removed = [](const absl::Status&) {});

  // The store forgets a mission that cannot be recovered, as Find has said; `removed` hears as of
  // Delete. MISSION_NOT_FOUND unless it is one. Reads the disk.
  absl::Status Discard(const std::string& key, MissionJournal::Callback removed);

  // From now on the missions that the store has are there, if only to be recovered; if missions
  // sleep, those with fewest events that there is no place for do. Those for which there is no
  // memory once it is their turn do in any case. Nothing of a store of several
  // servers: a mission is of the one that is called for it.
  absl::Status FindStored();
  // Somebody has called for a mission that sleeps: RecoverNext wakes it. Must not block.
  void SetOnCalledFor(std::function<void()> on_called_for);
  // Recovers the one of them that is wanted most. False if none waits, or nothing is to be made any
  // more.
  bool RecoverNext();
  // Takes over a mission that the store has, such as an import has put there. MISSION_EXISTS if it
  // runs, or is made by somebody but the caller, who holds its name; LIMIT_REACHED, and what
  // RecoverMission says.
  absl::Status Recover(const std::string& key, bool holds_name = false);
  // At most `limit` of those that do not run, whose keys come after this one and are `wanted`, in
  // order of key.
  std::vector<AbsentMission> ListAbsent(
      const std::string& after, int limit = std::numeric_limits<int>::max(),
      const WantedKey& wanted = [](const std::string&) { return true; }) const;
  AbsentCounts absent() const;
  // At most `limit` missions of a store that several servers share which this one does not have,
  // whose keys come after this one, begin so and are `wanted`, in order of key. Blocks.
  absl::StatusOr<std::vector<OwnedMission>> ListElsewhere(
      const std::string& after, int limit, const std::string& begins_with = {},
      const WantedKey& wanted = [](const std::string&) { return true; }) const;
  // This server's name among those that share its store; empty: it has one of its own.
  std::string node() const { return nodes_ == nullptr ? "" : nodes_->self().name; }

  // Room for what takes memory like a mission and is none, until the hold is let go; the registry
  // outlives it. LIMIT_REACHED.
  absl::StatusOr<std::shared_ptr<void>> HoldRoom(std::int64_t bytes) ABSL_LOCKS_EXCLUDED(mutex_);
  // What all that is there may come to hold: that much of the budget is taken.
  std::int64_t reserved_bytes() const ABSL_LOCKS_EXCLUDED(mutex_);

  // Nobody else makes or recovers a mission of this name until the hold is let go; the registry
  // outlives it. MISSION_EXISTS, and RECOVERING of one that is not there yet.
  absl::StatusOr<std::shared_ptr<void>> HoldName(const std::string& key)
      ABSL_LOCKS_EXCLUDED(mutex_);

  // Deletes those that have outlived their use, and that nobody but the registry holds: whoever
  // holds a mission uses it. Returns their names.
  std::vector<MissionId> DeleteIdle();
  // Tells servers that share the store for how long they are to keep missions of this one, should
  // it end, `period` and more beyond what is left to them; and deletes those of nobody that have
  // outlived their use. Returns their names. Called once a `period`, beside DeleteIdle. Blocks.
  absl::StatusOr<std::vector<MissionId>> DeleteForgotten(absl::Duration period);
  // Missions that nobody has used for RegistryOptions::sleep_after leave memory, once all of them
  // is durable. Returns their names.
  std::vector<MissionId> SleepIdle();

  // Has snapshots taken of missions that other servers are soon to read, while they go on. False if
  // not all are stored by then.
  bool TakeSnapshots(SteadyTime deadline);
  // Gives all missions to the other servers of the store, one after the other, when snapshots are
  // taken: what is asked of a mission meanwhile waits, until it is nobody's, and is then told
  // (MISSION_ELSEWHERE) who is to have it. From now on the same is said of every mission that is
  // not here. False if there is no other server: then they go on. What is not given away by the
  // deadline is dropped, or left to StopAll. Blocks.
  bool HandOverAll(SteadyTime deadline);
  // Gives up one mission, whose calls come to another node, as HandOverAll does; for a while calls
  // are told that that one has it. kAborted if it is being read just now. What does not come to
  // rest ends, and stays this node's. Blocks.
  absl::Status GiveUp(const StrayMission& stray);
  // MissionHost::EndWaits of all; no mission is made from then on.
  void EndWaits(const absl::Status& status);
  // All missions are off the list and stop; what is queued is dropped.
  void StopAll(const absl::Status& status);
  // For those that were deleted too. False if some still run by then.
  bool AwaitStopped(SteadyTime deadline) { return reaper_.AwaitAll(deadline); }
  // For the events of those that StopAll stopped to be durable. False if some are not by then.
  bool AwaitStored(SteadyTime deadline);

  // The lease in a store of several servers is lost, and all missions with it: they are off the
  // list and stop. Does not block.
  void LoseAll(const absl::Status& status);
  // After StopAll: other servers may have the missions at once. Blocks.
  void ReleaseAll();

 private:
  using Hosts = std::map<std::string, std::shared_ptr<MissionHost>>;

  // Takes the mission off the list and has it stopped; `then` is called when its room is free.
  void Reap(Hosts::iterator found, const absl::Status& status, std::function<void()> then)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Remove(Hosts::iterator found, MissionJournal::Callback removed)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status CheckLease() const;
  // Why no mission is made or recovered; OK if they are.
  absl::Status Closed(const std::string& key) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void HandOver(const std::shared_ptr<MissionHost>& host, SteadyTime deadline);
  absl::Status RestAndRelease(MissionHost& host, SteadyTime deadline);
  void ReleaseSleeping();
  void Release(const std::string& key, std::int64_t epoch);
  // Whether this server has had one lease since lives_ was this.
  absl::Status CheckLife(int life) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Of a mission that is not this server's, or not any more.
  absl::Status Seek(const std::string& key) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Of a mission of this name that the store may have, whosever it is.
  absl::StatusOr<std::shared_ptr<MissionHost>> FindByName(const MissionId& id)
      ABSL_LOCKS_EXCLUDED(mutex_);
  // Asks the store for missions of the name in this key. Blocks.
  void SeekName(const std::string& key) ABSL_LOCKS_EXCLUDED(mutex_);
  std::vector<KeptMission> KeptMissions(absl::Duration longer) ABSL_LOCKS_EXCLUDED(mutex_);
  absl::Status Forget(const ForgottenMission& mission) ABSL_LOCKS_EXCLUDED(mutex_);
  absl::Status RemoveForgotten(const ForgottenMission& mission);
  absl::Status CallForAbsent(const std::string& key) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // LIMIT_REACHED, of all missions and of those of the key's tenant.
  absl::Status CheckPlaces(const std::string& key) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status CheckCount() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status CheckRoom(const MissionId& id, const std::string& key, std::int64_t bytes) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status CheckMemory(absl::string_view what, std::int64_t bytes) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // The life that it is of.
  absl::StatusOr<int> Reserve(const MissionId& id, const std::string& key, std::int64_t bytes)
      ABSL_LOCKS_EXCLUDED(mutex_);
  absl::Status RecoverNow(const std::string& key, bool holds_name) ABSL_LOCKS_EXCLUDED(mutex_);
  // Takes room for a mission of the store before anything of it is read but its options; how much,
  // or LIMIT_REACHED. `has_room`: it was looked after.
  absl::StatusOr<std::int64_t> TakeRoomFor(const std::string& key, bool has_room)
      ABSL_LOCKS_EXCLUDED(mutex_);
  absl::Status CheckRecovery(const std::string& key, bool holds_name) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status CheckName(const MissionId& id, const std::string& key) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool may_sleep() const {
    return store_ != nullptr && store_->is_durable() &&
           options_.sleep_after != absl::InfiniteDuration();
  }
  int held_missions() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const RegistryOptions options_;
  MissionStore* const store_;  // null: none
  StoreNodes* const nodes_;    // null: the store is this server's alone
  const SteadyClock clock_;
  const MissionMaker maker_;

  mutable absl::Mutex mutex_;
  Hosts hosts_ ABSL_GUARDED_BY(mutex_);
  std::set<std::string> being_made_ ABSL_GUARDED_BY(mutex_);
  std::int64_t reserved_bytes_ ABSL_GUARDED_BY(mutex_) = 0;  // of all of them
  int stopping_missions_ ABSL_GUARDED_BY(mutex_) = 0;        // deleted, but still there
  absl::Status closed_ ABSL_GUARDED_BY(mutex_);              // OK while missions may be made
  RecoveryList absent_ ABSL_GUARDED_BY(mutex_);
  SoughtMissions sought_ ABSL_GUARDED_BY(mutex_);
  int lives_ ABSL_GUARDED_BY(mutex_) = 0;  // leases that were lost
  std::function<void()> on_called_for_ ABSL_GUARDED_BY(mutex_) = [] {};
  std::vector<std::shared_ptr<MissionJournal>> journals_ ABSL_GUARDED_BY(mutex_);  // of StopAll
  RecoveryWaiters waiters_ ABSL_GUARDED_BY(mutex_);
  // Nodes that are to have our missions; none unless they are handed over.
  std::vector<std::string> successors_ ABSL_GUARDED_BY(mutex_);
  // Seen by what is recovered; epochs of it may outlive us.
  const std::shared_ptr<std::atomic<bool>> closing_ = std::make_shared<std::atomic<bool>>(false);
  // Nobody recovers these; with the store, which may answer later than we live.
  const std::shared_ptr<RemovalList> removals_ = std::make_shared<RemovalList>();

  MissionReaper reaper_;  // goes first: what it calls uses the above
};

}  // namespace plumescout::server
