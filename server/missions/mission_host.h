// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "absl/base/call_once.h"
#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "core/belief/belief.h"
#include "core/plan/strategy.h"
#include "plumescout/v1/options.pb.h"
#include "server/base/clock.h"
#include "server/base/request_memory.h"
#include "server/maps/map_feed.h"
#include "server/missions/belief_waiters.h"
#include "server/missions/clock_gate.h"
#include "server/missions/end_listeners.h"
#include "server/missions/ingest_room.h"
#include "server/missions/latest_plans.h"
#include "server/missions/lease_table.h"
#include "server/missions/mission_journal.h"
#include "server/missions/mission_standing.h"
#include "server/missions/mission_writer.h"
#include "server/missions/recorder.h"
#include "server/missions/robot_clocks.h"
#include "server/missions/robot_notices.h"
#include "server/missions/robot_rates.h"
#include "server/missions/snapshot_taker.h"
#include "server/missions/standing_record.h"

namespace plumescout::server {

// Whose a mission is.
struct MissionOwner {
  std::string name = "anonymous";
  std::string tenant = {};  // who is of another does not see it
};

struct HostOptions {
  int max_queued_observations = 4096;
  std::int64_t max_queued_bytes = std::int64_t{8} * 1024 * 1024;  // of observations
  int max_queued_commands = 4096;
  int max_waiters = 256;
  int max_watchers_per_robot = 64;  // see RobotNotices
  // For a belief or the disk, whatever the caller's deadline.
  absl::Duration max_wait = absl::Seconds(30);
  // Watchers see a new belief at most this often; but a reading ...
  absl::Duration publish_period = absl::Milliseconds(100);
  // ... that was acknowledged is in the posterior that they see after this at the latest.
  absl::Duration gas_wait = absl::Milliseconds(60);
  std::int64_t max_map_part_bytes = std::int64_t{3} << 20;  // of one message of the map
  absl::Duration lease_hold = absl::Seconds(10);
  std::int64_t first_lease_token = 1;
  SteadyClock clock = SteadyNow;
  WallClock wall_clock = WallNow_ns;
  absl::Duration max_clock_lead = absl::Seconds(5);  // of samples; see ClockGateOptions
  RateOptions rates = {};
};

// How much waits for a mission, and who.
struct HostLoad {
  int queued_commands = 0;
  int reserved_observations = 0;
  int waiting_calls = 0;  // for a belief
  int watchers = 0;
  // How long ago the first reading was acknowledged that watchers do not have; 0: they have all.
  absl::Duration unpublished;
};

// Runs one mission: a writer thread that takes commands from a bounded queue, and the belief it
// publishes. No call blocks but Stop. Callbacks run on the writer's thread, or on one that stops
// the mission, and must not block. Thread-safe.
class MissionHost {
 public:
  using Task = std::function<void(MissionWriter&)>;
  using OnDropped = std::function<void(const absl::Status&)>;
  // Of a command that was taken, exactly one of the two is called.
  struct Command {
    Task run;
    OnDropped drop = nullptr;         // the mission ends first; null: nobody has to hear of it
    IngestRoom::Hold room = nullptr;  // held while it waits; there is place for whoever has some
  };
  // Told of new beliefs until it returns false; an error is the last call.
  using Subscriber = std::function<bool(absl::StatusOr<std::shared_ptr<const Belief>>)>;

  struct Parts {
    MissionId id;
    std::unique_ptr<Mission> mission;
    std::unique_ptr<const Strategy> strategy;
    EventSink sink = nullptr;
    WorkerPool* epoch_pool = nullptr;  // of the writer, as is the next; see MissionWriter
    WorkerPool* audit_pool = nullptr;
    MissionOwner owner = {};
    MissionMetrics* metrics = &MissionMetrics::Unread();  // not owned; outlives the host
    std::shared_ptr<MissionJournal> journal = nullptr;    // null: the mission is not kept
    StandingRecord standing = {};                         // of a mission that is recovered
    JournalTail tail = {};                                // as well
    WorkerPool* snapshot_pool = nullptr;                  // null: no snapshots are taken
    std::unique_ptr<RecordingFeed> recording = nullptr;   // null: the mission is not recorded
  };

  // Robots that the mission knows go on with their leases, which are held as if used just now.
  MissionHost(Parts parts, const HostOptions& options);
  // REQUIRES: not called on the writer's thread, or after Stop.
  ~MissionHost();
  MissionHost(const MissionHost&) = delete;
  MissionHost& operator=(const MissionHost&) = delete;

  const MissionId& id() const { return id_; }
  const std::string& owner() const { return owner_.name; }
  const std::string& tenant() const { return owner_.tenant; }
  // As the mission began; its keep-out areas of now are in summary().options.
  const MissionOptions& options() const { return mission_options_; }
  const Strategy& strategy() const { return *strategy_; }
  LeaseTable& leases() { return leases_; }
  // As of leases(); who watches the robot hears when its lease runs out.
  void CloseStream(const RobotId& robot, StreamId stream);
  MissionStanding& standing() { return standing_; }
  const MissionStanding& standing() const { return standing_; }
  // Whether anything may change the mission, or plan: MISSION_FINISHED, MISSION_PAUSED, and what
  // MissionJournal::CheckTakesMore says.
  absl::Status CheckMayWrite() const;
  absl::Status CheckMayPlan() const;
  MissionJournal& journal() { return *journal_; }
  const std::shared_ptr<MissionJournal>& shared_journal() const { return journal_; }
  // Has the journal keep what became of standing() and leases().
  void KeepStanding();
  // `done` hears once all that was done to the mission so far is durable; an error after
  // HostOptions::max_wait, or if the mission ends. From any thread.
  void WhenDurable(MissionJournal::Callback done);
  RobotRates& rates() { return rates_; }
  // Of the calls that name this mission.
  const std::shared_ptr<RequestMemory>& requests() const { return requests_; }
  const std::shared_ptr<MapFeed>& map_feed() const { return map_feed_; }
  const std::shared_ptr<RobotNotices>& robot_notices() const { return robot_notices_; }
  LatestPlans& latest_plans() { return latest_plans_; }
  // The map that the mission began with, as cells. The first call packs it: not for reactors.
  // REQUIRES: there is one.
  const v1::PriorMap& prior_map();
  MissionSummary summary() const { return writer_.summary(); }
  GasTimings gas_timings() const { return writer_.gas_timings(); }
  MissionMetrics& metrics() { return metrics_; }
  HostLoad load() const;

  // Whether the mission may leave memory: everything is durable, and soon read again. If not, sees
  // to it: a snapshot is taken of what would take time to replay, of an epoch that is made for it.
  // To be asked now and then of a mission that nobody uses; false for ever if no store keeps it.
  bool IsReadyToSleep();
  // Has a snapshot taken as IsReadyToSleep does, of a mission that goes on meanwhile; `begun` hears
  // when what it needs is applied, or that the mission ends. An error as of Post: it hears nothing.
  absl::Status BeginSnapshot(std::function<void()> begun);
  // The mission comes to rest, for another server to go on with it: once `rests` has heard, all
  // that was done is durable, and nothing more is. What is posted from then on waits, no longer
  // than until BeginStop and DropAll. `rests` hears an error if it is not durable. Errors as Post.
  absl::Status BeginRest(MissionJournal::Callback rests);
  // Whether one is on its way to the store.
  bool is_taking_snapshot() const { return snapshots_ != nullptr && snapshots_->is_busy(); }

  // Of observations that wait.
  IngestRoom& room() { return *room_; }
  // Hear when the mission ends, or EndWaits does.
  EndListeners& end_listeners() { return end_listeners_; }

  // Has the writer, on its thread, apply a batch as MissionConduct::Ingest, if the mission takes
  // any (CheckMayWrite) and but for samples whose clock runs ahead (CLOCK_AHEAD). From `times` the
  // offset of the robot's clock is learnt before the batch is applied; if it does not say when it
  // was sent, its samples are taken to be of the times that they bear.
  IngestResult Ingest(MissionWriter& writer, const RobotId& robot, std::int64_t lease_token,
                      std::vector<IncomingObservation> batch, const BatchTimes& times = {});
  // The mission's clock, and what is known of its robots'.
  const MissionClock& clock() const { return mission_clock_; }
  const RobotClocks& robot_clocks() const { return robot_clocks_; }

  // The writer runs the command, after all earlier ones. OVERLOADED if too many wait; the status
  // given to Stop once the host stops. Then neither part of the command is called.
  absl::Status Post(Command command);
  absl::Status Post(Task run, OnDropped drop = nullptr) {
    return Post(Command{std::move(run), std::move(drop)});
  }
  // Waits no longer than HostOptions::max_wait once the writer has come to it.
  absl::Status AwaitBelief(BeliefRequest request, BeliefCallback done);
  // The present belief at once, then new ones as HostOptions say.
  absl::Status Subscribe(Subscriber subscriber);
  // Looks again whether those who wait still do.
  void Wake() { waiters_.DropAbandoned(); }

  // Fails who waits for a belief, now and later, and tells all end_listeners(). Commands go on.
  void EndWaits(const absl::Status& status);
  // From now on nothing is taken; what runs ends soon, and the writer after it, when it has handed
  // its events to the journal. Returns at once.
  // The first status counts.
  void BeginStop(const absl::Status& status);
  // As EndWaits; drops what is queued and ends all streams, though something still runs. REQUIRES:
  // BeginStop was called.
  void DropAll();
  // Both, and joins the writer.
  void Stop(const absl::Status& status);

 private:
  void Run();
  // Waits for commands until then; returns how many there are, none if the host is to stop.
  std::optional<std::size_t> AwaitCommands(SteadyTime until);
  // Nothing if the host is to stop.
  std::optional<Command> NextCommand();
  bool HasWork() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return (!commands_.empty() && !resting_) || stopping_;
  }
  // Whether a belief will be made as soon as the commands at hand have run.
  bool IsBeliefWanted() const {
    return queued_wishes_ > 0 || (more_follow_ && waiters_.size() > 0);
  }
  // Of every event, on the writer's thread.
  void Keep(const Event& event, const Applied& applied);
  IngestResult IngestMapped(MissionWriter& writer, const RobotId& robot, std::int64_t lease_token,
                            std::vector<IncomingObservation> batch,
                            const std::optional<ClockGate::Mapped>& mapped);
  void RecoverLeases(const StandingRecord& standing);
  void AfterCommands();
  void Settle(std::int64_t least_tail_bytes);  // the writer's part of IsReadyToSleep
  SteadyTime next_publication() const;         // max() if there is nothing new or nobody to tell
  void Publish(const absl::StatusOr<std::shared_ptr<const Belief>>& belief);
  bool IsResting() const;
  SteadyTime NextWake() const;

  const MissionId id_;
  const MissionOwner owner_;
  MissionMetrics& metrics_;
  const HostOptions host_options_;
  const MissionOptions mission_options_;
  const std::unique_ptr<const Strategy> strategy_;
  LeaseTable leases_;
  const std::shared_ptr<IngestRoom> room_;
  EndListeners end_listeners_;
  // Read by what the mission has running, which may outlive us.
  const std::shared_ptr<std::atomic<bool>> abandoned_;
  MissionStanding standing_;
  const std::shared_ptr<MissionJournal> journal_;
  const std::unique_ptr<SnapshotTaker> snapshots_;  // the writer's; null: none are taken
  const std::unique_ptr<RecordingFeed> recording_;  // the writer's; null: there is none
  const EventSink sink_;
  absl::Mutex keep_standing_;  // its records leave in the order in which they are made
  RobotRates rates_;
  const std::shared_ptr<RequestMemory> requests_;
  const std::shared_ptr<MapFeed> map_feed_;
  const std::shared_ptr<RobotNotices> robot_notices_;
  LatestPlans latest_plans_;
  absl::once_flag prior_map_packed_;
  v1::PriorMap prior_map_;  // once it is packed

  mutable absl::Mutex mutex_;
  std::deque<Command> commands_ ABSL_GUARDED_BY(mutex_);
  int bounded_commands_ ABSL_GUARDED_BY(mutex_) = 0;  // those without room of their own
  bool resting_ ABSL_GUARDED_BY(mutex_) = false;      // set by the writer
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  absl::Status stop_status_ ABSL_GUARDED_BY(mutex_);

  BeliefWaiters waiters_;
  std::atomic<int> queued_wishes_ = 0;  // calls of AwaitBelief that the writer has not come to
  bool more_follow_ = false;  // whether a belief may be due after the command at hand; the writer's
  // Touched by the writer's thread only, but for the writer's summary.
  MissionWriter writer_;
  ClockGate clock_gate_;
  const MissionClock mission_clock_;
  RobotClocks robot_clocks_;
  std::vector<Subscriber> subscribers_;
  std::int64_t published_revision_ = 0;
  SteadyTime published_at_;
  // What load() tells of these.
  std::atomic<SteadyTime> unpublished_since_ = SteadyTime::max();
  std::atomic<std::int64_t> settled_revision_ = -1;  // what IsReadyToSleep has seen to

  std::atomic<std::thread::id> writer_thread_;
  std::thread thread_;  // starts last: it uses all of the above
};

}  // namespace plumescout::server
