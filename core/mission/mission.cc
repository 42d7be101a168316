// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/mission.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/belief/regrid.h"
#include "core/gas/gas_scale.h"
#include "core/mission/observation_check.h"
#include "core/mission/sensor_check.h"
#include "core/occupancy/free_space.h"
#include "core/occupancy/keep_out.h"
#include "core/types/checker.h"
#include "core/types/keep_out.h"
#include "core/types/species.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

// The field on the geometry of `states`, NaN off its free cells; `prior` on those that are not in
// the region, which follows `states`.
std::shared_ptr<const Grid<float>> OnFreeCells(const Grid<float>& field,
                                               const Grid<CellState>& states,
                                               const FieldRegion& region, double prior) {
  auto result = std::make_shared<Grid<float>>(states.geometry(), kNoValue);
  if (field.size() > 0) *result = Regridded(field, states.geometry(), kNoValue);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] != CellState::kFree) {
      (*result)[i] = kNoValue;
    } else if (!region.Contains(states.geometry().CellAtIndex(i))) {
      (*result)[i] = static_cast<float>(prior);
    }
  }
  return result;
}

std::shared_ptr<const MissionOptions> InForce(MissionOptions options) {
  options.keep_out = WithNames(std::move(options.keep_out));
  return std::make_shared<const MissionOptions>(std::move(options));
}

absl::Status CheckTime(std::int64_t time_ns) {
  return Checker().AtLeast("time_ns", time_ns, 0).status();
}

// What GasMap could not even begin is no event, nor what was abandoned; what it failed in is one,
// for a replay to fail too.
bool HasChangedNothing(const absl::Status& gas) {
  return absl::IsInvalidArgument(gas) || absl::IsFailedPrecondition(gas) || absl::IsCancelled(gas);
}

std::int64_t RefreshPeriod_ns(const GasOptions& gas) {
  constexpr double kNanosecondsPerSecond = 1e9;
  return std::llround(gas.refresh_period_s * kNanosecondsPerSecond);
}

}  // namespace

absl::StatusOr<std::unique_ptr<Mission>> Mission::Create(const MissionOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionOptions fitted, FitToBudget(options));
  return std::make_unique<Mission>(fitted);
}

Mission::Mission(const MissionOptions& options)
    : options_(InForce(options)),
      occupancy_(options.occupancy),
      region_(options.gas.field_reach_m, options.occupancy.resolution_m),
      gas_(options),
      gas_audits_(gas_.count()),
      fleet_(options.robot_silence_s, options.return_home_below_battery_share),
      goal_memory_(options),
      sampled_cells_(gas_.count(), SampledCells(options.occupancy.resolution_m)),
      history_(options) {
  rasters_.gas.resize(gas_.count());
  if (options.prior_map == nullptr) return;
  [[maybe_unused]] const absl::Status learnt = occupancy_.Learn(*options.prior_map);
  assert(learnt.ok());
  if (CountsAsVisited(options.prior_map->geometry(), options.gas)) {
    region_.VisitAll(options.prior_map->geometry());
  }
  region_.Follow(occupancy_.geometry());
  map_changed_since_refresh_ = true;  // the gas of a known building can be told before any reading
}

absl::StatusOr<Applied> Mission::Apply(const EventBody& body) {
  PLUMESCOUT_ASSIGN_OR_RETURN(Applied applied,
                              std::visit([this](const auto& e) { return Change(e); }, body));
  applied.revision = ++revision_;
  NoteWhetherItGoesOn();
  return applied;
}

absl::StatusOr<Applied> Mission::Change(const RobotRegistered& registration) {
  const bool is_elsewhere = !fleet_.Knows(registration.robot) ||
                            fleet_.StateOf(registration.robot).frame.mission_from_robot !=
                                registration.frame.mission_from_robot;
  PLUMESCOUT_RETURN_IF_ERROR(CheckOffsets(registration.sensors, options_->gas));
  PLUMESCOUT_RETURN_IF_ERROR(CheckSpecies(registration.sensors, *options_));
  const std::vector<GasSensor> lagging = LaggingSensors(registration.robot);
  PLUMESCOUT_RETURN_IF_ERROR(
      fleet_.Register(registration, options_->max_robot_count, options_->pose_limit_m));
  FinishWays(registration.robot, lagging);
  if (is_elsewhere) {
    history_.DropQuarantined(registration.robot);
    TrustAgain(registration.robot);
  }
  return Applied{};
}

absl::StatusOr<Applied> Mission::Change(const ObservationReceived& received) {
  const Observation& observation = received.observation;
  PLUMESCOUT_RETURN_IF_ERROR(fleet_.CheckSequence(received.robot, observation));
  Applied applied;
  applied.observation = TakeIn(received.robot, observation, applied.turned_suspect);
  fleet_.Advance(received.robot, observation, !applied.observation.ok());
  return applied;
}

absl::Status Mission::TakeIn(const RobotId& robot, const Observation& observation,
                             bool& turned_suspect) {
  const std::int64_t clock_offset_ns = fleet_.StateOf(robot).clock_offset_ns;
  const std::int64_t time_ns = MissionTime_ns(observation, clock_offset_ns);
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckObservation(observation, *options_, sample_time_ns_, clock_offset_ns));
  const Pose2 pose = fleet_.InMission(robot, observation.pose);
  PLUMESCOUT_RETURN_IF_ERROR(CheckPlace(pose, options_->pose_limit_m));
  const bool corrects = std::holds_alternative<PoseCorrection>(observation.payload);
  if (const std::optional<WayPoint> latest = fleet_.LatestOf(robot);
      latest && SaysWhere(observation) && !corrects) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckStep(*latest, {time_ns, pose}, options_->max_robot_speed_mps));
  }
  const bool says_when = SaysWhen(observation);
  if (says_when || progress_.began_ns) fleet_.Hear(robot, std::max(sample_time_ns_, time_ns));
  if (SaysWhere(observation)) NotePose(robot, time_ns, pose);
  if (const auto* scan = std::get_if<Scan>(&observation.payload)) {
    PLUMESCOUT_RETURN_IF_ERROR(TakeScan(robot, time_ns, pose, *scan, turned_suspect));
  } else if (const auto* gas = std::get_if<GasReading>(&observation.payload)) {
    PLUMESCOUT_RETURN_IF_ERROR(TakeReading(robot, time_ns, pose, *gas));
  } else if (const auto* correction = std::get_if<PoseCorrection>(&observation.payload)) {
    PLUMESCOUT_RETURN_IF_ERROR(TakeCorrection(robot, observation, *correction));
  }
  sample_time_ns_ = std::max(sample_time_ns_, time_ns);
  if (!progress_.began_ns && says_when) progress_.began_ns = time_ns;
  TrimHistory();
  return absl::OkStatus();
}

absl::Status Mission::TakeScan(const RobotId& robot, std::int64_t time_ns, const Pose2& pose,
                               const Scan& scan, bool& turned_suspect) {
  const std::vector<MaskDisc> masks = fleet_.MasksFor(robot);
  const bool doubtful = IsInDoubt(robot, time_ns, pose, scan, masks, turned_suspect);
  if (!doubtful) PLUMESCOUT_RETURN_IF_ERROR(InsertScan(pose, scan, masks));
  history_.AddScan(robot, time_ns, pose, scan, masks, doubtful);
  return absl::OkStatus();
}

absl::Status Mission::InsertScan(const Pose2& pose, const Scan& scan,
                                 const std::vector<MaskDisc>& masks) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckRoom(pose.position(), 0));
  occupancy_.LimitCells(MostMapCells());
  PLUMESCOUT_RETURN_IF_ERROR(scan_inserter_.Insert(pose, scan, masks, occupancy_));
  region_.Visit(pose.position());
  region_.Follow(occupancy_.geometry());
  map_changed_since_refresh_ = true;
  map_changed_since_snapshot_ = true;
  return absl::OkStatus();
}

std::int64_t Mission::MostMapCells() const {
  const MemoryUse use = Use();
  return use.map_cells +
         RoomBesideField_bytes(options_->memory_budget_bytes, use) / use.CellBytes();
}

MemoryUse Mission::Use() const {
  MemoryUse use;
  use.map_cells = static_cast<std::int64_t>(occupancy_.geometry().size());
  use.species = static_cast<std::int64_t>(gas_.count());
  use.reading_sites = gas_.reading_sites();
  use.reading_buckets = gas_.reading_buckets();
  use.visited_tiles = static_cast<std::int64_t>(region_.visited_tiles());
  use.field_bytes = gas_.field_bytes();
  for (const auto& [robot, ways] : lagging_) use.ways += static_cast<std::int64_t>(ways.size());
  return use;
}

absl::Status Mission::CheckRoom(Point2 place, std::int64_t bytes) const {
  if (region_.IsNew(place)) bytes += kVisitedTileBytes;
  const MemoryUse use = Use();
  if (bytes == 0 || bytes <= RoomBesideField_bytes(options_->memory_budget_bytes, use)) {
    return absl::OkStatus();
  }
  return BudgetReached(
      absl::StrCat("the mission holds ", use.Total_bytes(),
                   " bytes of memory_budget_bytes = ", options_->memory_budget_bytes));
}

absl::StatusOr<Applied> Mission::Change(const PosteriorRefreshed& refresh) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckTime(refresh.time_ns));
  const bool readings_waited = gas_.stale();
  Applied applied;
  gas_.LimitFields(RoomForField_bytes(options_->memory_budget_bytes, Use()));
  applied.posterior = gas_.Refresh(region_.Within(occupancy_.States()), refresh.time_ns);
  if (HasChangedNothing(applied.posterior)) return applied.posterior;
  const bool succeeded = applied.posterior.ok();
  if (succeeded) posterior_time_ns_ = refresh.time_ns;
  refreshed_ns_ = refresh.time_ns;
  if (readings_waited || !succeeded) readings_refreshed_ns_ = refresh.time_ns;
  map_changed_since_refresh_ = false;
  gas_changed_since_snapshot_ = true;
  if (succeeded) AssessIfDue();
  return applied;
}

absl::StatusOr<Applied> Mission::Change(const PlanIssued& issued) {
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker().InRange("belief_revision", issued.plan.belief_revision, 0, revision_).status());
  Applied applied;
  PLUMESCOUT_ASSIGN_OR_RETURN(applied.plan_id,
                              fleet_.Issue(issued.plan, sample_time_ns_, issued.assigned));
  return applied;
}

absl::StatusOr<Applied> Mission::Change(const ProgressReported& report) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const EndedPlan ended, fleet_.Report(report));
  // A robot drives on, so what it was in the way of can be reached a moment later.
  const bool met = report.outcome == ProgressOutcome::kBlocked && ended.others_near;
  if (ended.goal && !met) goal_memory_.Remember(*ended.goal, report.outcome, Present());
  return Applied{};
}

absl::StatusOr<Applied> Mission::Change(const EpochBegun& begun) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckTime(begun.time_ns));
  PLUMESCOUT_RETURN_IF_ERROR(gas_.BeginEpoch(begun.time_ns));
  gas_changed_since_snapshot_ = true;  // what is published of errors
  return Applied{};
}

absl::StatusOr<Applied> Mission::Change(const EpochAdopted&) {
  Applied applied;
  applied.posterior = gas_.Adopt();
  if (HasChangedNothing(applied.posterior)) return applied.posterior;
  gas_changed_since_snapshot_ = true;
  return applied;
}

absl::StatusOr<Applied> Mission::Change(const RobotRemoved& removal) {
  PLUMESCOUT_RETURN_IF_ERROR(fleet_.Remove(removal.robot));
  FinishWays(removal.robot, LaggingSensors(removal.robot));
  return Applied{};
}

absl::StatusOr<Applied> Mission::Change(const ClockOffsetNoted& noted) {
  PLUMESCOUT_RETURN_IF_ERROR(fleet_.NoteClock(noted));
  return Applied{};
}

absl::StatusOr<Applied> Mission::Change(const HomeOrdered& order) {
  PLUMESCOUT_RETURN_IF_ERROR(fleet_.OrderHome(order));
  return Applied{};
}

absl::StatusOr<std::int64_t> Mission::AppliedSequence(const RobotId& robot) const {
  return fleet_.AppliedSequence(robot);
}

absl::StatusOr<RobotState> Mission::StateOf(const RobotId& robot) const {
  PLUMESCOUT_RETURN_IF_ERROR(fleet_.AppliedSequence(robot).status());
  return fleet_.StateOf(robot);
}

absl::StatusOr<std::int64_t> Mission::LeaseToken(const RobotId& robot) const {
  return fleet_.LeaseToken(robot);
}

std::optional<Meeting> Mission::FindMeeting(const Plan& plan, double clearance_m,
                                            const std::set<RobotId>& stopped) const {
  const PlanningOptions& planning = options_->planning;
  const bool yields = planning.yield_to_robots && !plan.trajectory.waypoints.empty();
  if (!yields || !fleet_.Knows(plan.robot)) return std::nullopt;
  std::map<RobotId, RobotRecord> robots = fleet_.Records();
  for (auto& [id, record] : robots) {
    if (stopped.contains(id)) record.live_trajectory = nullptr;
  }
  return Traffic(robots, plan.robot, std::min(clearance_m, planning.robot_clearance_m),
                 sample_time_ns_, Traffic::Others::kOnTime)
      .FirstMeeting(plan.trajectory);
}

bool Mission::LogContinues(const RobotId& robot, std::int64_t log_epoch) const {
  return fleet_.LogContinues(robot, log_epoch);
}

bool Mission::posterior_stale() const { return gas_.stale() || map_changed_since_refresh_; }

// A reading does not wait behind a refresh that a scan has just caused.
bool Mission::refresh_due() const {
  const std::int64_t since_ns = sample_time_ns_ - RefreshPeriod_ns(options_->gas);
  const bool is_due = (posterior_stale() && refreshed_ns_ <= since_ns) ||
                      (gas_.stale() && readings_refreshed_ns_ <= since_ns);
  return gas_.replaced() || (is_due && !IsAmidRound());
}

bool Mission::IsAmidRound() const {
  constexpr std::int64_t kRound_ns = 250'000'000;  // of robots that scan four times a second
  if (sample_time_ns_ - refreshed_ns_ > kRound_ns) return false;
  return fleet_.IsAnyLastHeardIn(
      sample_time_ns_ - kRound_ns,
      std::min(refreshed_ns_ + RefreshPeriod_ns(options_->gas), sample_time_ns_));
}

void Mission::UpdateRasters() const {
  if (map_changed_since_snapshot_) {
    rasters_.occupancy = std::make_shared<const Grid<CellState>>(occupancy_.States());
    Grid<std::uint8_t> traversable =
        TraversableCells(*rasters_.occupancy, options_->occupancy.inflation_radius_m);
    CloseKeptOut(options_->keep_out, traversable);
    rasters_.traversable = std::make_shared<const Grid<std::uint8_t>>(std::move(traversable));
  }
  if (map_changed_since_snapshot_ || gas_changed_since_snapshot_) {
    for (std::size_t i = 0; i < gas_.count(); ++i) {
      const GasOptions options = GasOptionsOf(*options_, i);
      rasters_.gas[i].mean_ppm = OnFreeCells(gas_[i].mean_ppm(), *rasters_.occupancy, region_,
                                             options.background_mean_ppm);
      rasters_.gas[i].variance_ppm2 = OnFreeCells(gas_[i].variance_ppm2(), *rasters_.occupancy,
                                                  region_, OpenLatticeVariance_ppm2(options));
      if (!gas_[i].has_own_errors()) continue;
      const GasQuality quality = gas_[i].quality();
      const double prior_variance = quality.clean_air_scale / quality.prior_precision_scale *
                                    OpenLatticeVariance_ppm2(options);
      rasters_.gas[i].error_variance_ppm2 =
          OnFreeCells(gas_[i].error_variance_ppm2(), *rasters_.occupancy, region_,
                      OffScale(options, 0.0, prior_variance).variance_ppm2);
    }
  }
  if (map_changed_since_snapshot_ || sampled_since_snapshot_) {
    rasters_.sampled = std::make_shared<const Grid<std::uint8_t>>(
        sampled_cells_.front().On(rasters_.occupancy->geometry()));
  }
  for (std::size_t i = 0; i < gas_.count(); ++i) {
    std::shared_ptr<const SampledCells>& cells = rasters_.gas[i].sampled_cells;
    if (cells == nullptr) cells = std::make_shared<const SampledCells>(sampled_cells_[i]);
  }
  sampled_since_snapshot_ = false;
  map_changed_since_snapshot_ = false;
  gas_changed_since_snapshot_ = false;
}

std::vector<SensorOffset> Mission::Offsets() const {
  std::vector<SensorOffset> offsets;
  for (std::size_t i = 0; i < gas_.count(); ++i) {
    for (SensorOffset offset : gas_[i].sensor_offsets()) {
      offset.species = SpeciesName(*options_, i);
      offsets.push_back(std::move(offset));
    }
  }
  return offsets;
}

std::shared_ptr<const Belief> Mission::Snapshot() const {
  UpdateRasters();
  auto belief = std::make_shared<Belief>();
  belief->revision = revision_;
  belief->sample_time_ns = sample_time_ns_;
  belief->posterior_time_ns = posterior_time_ns_;
  belief->options = options_;
  belief->occupancy = rasters_.occupancy;
  belief->traversable = rasters_.traversable;
  belief->gas_mean_ppm = rasters_.gas[0].mean_ppm;
  belief->gas_variance_ppm2 = rasters_.gas[0].variance_ppm2;
  belief->gas_error_variance_ppm2 = rasters_.gas[0].error_variance_ppm2;
  belief->gas_weight_variance_ppm2 = rasters_.gas[0].variance_ppm2;
  belief->gas_what_if = gas_.first().what_if();
  belief->sampled = rasters_.sampled;
  belief->sampled_cells = rasters_.gas[0].sampled_cells;
  belief->gas_counters = gas_.first().counters();
  belief->gas_quality = gas_.first().quality();
  belief->gas_audits = gas_audits_[0];
  for (std::size_t i = 1; i < gas_.count(); ++i) {
    belief->further_gases.push_back({rasters_.gas[i].mean_ppm, rasters_.gas[i].variance_ppm2,
                                     gas_[i].counters(), gas_[i].quality(), gas_audits_[i],
                                     rasters_.gas[i].error_variance_ppm2,
                                     rasters_.gas[i].sampled_cells});
  }
  belief->sensor_offsets = Offsets();
  belief->robots = fleet_.Records();
  belief->claims = fleet_.Claims(sample_time_ns_);
  belief->set_aside = goal_memory_.SetAside(Present());
  belief->phase = fleet_.Phase();
  belief->next_map_update_ns = fleet_.NextMapUpdate_ns(sample_time_ns_);
  belief->objective = objective();
  belief->deadline_ns = Deadline_ns();
  return belief;
}

}  // namespace plumescout
