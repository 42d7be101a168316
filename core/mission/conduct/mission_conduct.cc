// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/mission_conduct.h"

#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/traffic/traffic.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// What stands in the log for an entry that could not be read: no mission takes a scan of no beams.
Observation Unreadable(std::int64_t sequence) {
  return {.sequence = sequence, .sample_time_ns = 0, .pose = {}, .payload = Scan{}};
}

}  // namespace

MissionConduct::MissionConduct(std::unique_ptr<Mission> mission, ConductObserver* observer,
                               const EpochHabit& habit)
    : mission_(std::move(mission)), observer_(observer), habit_(habit) {}

absl::StatusOr<Applied> MissionConduct::Apply(EventBody body) {
  PLUMESCOUT_ASSIGN_OR_RETURN(Applied applied, mission_->Apply(body));
  if (std::holds_alternative<EpochAdopted>(body)) habit_.last_revision = applied.revision;
  if (observer_ != nullptr) observer_->OnEvent({applied.revision, std::move(body)}, applied);
  return applied;
}

absl::StatusOr<Registered> MissionConduct::Register(const Registration& wish, Leases& leases) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t token, leases.Propose(wish.robot, wish.take_over));
  const bool continues = mission_->LogContinues(wish.robot, wish.log_epoch);
  PLUMESCOUT_ASSIGN_OR_RETURN(const LogPosition position,
                              Register(RobotRegistered{.robot = wish.robot,
                                                       .radius_m = wish.radius_m,
                                                       .lease_token = token,
                                                       .log_epoch = wish.log_epoch,
                                                       .frame = wish.frame,
                                                       .sensors = wish.sensors}));
  leases.Grant(wish.robot, token);
  return Registered{token, position, continues};
}

absl::StatusOr<LogPosition> MissionConduct::Register(const RobotRegistered& registration) {
  PLUMESCOUT_RETURN_IF_ERROR(Apply(registration).status());
  return Position(registration.robot);
}

absl::StatusOr<std::int64_t> MissionConduct::Remove(const Removal& wish, Leases& leases) {
  if (wish.lease_token) PLUMESCOUT_RETURN_IF_ERROR(CheckLease(wish.robot, *wish.lease_token));
  const auto applied = Apply(RobotRemoved{wish.robot});
  if (absl::IsNotFound(applied.status())) return RobotNotFound(wish.robot);
  PLUMESCOUT_RETURN_IF_ERROR(applied.status());
  leases.Remove(wish.robot);
  return applied->revision;
}

absl::Status MissionConduct::NoteClock(const ClockOffsetNoted& noted, std::int64_t lease_token) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(noted.robot, lease_token));
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotState state, mission_->StateOf(noted.robot));
  if (state.clock_offset_ns == noted.offset_ns) return absl::OkStatus();
  return Apply(noted).status();
}

absl::StatusOr<std::int64_t> MissionConduct::OrderHome(const std::vector<RobotId>& robots,
                                                       bool home) {
  std::vector<RobotId> untold;
  for (const RobotId& robot : robots) {
    const auto state = mission_->StateOf(robot);
    if (!state.ok()) return RobotNotFound(robot);
    if (state->ordered_home != home) untold.push_back(robot);
  }
  for (const RobotId& robot : untold) {
    PLUMESCOUT_RETURN_IF_ERROR(Apply(HomeOrdered{robot, home}).status());
  }
  return mission_->revision();
}

absl::StatusOr<std::int64_t> MissionConduct::ChangeKeepOut(const KeepOutChanged& change) {
  const bool changes = !change.deleted.empty() || !change.added.empty();
  if (changes) PLUMESCOUT_RETURN_IF_ERROR(Apply(change).status());
  return mission_->revision();
}

absl::StatusOr<LogPosition> MissionConduct::Position(const RobotId& robot) const {
  const auto applied = mission_->AppliedSequence(robot);
  if (!applied.ok()) return RobotNotFound(robot);
  return LogPosition{*applied, mission_->revision()};
}

absl::Status MissionConduct::CheckLease(const RobotId& robot, std::int64_t lease_token) const {
  const auto newest = mission_->LeaseToken(robot);
  if (!newest.ok()) return RobotNotFound(robot);
  return *newest == lease_token ? absl::OkStatus() : LeaseSuperseded(robot);
}

IngestResult MissionConduct::Ingest(const RobotId& robot, std::int64_t lease_token,
                                    std::vector<IncomingObservation> batch) {
  IngestResult result;
  result.status = CheckLease(robot, lease_token);
  for (IncomingObservation& incoming : batch) {
    if (!result.status.ok()) break;
    result.status = IngestOne(robot, std::move(incoming), result);
  }
  if (const auto position = Position(robot); position.ok()) result.position = *position;
  return result;
}

absl::Status MissionConduct::IngestOne(const RobotId& robot, IncomingObservation incoming,
                                       IngestResult& result) {
  const std::int64_t sequence = incoming.observation.sequence;
  const bool readable = incoming.unreadable.ok();
  const auto applied = Apply(ObservationReceived{
      robot, readable ? std::move(incoming.observation) : Unreadable(sequence)});
  if (absl::IsAlreadyExists(applied.status())) return absl::OkStatus();
  PLUMESCOUT_RETURN_IF_ERROR(applied.status());
  if (!applied->observation.ok()) {
    result.refused.push_back({sequence, readable ? applied->observation : incoming.unreadable});
  }
  KeepMapUp();
  KeepGasUp();
  return absl::OkStatus();
}

absl::StatusOr<PlanId> MissionConduct::Commit(const Plan& plan, std::int64_t lease_token,
                                              bool assigned) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(plan.robot, lease_token));
  if (const auto place = mission_->FindKeptOut(plan)) {
    return absl::AbortedError(absl::StrCat("the way leads through (", place->x_m, ", ", place->y_m,
                                           "), which was closed"));
  }
  if (const auto meeting = mission_->FindMeeting(plan, kCommittedClearance_m)) {
    return absl::AbortedError(
        absl::StrCat("the way meets robot \"", meeting->robot, "\" in ", meeting->time_s, " s"));
  }
  if (const auto claim = mission_->FindClaim(plan)) {
    return absl::AbortedError(absl::StrCat("the goal is claimed by robot \"", claim->robot,
                                           "\" with plan ", claim->plan));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied, Apply(PlanIssued{plan, assigned}));
  return applied.plan_id;
}

std::optional<RobotId> MissionConduct::InTheWayOf(const Plan& plan,
                                                  const std::set<RobotId>& stopped) const {
  if (const auto meeting = mission_->FindMeeting(plan, kCommittedClearance_m, stopped)) {
    return meeting->robot;
  }
  const auto claim = mission_->FindClaim(plan, stopped);
  return claim ? std::optional<RobotId>(claim->robot) : std::nullopt;
}

absl::StatusOr<std::int64_t> MissionConduct::Report(const ProgressReported& report,
                                                    std::int64_t lease_token) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(report.robot, lease_token));
  const auto applied = Apply(report);
  if (!absl::IsAlreadyExists(applied.status())) PLUMESCOUT_RETURN_IF_ERROR(applied.status());
  return mission_->revision();
}

std::optional<absl::Status> MissionConduct::Verdict(const BeliefWish& wish) const {
  if (wish.robot.empty()) return absl::OkStatus();
  if (wish.lease_token) PLUMESCOUT_RETURN_IF_ERROR(CheckLease(wish.robot, *wish.lease_token));
  const auto position = Position(wish.robot);
  if (!position.ok()) return position.status();
  if (position->applied_sequence >= wish.min_applied_sequence) return absl::OkStatus();
  return std::nullopt;
}

absl::StatusOr<std::shared_ptr<const Belief>> MissionConduct::BeliefFor(const BeliefWish& wish) {
  if (wish.fresh_posterior) return FreshBelief();
  return Snapshot();
}

absl::Status MissionConduct::WaitedInVain(const BeliefWish& wish) const {
  return absl::DeadlineExceededError(
      absl::StrCat("waited for sequence ", wish.min_applied_sequence, " of robot \"", wish.robot,
                   "\", which stands at ", mission_->AppliedSequence(wish.robot).value_or(0)));
}

absl::StatusOr<std::shared_ptr<const Belief>> MissionConduct::FreshBelief() {
  if (mission_->posterior_stale()) PLUMESCOUT_RETURN_IF_ERROR(Refresh());
  return Snapshot();
}

void MissionConduct::KeepMapUp() {
  if (mission_->rebuilt_map_due()) {
    if (observer_ != nullptr) observer_->BeforeMapRebuilt();
    Apply(MapRebuilt{}).IgnoreError();  // abandoned: the mission ends
  }
  if (!mission_->rebuild_due() || !Apply(MapRebuildBegun{}).ok()) return;
  if (observer_ != nullptr) observer_->AfterMapRebuildBegun();
}

void MissionConduct::KeepGasUp() {
  if (mission_->adoption_due()) Take(GasStep::kAdoptEpoch, EpochAdopted{}).IgnoreError();
  if (mission_->refresh_due() && !IsRefreshWanted()) Refresh().IgnoreError();
  if (mission_->epoch_due() || IsEpochWanted()) BeginEpoch().IgnoreError();
}

bool MissionConduct::IsEpochWanted() const {
  return habit_.events > 0 && mission_->revision() - habit_.last_revision >= habit_.events &&
         mission_->epoch_possible();
}

absl::Status MissionConduct::Refresh() {
  return Take(GasStep::kRefresh, PosteriorRefreshed{mission_->sample_time_ns()});
}

absl::Status MissionConduct::BeginEpoch() {
  return Take(GasStep::kBeginEpoch, EpochBegun{mission_->sample_time_ns()});
}

absl::Status MissionConduct::RenewField() {
  if (mission_->epoch() == nullptr) PLUMESCOUT_RETURN_IF_ERROR(BeginEpoch());
  return Take(GasStep::kAdoptEpoch, EpochAdopted{});
}

void MissionConduct::TakeFinding(const AuditFinding& finding) {
  GasAudits audits = mission_->gas_audits(finding.species);
  ++audits.audits;
  audits.mean_ppm = finding.mean_ppm;
  audits.variance_ratio = finding.variance_ratio;
  if (!finding.certified) ++audits.alarms;
  mission_->NoteAudits(audits, finding.species);
  if (!finding.certified && mission_->epoch() == nullptr) BeginEpoch().IgnoreError();
}

absl::Status MissionConduct::Take(GasStep step, EventBody body) {
  if (observer_ != nullptr) observer_->BeforeGasStep(step);
  const auto applied = Apply(std::move(body));
  const absl::Status status = applied.ok() ? applied->posterior : applied.status();
  if (observer_ != nullptr) observer_->AfterGasStep(step, status);
  return status;
}

}  // namespace plumescout
