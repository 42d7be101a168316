// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_writer.h"

#include <utility>
#include <variant>

#include "core/types/status_macros.h"
#include "server/base/errors.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

// What stands in the log for an entry that could not be read: no mission takes a scan of no beams.
Observation Unreadable(std::int64_t sequence) {
  return {.sequence = sequence, .sample_time_ns = 0, .pose = {}, .payload = Scan{}};
}

void Warn(const absl::Status& gas) {
  if (!gas.ok()) LogWarning("gas posterior not kept up", {{"why", std::string(gas.message())}});
}

}  // namespace

MissionWriter::MissionWriter(std::unique_ptr<Mission> mission, EventSink sink,
                             WorkerPool* epoch_pool, SteadyClock clock)
    : mission_(std::move(mission)),
      sink_(std::move(sink)),
      clock_(std::move(clock)),
      epoch_runner_(epoch_pool),
      summary_{mission_->revision(), mission_->phase(), mission_->next_map_update_ns()} {}

MissionSummary MissionWriter::summary() const {
  absl::MutexLock lock(&summary_mutex_);
  return summary_;
}

absl::StatusOr<Applied> MissionWriter::Apply(EventBody body) {
  PLUMESCOUT_ASSIGN_OR_RETURN(Applied applied, mission_->Apply(body));
  if (sink_) sink_(Event{applied.revision, std::move(body)});
  absl::MutexLock lock(&summary_mutex_);
  summary_ = {mission_->revision(), mission_->phase(), mission_->next_map_update_ns()};
  return applied;
}

absl::Status MissionWriter::CheckLease(const RobotId& robot, std::int64_t lease_token) const {
  const auto newest = mission_->LeaseToken(robot);
  if (!newest.ok()) return RobotNotFound(robot);
  return *newest == lease_token ? absl::OkStatus() : LeaseSuperseded(robot);
}

absl::StatusOr<LogPosition> MissionWriter::Register(const RobotRegistered& registration) {
  PLUMESCOUT_RETURN_IF_ERROR(Apply(registration).status());
  return Position(registration.robot);
}

absl::StatusOr<std::int64_t> MissionWriter::Remove(const RobotId& robot,
                                                   std::optional<std::int64_t> lease_token) {
  if (!mission_->LeaseToken(robot).ok()) return RobotNotFound(robot);
  if (lease_token) PLUMESCOUT_RETURN_IF_ERROR(CheckLease(robot, *lease_token));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied, Apply(RobotRemoved{robot}));
  return applied.revision;
}

absl::StatusOr<LogPosition> MissionWriter::Position(const RobotId& robot) const {
  const auto applied = mission_->AppliedSequence(robot);
  if (!applied.ok()) return RobotNotFound(robot);
  return LogPosition{*applied, mission_->revision()};
}

IngestResult MissionWriter::Ingest(const RobotId& robot, std::int64_t lease_token,
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

absl::Status MissionWriter::IngestOne(const RobotId& robot, IncomingObservation incoming,
                                      IngestResult& result) {
  const std::int64_t sequence = incoming.observation.sequence;
  const bool readable = incoming.unreadable.ok();
  const bool is_reading = std::holds_alternative<GasReading>(incoming.observation.payload);
  const auto applied = Apply(ObservationReceived{
      robot, readable ? std::move(incoming.observation) : Unreadable(sequence)});
  if (absl::IsAlreadyExists(applied.status())) return absl::OkStatus();
  PLUMESCOUT_RETURN_IF_ERROR(applied.status());
  if (!applied->observation.ok()) {
    result.refused.push_back({sequence, readable ? applied->observation : incoming.unreadable});
  } else if (is_reading) {
    gas_timer_.NoteReading(clock_());
  }
  KeepGasUp();
  return absl::OkStatus();
}

absl::StatusOr<PlanId> MissionWriter::Commit(const Plan& plan, std::int64_t lease_token) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(plan.robot, lease_token));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied, Apply(PlanIssued{plan}));
  return applied.plan_id;
}

absl::StatusOr<std::int64_t> MissionWriter::Report(const ProgressReported& report,
                                                   std::int64_t lease_token) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(report.robot, lease_token));
  const auto applied = Apply(report);
  if (!absl::IsAlreadyExists(applied.status())) PLUMESCOUT_RETURN_IF_ERROR(applied.status());
  return mission_->revision();
}

void MissionWriter::KeepGasUp() {
  absl::Status status;
  if (mission_->adoption_due()) status.Update(AdoptEpoch());
  if (mission_->refresh_due()) status.Update(Refresh());
  if (mission_->epoch_due()) status.Update(BeginEpoch());
  Warn(status);
}

absl::Status MissionWriter::Refresh() {
  const SteadyTime from = clock_();
  PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied,
                              Apply(PosteriorRefreshed{mission_->sample_time_ns()}));
  PLUMESCOUT_RETURN_IF_ERROR(applied.posterior);
  gas_timer_.NoteRefresh(from, clock_());
  return absl::OkStatus();
}

absl::Status MissionWriter::AdoptEpoch() {
  const SteadyTime from = clock_();
  epoch_runner_.Finish();
  PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied, Apply(EpochAdopted{}));
  PLUMESCOUT_RETURN_IF_ERROR(applied.posterior);
  gas_timer_.NoteAdoption(from, clock_());
  return absl::OkStatus();
}

absl::Status MissionWriter::BeginEpoch() {
  PLUMESCOUT_RETURN_IF_ERROR(Apply(EpochBegun{mission_->sample_time_ns()}).status());
  epoch_runner_.Start(mission_->epoch());
  return absl::OkStatus();
}

absl::StatusOr<std::shared_ptr<const Belief>> MissionWriter::FreshBelief() {
  if (mission_->posterior_stale()) PLUMESCOUT_RETURN_IF_ERROR(Refresh());
  return mission_->Snapshot();
}

std::shared_ptr<const Belief> MissionWriter::Publish(absl::Duration gas_wait) {
  const SteadyTime now = clock_();
  const bool waits = !gas_timer_.unpublished_in_posterior();
  if (waits && now >= After(unpublished_since(), gas_wait)) {
    const absl::Status refreshed = Refresh();
    Warn(refreshed);
    if (!refreshed.ok()) gas_timer_.Restart(now);  // to be tried again, but not at once
  }
  auto belief = Snapshot();
  gas_timer_.NotePublication(clock_());
  return belief;
}

}  // namespace plumescout::server
