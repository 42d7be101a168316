// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/local/local_mission.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/mission/conduct/clock_offset.h"
#include "core/mission/conduct/commit_race.h"
#include "core/mission/conduct/ingest.h"
#include "core/plan/team/assigned_plan.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

// The process never restarts under its clients: tokens may start anywhere.
constexpr std::int64_t kFirstLeaseToken = 1;

}  // namespace

absl::StatusOr<std::shared_ptr<LocalMission>> LocalMission::Create(const MissionOptions& mission,
                                                                   const LocalOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<Mission> state, Mission::Create(mission));
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<const Strategy> strategy,
                              MakeStrategy(mission.planning, options.path_planners));
  if (options.replace_strategy) {
    strategy = options.replace_strategy(mission.planning, std::move(strategy));
  }
  return std::make_shared<LocalMission>(std::move(state), std::move(strategy), options);
}

LocalMission::LocalMission(std::unique_ptr<Mission> mission,
                           std::unique_ptr<const Strategy> strategy, const LocalOptions& options)
    : options_(options),
      strategy_(std::move(strategy)),
      conduct_(std::move(mission), this),
      leases_(absl::ToInt64Nanoseconds(options.lease_hold), kFirstLeaseToken) {}

void LocalMission::OnEvent(const Event& event, const Applied&) {
  if (options_.on_event) options_.on_event(event);
}

absl::StatusOr<client::RobotSession> LocalMission::Register(const Registration& wish) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(closed_);
  LeasesAt leases(leases_, Now_ns());
  PLUMESCOUT_ASSIGN_OR_RETURN(const Registered registered, conduct_.Register(wish, leases));
  client::RobotSession session;
  session.robot = wish.robot;
  session.lease_token = registered.lease_token;
  session.ingest = State(registered.position);
  session.log_continues = registered.log_continues;
  return session;
}

absl::Status LocalMission::Remove(const Removal& wish) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(closed_);
  LeasesAt leases(leases_, Now_ns());
  return conduct_.Remove(wish, leases).status();
}

absl::StatusOr<StreamId> LocalMission::OpenStream(const RobotId& robot, std::int64_t lease_token) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(closed_);
  PLUMESCOUT_ASSIGN_OR_RETURN(const LeaseBook::OpenedStream opened,
                              leases_.OpenStream(robot, lease_token, Now_ns()));
  return opened.stream;
}

absl::StatusOr<client::IngestState> LocalMission::StreamState(const RobotId& robot,
                                                              std::int64_t lease_token,
                                                              StreamId stream) const {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckStream(robot, lease_token, stream));
  PLUMESCOUT_ASSIGN_OR_RETURN(const LogPosition position, conduct_.Position(robot));
  return State(position);
}

absl::Status LocalMission::NoteClock(const RobotId& robot, std::int64_t lease_token,
                                     std::int64_t sent_ns) {
  if (!options_.mission_clock_ns) return absl::OkStatus();
  const std::int64_t offset_ns = options_.mission_clock_ns() - sent_ns;
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(closed_);
  PLUMESCOUT_RETURN_IF_ERROR(leases_.Check(robot, lease_token));
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotState state, conduct_.mission().StateOf(robot));
  return conduct_.NoteClock({robot, SettledOffset_ns(offset_ns, state.clock_offset_ns)},
                            lease_token);
}

void LocalMission::CloseStream(const RobotId& robot, StreamId stream) {
  absl::MutexLock lock(&mutex_);
  leases_.CloseStream(robot, stream, Now_ns());
}

absl::Status LocalMission::AwaitStreamEnd(const RobotId& robot, std::int64_t lease_token,
                                          StreamId stream, absl::Duration timeout) {
  absl::MutexLock lock(&mutex_);
  const auto ended = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return !CheckStream(robot, lease_token, stream).ok();
  };
  if (!mutex_.AwaitWithTimeout(absl::Condition(&ended), timeout)) {
    return absl::DeadlineExceededError("no reply yet");
  }
  return CheckStream(robot, lease_token, stream);
}

absl::Status LocalMission::Ingest(const RobotId& robot, std::int64_t lease_token, StreamId stream,
                                  const std::vector<Observation>& batch,
                                  std::vector<client::ObservationRejected>& rejected) {
  std::vector<IncomingObservation> incoming;
  incoming.reserve(batch.size());
  for (const Observation& observation : batch) incoming.push_back({observation, absl::OkStatus()});
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckStream(robot, lease_token, stream));
  PLUMESCOUT_ASSIGN_OR_RETURN(const LogPosition position, conduct_.Position(robot));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckCredit(incoming, CreditSequence(position, options_.credit_window)));
  IngestResult result = conduct_.Ingest(robot, lease_token, std::move(incoming));
  for (RefusedObservation& refused : result.refused) {
    rejected.push_back({refused.sequence, std::move(refused.status)});
  }
  return result.status;
}

absl::StatusOr<Plan> LocalMission::NextPlan(const client::PlanQuery& query) {
  const absl::Time deadline = options_.clock() + query.timeout;
  const absl::Duration budget =
      query.budget > absl::ZeroDuration() ? query.budget : options_.default_budget;
  for (CommitRace race;;) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<const Belief> belief,
                                BeliefFor(query, deadline));
    if (std::optional<Plan> assigned = AssignedPlan(*belief, query.request)) {
      return *std::move(assigned);
    }
    const absl::Time stop_at = std::min(options_.clock() + budget, deadline);
    PLUMESCOUT_ASSIGN_OR_RETURN(Plan plan, strategy_->Plan(*belief, query.request, [&] {
      return options_.clock() >= stop_at;
    }));
    absl::MutexLock lock(&mutex_);
    PLUMESCOUT_RETURN_IF_ERROR(closed_);
    const absl::StatusOr<PlanId> id = conduct_.Commit(plan, query.lease_token);
    if (race.SearchAgainAfter(id.status())) continue;
    PLUMESCOUT_RETURN_IF_ERROR(id.status());
    plan.id = *id;
    return plan;
  }
}

absl::StatusOr<CommittedTeam> LocalMission::PlanForTeam(const TeamRequest& request,
                                                        absl::Duration budget) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<const Belief> belief, FreshBelief());
  const absl::Time stop_at =
      options_.clock() + (budget > absl::ZeroDuration() ? budget : options_.default_budget);
  PLUMESCOUT_ASSIGN_OR_RETURN(TeamPlan team, PlanTeam(*strategy_, *belief, request,
                                                      [&] { return options_.clock() >= stop_at; }));
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(closed_);
  return CommitTeam(std::move(team), conduct_);
}

absl::StatusOr<std::shared_ptr<const Belief>> LocalMission::BeliefFor(
    const client::PlanQuery& query, absl::Time deadline) {
  const BeliefWish wish{.robot = query.request.robot,
                        .min_applied_sequence = query.min_applied_sequence,
                        .lease_token = query.lease_token};
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(UseLease(wish.robot, query.lease_token));
  const auto settled = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return !closed_.ok() || conduct_.Verdict(wish).has_value();
  };
  mutex_.AwaitWithTimeout(absl::Condition(&settled), deadline - options_.clock());
  PLUMESCOUT_RETURN_IF_ERROR(closed_);
  const std::optional<absl::Status> verdict = conduct_.Verdict(wish);
  if (!verdict.has_value()) return conduct_.WaitedInVain(wish);
  PLUMESCOUT_RETURN_IF_ERROR(*verdict);
  return conduct_.BeliefFor(wish);
}

absl::Status LocalMission::Report(const ProgressReported& report, std::int64_t lease_token) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(UseLease(report.robot, lease_token));
  return conduct_.Report(report, lease_token).status();
}

absl::StatusOr<RobotNews> LocalMission::NewsOf(const RobotId& robot, std::int64_t lease_token) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(closed_);
  PLUMESCOUT_RETURN_IF_ERROR(leases_.Check(robot, lease_token));
  LookAtPlans();
  PlanNews plan = news_.PlanNewsOf(robot);
  RobotNews news{.revision = conduct_.mission().revision(),
                 .standing = news_.StandingOf(robot),
                 .invalidated = std::move(plan.invalidated),
                 .assigned = plan.assigned};
  news.standing->leased = true;
  return news;
}

bool LocalMission::AwaitChange(std::int64_t revision, absl::Time deadline,
                               const std::atomic<bool>& cancelled) {
  absl::MutexLock lock(&mutex_);
  const auto changed = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return !closed_.ok() || cancelled || conduct_.mission().revision() != revision;
  };
  return mutex_.AwaitWithDeadline(absl::Condition(&changed), deadline);
}

void LocalMission::LookAtPlans() {
  const std::int64_t now_ns = conduct_.mission().sample_time_ns();
  if (now_ns < news_.next_look_ns()) return;
  news_.NoteLook(now_ns);
  const std::shared_ptr<const Belief> belief = conduct_.Snapshot();
  news_.Follow(*belief);
  for (const PlanWatch::News& told : plan_watch_.Look(*belief)) {
    news_.Note(told.robot, told.notice);
  }
}

absl::StatusOr<std::shared_ptr<const Belief>> LocalMission::FreshBelief() {
  absl::MutexLock lock(&mutex_);
  return conduct_.FreshBelief();
}

std::shared_ptr<const Belief> LocalMission::Snapshot() const {
  absl::MutexLock lock(&mutex_);
  return conduct_.Snapshot();
}

void LocalMission::Close(const absl::Status& status) {
  absl::MutexLock lock(&mutex_);
  closed_ = status;
}

absl::Status LocalMission::UseLease(const RobotId& robot, std::int64_t lease_token) {
  PLUMESCOUT_RETURN_IF_ERROR(closed_);
  return leases_.Use(robot, lease_token, Now_ns());
}

absl::Status LocalMission::CheckStream(const RobotId& robot, std::int64_t lease_token,
                                       StreamId stream) const {
  PLUMESCOUT_RETURN_IF_ERROR(closed_);
  return leases_.CheckStream(robot, lease_token, stream);
}

client::IngestState LocalMission::State(const LogPosition& position) const {
  return {.applied_sequence = position.applied_sequence,
          .durable_sequence = 0,  // nothing here survives the process
          .credit_sequence = CreditSequence(position, options_.credit_window),
          .revision = position.revision};
}

}  // namespace plumescout::lab
