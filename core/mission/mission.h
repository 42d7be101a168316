// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/belief/belief.h"
#include "core/belief/sampled_cells.h"
#include "core/gas/field_region.h"
#include "core/gas/gas_maps.h"
#include "core/gas/way_readings.h"
#include "core/mission/fleet.h"
#include "core/mission/goal_memory.h"
#include "core/mission/held_verdict.h"
#include "core/mission/jump_watch.h"
#include "core/mission/map_rebuild.h"
#include "core/mission/memory_estimate.h"
#include "core/mission/way_history.h"
#include "core/occupancy/occupancy_grid.h"
#include "core/occupancy/scan_inserter.h"
#include "core/traffic/traffic.h"
#include "core/types/event.h"
#include "core/types/objective.h"
#include "core/types/options.h"
#include "core/types/stop.h"

namespace plumescout {

// What became of an event that was applied. An observation that the mission refuses (out of the
// map's limits, beyond its memory) still counts as applied: `observation` says why, and the robot's
// log moves on. So does a PosteriorRefreshed or EpochAdopted of which no gas field came:
// `posterior` says why.
struct Applied {
  std::int64_t revision = 0;
  absl::Status observation;
  absl::Status posterior;
  absl::Status map;             // of a MapRebuilt: why the map stays as it was
  bool turned_suspect = false;  // the observation's robot, see RobotState::frame_suspect
  PlanId plan_id = 0;           // of a PlanIssued: the number the mission gave it
};

// A mission is a deterministic state machine: state' = Apply(state, event). The same events give
// the same bytes. Single-threaded; the server gives each mission one writer.
class Mission {
 public:
  // Starts with what options.prior_map says. REQUIRES: Validate(options).ok(); Create checks it.
  explicit Mission(const MissionOptions& options);

  // With the options as FitToBudget makes them. kInvalidArgument if they are invalid;
  // BUDGET_REACHED, before anything is allocated, if their map does not fit.
  static absl::StatusOr<std::unique_ptr<Mission>> Create(const MissionOptions& options);

  // As they are in force: with the keep-out areas of now, all of which have names.
  const MissionOptions& options() const { return *options_; }
  std::shared_ptr<const MissionOptions> shared_options() const { return options_; }
  std::int64_t revision() const { return revision_; }
  MissionPhase phase() const { return fleet_.Phase(); }
  // None: it is for a complete map.
  std::optional<ObjectiveStatus> objective() const {
    if (options_->objective.kind == ObjectiveKind::kCompleteMap) return std::nullopt;
    return progress_.status;
  }
  std::optional<std::int64_t> next_map_update_ns() const {
    return fleet_.NextMapUpdate_ns(sample_time_ns_);
  }

  // Checks the body, gives it the next number and applies it. On error nothing has changed:
  //   kInvalidArgument     a field is out of range (named with its value)
  //   kNotFound            unknown robot or plan
  //   kAlreadyExists       observation sequence <= applied: ignore and acknowledge again
  //   kFailedPrecondition  a hole in the sequence ("SEQUENCE_GAP: expected N"), a stale plan or
  //                        lease, an epoch begun while one is under way or there is no
  //                        field, or adopted while none is under way; the same of rebuilt maps
  //   kAborted             PlanIssued: another robot's live plan claims the goal; plan once more
  //   kResourceExhausted   too many robots
  //   of a KeepOutChanged  those of AfterChange (core/types/keep_out.h); KEEP_OUT_COVERS_HOME, a
  //                        kFailedPrecondition, if no robot could come home any more
  //   kCancelled           the mission is abandoned; it is of no use any more
  absl::StatusOr<Applied> Apply(const EventBody& body);

  // The state of one robot's log; kNotFound if unknown.
  absl::StatusOr<std::int64_t> AppliedSequence(const RobotId& robot) const;
  absl::StatusOr<std::int64_t> LeaseToken(const RobotId& robot) const;
  absl::StatusOr<RobotState> StateOf(const RobotId& robot) const;
  std::vector<RobotId> RobotIds() const { return fleet_.Ids(); }  // in order of name
  // Where the plan's way meets the other robots if they drive on time, with the options' clearance
  // or `clearance_m` if that is less; none if it meets nobody or plans do not yield to robots.
  // `stopped` are taken to stand where they are. Cost: that of Traffic::FirstMeeting, and of a copy
  // of the robots' records.
  std::optional<Meeting> FindMeeting(const Plan& plan, double clearance_m,
                                     const std::set<RobotId>& stopped = {}) const;
  // Where the plan leads through a keep-out area, if areas have changed since the belief that it
  // was made on; see FirstKeptOut. Cost: that of KeptOutCells, if they have.
  std::optional<Point2> FindKeptOut(const Plan& plan) const;
  bool HasWay(const RobotId& robot) const { return fleet_.HasWay(robot); }
  // The live plan of another robot that ends where this one does, whatever for; PlanIssued is
  // refused for those of its kind alone. `stopped` are taken to have none.
  std::optional<GoalClaim> FindClaim(const Plan& plan,
                                     const std::set<RobotId>& stopped = {}) const {
    return fleet_.FindClaim(plan, sample_time_ns_, stopped);
  }
  // See Fleet::LogContinues.
  bool LogContinues(const RobotId& robot, std::int64_t log_epoch) const;

  // Whether readings or free cells changed since the last PosteriorRefreshed, or it failed.
  bool posterior_stale() const;

  // What the gas posterior needs now. These follow from the events alone, so writers that ask after
  // every observation, and apply what is due in this order, write the same events:
  // 1. EpochAdopted. epoch() is then best recomputed beforehand; if not, Apply does it.
  bool adoption_due() const { return gas_.adoption_due(sample_time_ns_); }
  // 2. PosteriorRefreshed, to sample_time_ns(): a reading waits and refresh_period_s has gone by
  // since the last refresh that found one, or the map changed and as much since any refresh. Robots
  // that send in rounds have it after a round.
  bool refresh_due() const;
  // A refresh is due at once when readings were placed anew.
  // 3. EpochBegun, at sample_time_ns(). Then somebody may recompute epoch() on another thread.
  bool epoch_due() const { return gas_.epoch_due(sample_time_ns_); }

  // Before these, what the map needs when poses were corrected, or found to be wrong:
  // MapRebuilt, for which rebuild() is then best recomputed beforehand, and MapRebuildBegun, after
  // which somebody may recompute rebuild() on another thread.
  bool rebuilt_map_due() const {
    return rebuild_ != nullptr && sample_time_ns_ >= rebuild_->due_ns();
  }
  // Not at once after another, so that corrections that come one after the other do not keep the
  // history from being trimmed or the mission from being saved.
  bool rebuild_due() const {
    return map_fault_ != MapFault::kNone && rebuild_ == nullptr &&
           sample_time_ns_ - rebuilt_ns_ >= kRebuildPause_ns;
  }
  std::shared_ptr<MapRebuild> rebuild() const { return rebuild_; }  // under way, or null

  // Whether one may begin out of turn.
  bool epoch_possible() const { return gas_.epoch_possible(); }
  std::shared_ptr<GasEpochs> epoch() const { return gas_.epoch(); }  // under way, or null

  // As GasMap. What audits find belongs to this process: it goes with snapshots, but it is no event
  // and changes nothing that an event could tell.
  bool audit_due() const { return gas_.audit_due(); }
  // `species`: a place among the mission's gases.
  std::shared_ptr<const AuditInputs> MakeAudit(std::size_t species = 0) const {
    return gas_[species].MakeAudit(species);
  }
  void NoteAudits(const GasAudits& audits, std::size_t species = 0) {
    gas_audits_[species] = audits;
  }
  const GasAudits& gas_audits(std::size_t species = 0) const { return gas_audits_[species]; }
  std::size_t species_count() const { return gas_.count(); }

  std::int64_t sample_time_ns() const { return sample_time_ns_; }

  // What it holds, as reckoned; at most options().memory_budget_bytes. Cost: O(robots).
  std::int64_t memory_bytes() const { return Use().Total_bytes() + history_.bytes(); }
  // Of the gas field now: that of the options, or a multiple since the map has grown large.
  int lattice_factor() const { return gas_.lattice_factor(); }

  // Once `stop` says so, and from then on it has to, a refresh or an epoch that runs, here or on
  // another thread, ends within 0.2 s, and so does each that is begun: with kCancelled. The mission
  // is not to be used any more then. `stop` is asked on the threads that compute.
  void AbandonWhen(StopFn stop) {
    stop_ = std::move(stop);
    gas_.AbandonWhen(stop_);
  }

  // The present state, for readers. Cost: O(cells) if the map changed since the last call.
  std::shared_ptr<const Belief> Snapshot() const;

  // A hash over all that events determine, means and variances of the gas bit by bit: the same
  // wherever the same events were applied, live, in a replay or after a Restore. What audits found
  // is left out. Cost: O(cells + readings); docs/performance.md.
  std::uint64_t Digest() const;

  // The state as bytes, from which Restore goes on. What the gas field is depends, within its
  // certificate, on the way it came about, so it is not possible at any revision: before there is
  // a field, and while it has heard nothing since it was made anew. Hence always right after an
  // EpochAdopted, which observers of a conduct hear of before anything else is applied; also after
  // a refresh or adoption that failed, until there is a field again. Never while an epoch or a
  // rebuild of the map is under way.
  bool can_be_saved() const { return gas_.can_be_written() && rebuild_ == nullptr; }
  // kFailedPrecondition if it cannot be saved now. Cost: as of Digest. zlib makes a quarter of the
  // bytes.
  absl::StatusOr<std::string> SaveState() const;
  // The mission that was saved: equal, and equal under all further events, bit by bit. `options` as
  // they were for Create. `stop` as of AbandonWhen, and asked meanwhile. Errors: those of Create;
  // kDataLoss, saying what is wrong, for bytes that are not those of SaveState;
  // kFailedPrecondition, naming it, for a version of theirs that is not known; kCancelled. Cost:
  // reading, and one or two fresh computations of the field.
  static absl::StatusOr<std::unique_ptr<Mission>> Restore(const MissionOptions& options,
                                                          absl::string_view bytes,
                                                          StopFn stop = {});
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  static constexpr std::int64_t kRebuildPause_ns = 5'000'000'000;

  friend struct MissionPeer;  // of the tests

  absl::StatusOr<Applied> Change(const RobotRegistered& registration);
  absl::StatusOr<Applied> Change(const ObservationReceived& received);
  absl::StatusOr<Applied> Change(const PosteriorRefreshed& refresh);
  absl::StatusOr<Applied> Change(const PlanIssued& issued);
  absl::StatusOr<Applied> Change(const ProgressReported& report);
  absl::StatusOr<Applied> Change(const EpochBegun& begun);
  absl::StatusOr<Applied> Change(const EpochAdopted& adopted);
  absl::StatusOr<Applied> Change(const RobotRemoved& removal);
  absl::StatusOr<Applied> Change(const ClockOffsetNoted& noted);
  absl::StatusOr<Applied> Change(const HomeOrdered& order);
  absl::StatusOr<Applied> Change(const MapRebuildBegun& begun);
  absl::StatusOr<Applied> Change(const MapRebuilt& rebuilt);
  absl::StatusOr<Applied> Change(const KeepOutChanged& change);
  bool CoversHomes(const std::vector<Polygon>& areas) const;
  void KeepOutOf(std::vector<Polygon> areas);
  // Robots of a team send in rounds. Whether one is under way: somebody who sent a moment ago has
  // not since a refresh became due. A refresh amid a round would soon be out of date, and whoever
  // asks for a belief after the round would wait for another. Nobody is waited for for long.
  bool IsAmidRound() const;
  // Brings the status up to date, once a second of sample time. Cost: O(cells), and what it costs
  // to look at the gas.
  void AssessIfDue();
  void NoteWhetherItGoesOn();
  std::optional<std::int64_t> Deadline_ns() const;
  // Whether it has come to anything that other missions have not.
  bool has_purpose() const;
  GoalMemory::Now Present() const {
    return {sample_time_ns_, occupancy_.States(), gas_.first().variance_ppm2()};
  }
  absl::Status TakeIn(const RobotId& robot, const Observation& observation, bool& turned_suspect);
  absl::Status TakeScan(const RobotId& robot, std::int64_t time_ns, const Pose2& pose,
                        const Scan& scan, bool& turned_suspect);
  absl::Status InsertScan(const Pose2& pose, const Scan& scan, const std::vector<MaskDisc>& masks);
  absl::Status TakeReading(const RobotId& robot, std::int64_t time_ns, const Pose2& pose,
                           GasReading reading);
  absl::Status Keep(const RobotId& robot, const GasSensor& sensor, const AirReading& air);
  absl::Status KeepAll(const RobotId& robot, const GasSensor& sensor,
                       const std::vector<AirReading>& told);
  WayModel ModelOf(const GasSensor& sensor) const;
  void NotePose(const RobotId& robot, std::int64_t time_ns, const Pose2& pose);
  std::vector<GasSensor> LaggingSensors(const RobotId& robot) const;
  std::vector<WayPoint> UntoldPoints(const RobotId& robot) const;
  void FinishWays(const RobotId& robot, const std::vector<GasSensor>& sensors);
  absl::Status AddReading(std::size_t species, const ReadingSource& source, std::int64_t time_ns,
                          Point2 place, const GasReading& reading, bool is_part);
  absl::Status TakeCorrection(const RobotId& robot, const Observation& observation,
                              const PoseCorrection& correction);
  bool IsInDoubt(const RobotId& robot, std::int64_t time_ns, const Pose2& pose, const Scan& scan,
                 const std::vector<MaskDisc>& masks, bool& turned);
  void TrustAgain(const RobotId& robot);
  void PlaceReadingsAgain();
  std::vector<SensorOffsets> Sensors(const std::vector<WayHistory::Heard>& heard) const;
  std::vector<SensorOffset> Offsets() const;
  void TrimHistory();
  std::int64_t MostMapCells() const;
  MemoryUse Use() const;
  // BUDGET_REACHED if so many bytes more, and those of a first visit to `place`, are too many.
  absl::Status CheckRoom(Point2 place, std::int64_t bytes) const;

  std::shared_ptr<const MissionOptions> options_;
  // Those of options_ once they were changed; none: as the mission began.
  std::optional<std::vector<Polygon>> changed_keep_out_;
  std::int64_t keep_out_revision_ = 0;  // of the last change in this process
  std::int64_t revision_ = 0;
  std::int64_t sample_time_ns_ = 0;
  std::int64_t posterior_time_ns_ = 0;  // of the last refresh that succeeded
  std::int64_t refreshed_ns_ = 0;       // of the last one
  std::int64_t readings_refreshed_ns_ =
      0;  // of the last one that found readings waiting, or failed
  OccupancyGrid occupancy_;
  ScanInserter scan_inserter_;
  FieldRegion region_;
  GasMaps gas_;
  std::vector<GasAudits> gas_audits_;  // by species
  Fleet fleet_;
  GoalMemory goal_memory_;
  std::vector<SampledCells> sampled_cells_;              // by species
  std::map<RobotId, std::vector<WayReadings>> lagging_;  // by sensor, of robots with such that lag
  WayHistory history_;
  JumpWatch jump_watch_;
  MapFault map_fault_ = MapFault::kNone;  // of which no rebuild is under way
  std::int64_t rebuilt_ns_ = 0;           // sample time at which a rebuilt map was last adopted
  std::shared_ptr<MapRebuild> rebuild_;   // under way, or null
  // With its objective.
  struct Progress {
    ObjectiveStatus status;
    std::optional<std::int64_t> began_ns;     // when the first observation was taken
    std::optional<std::int64_t> assessed_ns;  // when it was assessed last
    HeldVerdict verdict;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  Progress progress_;
  StopFn stop_;
  bool map_changed_since_refresh_ = false;

  // Rasters of the last snapshot, shared with it until they change.
  struct Rasters {
    std::shared_ptr<const Grid<CellState>> occupancy;
    std::shared_ptr<const Grid<std::uint8_t>> traversable;
    std::vector<GasField> gas;  // by species: rasters, and cells; those null when they changed
    std::shared_ptr<const Grid<std::uint8_t>> sampled;
  };
  void UpdateRasters() const;
  mutable Rasters rasters_;
  mutable bool map_changed_since_snapshot_ = true;
  mutable bool gas_changed_since_snapshot_ = true;
  mutable bool sampled_since_snapshot_ = true;
};

}  // namespace plumescout
