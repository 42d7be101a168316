// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/local/local_mission.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr int kMaxConflicts = 1;  // searches after the first that lost a race for a goal

// A robot that no observation has reached may have no log yet.
std::int64_t AppliedSequence(const Mission& mission, const RobotId& robot) {
  return mission.AppliedSequence(robot).value_or(0);
}

}  // namespace

absl::StatusOr<std::shared_ptr<LocalMission>> LocalMission::Create(const MissionOptions& mission,
                                                                   const LocalOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<Mission> state, Mission::Create(mission));
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<const Strategy> strategy,
                              MakeStrategy(mission.planning, options.path_planners));
  return std::make_shared<LocalMission>(std::move(state), std::move(strategy), options);
}

LocalMission::LocalMission(std::unique_ptr<Mission> mission,
                           std::unique_ptr<const Strategy> strategy, const LocalOptions& options)
    : options_(options), strategy_(std::move(strategy)), mission_(std::move(mission)) {}

absl::StatusOr<client::RobotSession> LocalMission::Register(const RobotRegistered& robot,
                                                            bool take_over) {
  absl::MutexLock lock(&mutex_);
  const auto held = leases_.find(robot.robot);
  if (held != leases_.end() && !take_over) {
    const bool used = options_.clock() - held->second.last_use < options_.lease_hold;
    if (held->second.stream != 0 || used) {
      return absl::FailedPreconditionError(
          absl::StrCat("LEASE_HELD: another client writes the log of robot \"", robot.robot, "\""));
    }
  }
  RobotRegistered granted = robot;
  granted.lease_token = last_token_ + 1;
  PLUMESCOUT_RETURN_IF_ERROR(Apply(granted).status());
  ++last_token_;
  leases_[robot.robot] = {.last_use = options_.clock(), .stream = 0};
  client::RobotSession session;
  session.robot = robot.robot;
  session.lease_token = last_token_;
  session.ingest = State(robot.robot);
  return session;
}

absl::Status LocalMission::Remove(const RobotId& robot, std::int64_t lease_token, bool force) {
  absl::MutexLock lock(&mutex_);
  const absl::Status lease = CheckLease(robot, lease_token);
  if (absl::IsNotFound(lease) || !force) PLUMESCOUT_RETURN_IF_ERROR(lease);
  PLUMESCOUT_RETURN_IF_ERROR(Apply(RobotRemoved{robot}).status());
  leases_.erase(robot);
  return absl::OkStatus();
}

absl::StatusOr<std::int64_t> LocalMission::OpenStream(const RobotId& robot,
                                                      std::int64_t lease_token) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(robot, lease_token));
  leases_[robot].stream = ++last_stream_;
  return last_stream_;
}

absl::StatusOr<client::IngestState> LocalMission::StreamState(const RobotId& robot,
                                                              std::int64_t lease_token,
                                                              std::int64_t stream) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckStream(robot, lease_token, stream));
  return State(robot);
}

void LocalMission::CloseStream(const RobotId& robot, std::int64_t stream) {
  absl::MutexLock lock(&mutex_);
  const auto lease = leases_.find(robot);
  if (lease == leases_.end() || lease->second.stream != stream) return;
  lease->second = {.last_use = options_.clock(), .stream = 0};
}

absl::Status LocalMission::AwaitStreamEnd(const RobotId& robot, std::int64_t lease_token,
                                          std::int64_t stream, absl::Duration timeout) {
  absl::MutexLock lock(&mutex_);
  const auto ended = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return !CheckStream(robot, lease_token, stream).ok();
  };
  if (!mutex_.AwaitWithTimeout(absl::Condition(&ended), timeout)) {
    return absl::DeadlineExceededError("no reply yet");
  }
  return CheckStream(robot, lease_token, stream);
}

absl::Status LocalMission::Ingest(const RobotId& robot, std::int64_t lease_token,
                                  std::int64_t stream, const std::vector<Observation>& batch,
                                  std::vector<client::ObservationRejected>& rejected) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckStream(robot, lease_token, stream));
  const std::int64_t credit = State(robot).credit_sequence;
  for (const Observation& observation : batch) {
    if (observation.sequence > credit) {
      return absl::ResourceExhaustedError(absl::StrCat(
          "CREDIT_EXCEEDED: sequence ", observation.sequence, " is beyond the credit, ", credit));
    }
    PLUMESCOUT_RETURN_IF_ERROR(IngestOne(robot, observation, rejected));
  }
  return absl::OkStatus();
}

// An error if the log cannot go on.
absl::Status LocalMission::IngestOne(const RobotId& robot, const Observation& observation,
                                     std::vector<client::ObservationRejected>& rejected) {
  absl::StatusOr<Applied> applied = Apply(ObservationReceived{robot, observation});
  if (absl::IsAlreadyExists(applied.status())) return absl::OkStatus();
  PLUMESCOUT_RETURN_IF_ERROR(applied.status());
  if (!applied->observation.ok()) {
    rejected.push_back({observation.sequence, std::move(applied->observation)});
  }
  return KeepGasUp();
}

absl::StatusOr<Plan> LocalMission::NextPlan(const client::PlanQuery& query) {
  const absl::Time deadline = options_.clock() + query.timeout;
  const absl::Duration budget =
      query.budget > absl::ZeroDuration() ? query.budget : options_.default_budget;
  for (int conflicts = 0;; ++conflicts) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<const Belief> belief,
                                BeliefFor(query, deadline));
    const absl::Time stop_at = std::min(options_.clock() + budget, deadline);
    PLUMESCOUT_ASSIGN_OR_RETURN(Plan plan, strategy_->Plan(*belief, query.request, [&] {
      return options_.clock() >= stop_at;
    }));
    const absl::StatusOr<PlanId> id = Commit(plan, query.lease_token);
    if (absl::IsAborted(id.status()) && conflicts < kMaxConflicts) continue;
    PLUMESCOUT_RETURN_IF_ERROR(id.status());
    plan.id = *id;
    return plan;
  }
}

absl::StatusOr<std::shared_ptr<const Belief>> LocalMission::BeliefFor(
    const client::PlanQuery& query, absl::Time deadline) {
  absl::MutexLock lock(&mutex_);
  const RobotId& robot = query.request.robot;
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(robot, query.lease_token));
  const auto settled = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return AppliedSequence(*mission_, robot) >= query.min_applied_sequence ||
           !CheckLease(robot, query.lease_token).ok();
  };
  if (!mutex_.AwaitWithTimeout(absl::Condition(&settled), deadline - options_.clock())) {
    return absl::DeadlineExceededError(absl::StrCat("observation ", query.min_applied_sequence,
                                                    " is not applied yet: the log ends at ",
                                                    AppliedSequence(*mission_, robot)));
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(robot, query.lease_token));
  return RefreshedBelief();
}

absl::StatusOr<PlanId> LocalMission::Commit(const Plan& plan, std::int64_t lease_token) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(plan.robot, lease_token));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied, Apply(PlanIssued{plan}));
  return applied.plan_id;
}

absl::Status LocalMission::Report(const ProgressReported& report, std::int64_t lease_token) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(report.robot, lease_token));
  const absl::Status status = Apply(report).status();
  return absl::IsAlreadyExists(status) ? absl::OkStatus() : status;
}

absl::StatusOr<std::shared_ptr<const Belief>> LocalMission::FreshBelief() {
  absl::MutexLock lock(&mutex_);
  return RefreshedBelief();
}

std::shared_ptr<const Belief> LocalMission::Snapshot() const {
  absl::MutexLock lock(&mutex_);
  return mission_->Snapshot();
}

void LocalMission::Close() {
  absl::MutexLock lock(&mutex_);
  closed_ = true;
}

absl::StatusOr<std::shared_ptr<const Belief>> LocalMission::RefreshedBelief() {
  if (mission_->posterior_stale()) PLUMESCOUT_RETURN_IF_ERROR(Refresh());
  return mission_->Snapshot();
}

absl::Status LocalMission::KeepGasUp() {
  if (mission_->adoption_due()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied, Apply(EpochAdopted{}));
    PLUMESCOUT_RETURN_IF_ERROR(applied.posterior);
  }
  if (mission_->refresh_due()) PLUMESCOUT_RETURN_IF_ERROR(Refresh());
  if (!mission_->epoch_due()) return absl::OkStatus();
  return Apply(EpochBegun{mission_->sample_time_ns()}).status();
}

absl::Status LocalMission::Refresh() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied,
                              Apply(PosteriorRefreshed{mission_->sample_time_ns()}));
  return applied.posterior;
}

absl::StatusOr<Applied> LocalMission::Apply(EventBody body) {
  PLUMESCOUT_ASSIGN_OR_RETURN(Applied applied, mission_->Apply(body));
  if (options_.on_event) options_.on_event({applied.revision, std::move(body)});
  return applied;
}

absl::Status LocalMission::CheckLease(const RobotId& robot, std::int64_t lease_token) {
  if (closed_) return absl::NotFoundError("MISSION_NOT_FOUND: the mission is deleted");
  const auto lease = leases_.find(robot);
  if (lease == leases_.end()) {
    return absl::NotFoundError(absl::StrCat("ROBOT_NOT_FOUND: robot \"", robot, "\""));
  }
  if (mission_->LeaseToken(robot).value_or(0) != lease_token) {
    return absl::FailedPreconditionError(absl::StrCat(
        "LEASE_SUPERSEDED: a newer registration writes the log of robot \"", robot, "\""));
  }
  lease->second.last_use = options_.clock();
  return absl::OkStatus();
}

absl::Status LocalMission::CheckStream(const RobotId& robot, std::int64_t lease_token,
                                       std::int64_t stream) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckLease(robot, lease_token));
  if (leases_[robot].stream == stream) return absl::OkStatus();
  return absl::AbortedError(
      absl::StrCat("STREAM_REPLACED: a newer stream took over the log of robot \"", robot, "\""));
}

client::IngestState LocalMission::State(const RobotId& robot) const {
  const std::int64_t applied = AppliedSequence(*mission_, robot);
  return {.applied_sequence = applied,
          .durable_sequence = 0,  // nothing here survives the process
          .credit_sequence = applied + options_.credit_window,
          .revision = mission_->revision()};
}

}  // namespace plumescout::lab
