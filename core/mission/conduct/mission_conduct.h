// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/gas/field_audit.h"
#include "core/mission/conduct/conduct_observer.h"
#include "core/mission/conduct/ingest.h"
#include "core/mission/conduct/lease_book.h"
#include "core/mission/mission.h"
#include "core/types/event.h"

namespace plumescout {

// A client's wish to write a robot's log.
struct Registration {
  RobotId robot;
  double radius_m = 0.0;
  bool take_over = false;      // although another client holds the lease
  std::int64_t log_epoch = 0;  // which log it will write, see RobotRegistered; 0: it does not say
  RobotFrame frame = {};       // of its poses
  std::vector<GasSensor> sensors = {};
};

// A wish that a robot leave the mission.
struct Removal {
  RobotId robot;
  std::optional<std::int64_t> lease_token = std::nullopt;  // none: whoever holds the lease
};

struct Registered {
  std::int64_t lease_token = 0;
  LogPosition position;
  // Whether the numbers up to the position are of the client's log. If not, its first observation
  // takes the number after that.
  bool log_continues = true;
};

// A wish for a belief.
struct BeliefWish {
  RobotId robot = {};                     // whose log is to be in it; empty: nobody's in particular
  std::int64_t min_applied_sequence = 0;  // up to this number
  std::optional<std::int64_t> lease_token = std::nullopt;  // under which the robot asks, if it does
  bool fresh_posterior = true;  // false: the posterior as it is will do; the mission stays the same
};

// How often epochs come at the least. After so many events without one being adopted, one begins
// out of turn: only then can the mission be saved (see Mission::can_be_saved).
struct EpochHabit {
  std::int64_t events = 0;  // 0: epochs come when the gas field needs them
  // Revision at which the last one was adopted, of a mission that was recovered.
  std::int64_t last_revision = 0;
};

// Turns commands into numbered events of one mission: what is applied and in which order, when the
// gas posterior is refreshed, who may write. It has no clock, no threads and keeps nothing; whoever
// runs a mission is a shell around it. The same commands in the same order give the same events,
// and all that the commands' answers tell follows from the events.
//
// A shell that answers a command once the event mission().revision() is safe has lost nothing that
// was acknowledged. Single-threaded.
class MissionConduct {
 public:
  // The observer, if any, is not owned and outlives the last call.
  explicit MissionConduct(std::unique_ptr<Mission> mission, ConductObserver* observer = nullptr,
                          const EpochHabit& habit = {});

  const Mission& mission() const { return *mission_; }

  // The mission is told first: a lease is in force only if its registration is an event.
  absl::StatusOr<Registered> Register(const Registration& wish, Leases& leases);
  // The same under a lease that others grant.
  absl::StatusOr<LogPosition> Register(const RobotRegistered& registration);

  // Returns the revision that includes it. ROBOT_NOT_FOUND, LEASE_SUPERSEDED.
  absl::StatusOr<std::int64_t> Remove(const Removal& wish, Leases& leases);

  // The offset of a robot's clock under its lease, before the observations that it is for. No event
  // if it is in force already. Errors: those of CheckLease; kInvalidArgument.
  absl::Status NoteClock(const ClockOffsetNoted& noted, std::int64_t lease_token);

  // Sends robots home, or takes that back; no event for who has been told the same already. All or
  // none: ROBOT_NOT_FOUND. Returns the revision that includes it.
  absl::StatusOr<std::int64_t> OrderHome(const std::vector<RobotId>& robots, bool home);

  // No event if nothing changes. Errors: those of Mission::Apply. Returns the revision that
  // includes it.
  absl::StatusOr<std::int64_t> ChangeKeepOut(const KeepOutChanged& change);

  absl::StatusOr<LogPosition> Position(const RobotId& robot) const;
  // Whether writes under this token are applied now, whatever any book of leases says.
  absl::Status CheckLease(const RobotId& robot, std::int64_t lease_token) const;

  // Applies a batch in order. Entries up to the applied sequence are passed over; refused ones
  // count as applied. An unreadable entry stands in the log as an empty scan, which every mission
  // refuses. A posterior that cannot be kept up is told to the observer and stops no log.
  IngestResult Ingest(const RobotId& robot, std::int64_t lease_token,
                      std::vector<IncomingObservation> batch);

  // Commits a plan; returns its number. kAborted, see CommitRace, if another robot claims the goal
  // or, since the plan was searched for, has been given a way that this one runs into, or an area
  // that it leads through was closed.
  // `assigned`: the robot did not ask for it and will fetch it.
  absl::StatusOr<PlanId> Commit(const Plan& plan, std::int64_t lease_token, bool assigned = false);
  // Whom a commit of the plan would be refused for, one of several; `stopped` are taken to stand
  // where they are, and to claim nothing.
  std::optional<RobotId> InTheWayOf(const Plan& plan, const std::set<RobotId>& stopped = {}) const;
  // Returns the revision that includes the report; a repeated report changes nothing.
  absl::StatusOr<std::int64_t> Report(const ProgressReported& report, std::int64_t lease_token);

  // Nothing while the wish has to wait for its robot's log; OK once BeliefFor can grant it; an
  // error if waiting is in vain: an unknown robot, or a lease that another took over.
  std::optional<absl::Status> Verdict(const BeliefWish& wish) const;
  // REQUIRES: Verdict(wish) is OK.
  absl::StatusOr<std::shared_ptr<const Belief>> BeliefFor(const BeliefWish& wish);
  // What to tell who has waited long enough.
  absl::Status WaitedInVain(const BeliefWish& wish) const;

  // Brings the posterior up to date, if it is not, and snapshots the mission.
  absl::StatusOr<std::shared_ptr<const Belief>> FreshBelief();
  std::shared_ptr<const Belief> Snapshot() const { return mission_->Snapshot(); }

  // While `is_wanted` says that somebody is about to have the posterior brought up to date, a
  // refresh that is due after an observation waits for that one, which it would only double.
  void PutOffRefreshesWhile(std::function<bool()> is_wanted) {
    is_refresh_wanted_ = std::move(is_wanted);
  }

  // Out of turn; what is due after an observation, Ingest does by itself.
  absl::Status Refresh();
  // kFailedPrecondition if an epoch is under way or there is no field. It is adopted in its time.
  absl::Status BeginEpoch();
  // An epoch that is adopted at once; one that is under way will do. As BeginEpoch.
  absl::Status RenewField();

  // Counts what an audit found (see Mission::MakeAudit). If that is more than was certified, begins
  // an epoch out of turn, which makes the field anew; one that is under way will do.
  void TakeFinding(const AuditFinding& finding);

 private:
  absl::StatusOr<Applied> Apply(EventBody body);
  absl::Status IngestOne(const RobotId& robot, IncomingObservation incoming, IngestResult& result);
  // What is due to the gas posterior. After every observation rather than every batch: so the
  // events do not depend on how a log was cut into batches.
  void KeepGasUp();
  void KeepMapUp();
  bool IsRefreshWanted() const { return is_refresh_wanted_ && is_refresh_wanted_(); }
  bool IsEpochWanted() const;
  absl::Status Take(GasStep step, EventBody body);

  std::unique_ptr<Mission> mission_;
  ConductObserver* const observer_;
  EpochHabit habit_;
  std::function<bool()> is_refresh_wanted_ = nullptr;  // null: never
};

}  // namespace plumescout
