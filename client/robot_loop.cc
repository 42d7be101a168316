// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;
// A leg is given up after this multiple of its planned time, and a little for the first turn.
constexpr double kLegPatienceFactor = 3.0;
constexpr double kLegPatience_s = 10.0;
// A robot that is to drive and does not come on by so much, which is more than poses err, in such a
// time or share of the leg's stands against something that its beams do not see in its way.
constexpr double kStuck_s = 3.0;
constexpr double kStuckShare = 0.1;
constexpr double kProgress_m = 0.1;
constexpr double kProgress_rad = 0.2;
// Of a leg with less left than this a robot asks for no better plan.
constexpr double kWorthAnotherPlan_s = 0.3;
// Remainders of a wait below this are rounding.
constexpr double kTimeRounding_s = 1e-6;

std::int64_t ToNanoseconds(double duration_s) {
  return std::llround(duration_s * kNanosecondsPerSecond);
}

}  // namespace

RobotLoop::RobotLoop(PlannerClient& client, RobotDriver& driver, const RobotLoopOptions& options,
                     RobotObserver& observer)
    : client_(client),
      driver_(driver),
      options_(options),
      observer_(observer),
      notices_(client, options.ingest.backoff, options.watch, &observer_) {
  options_.follower.tick_s = options_.tick_s;
  options_.blockage.radius_m = options_.participation.radius_m;
}

absl::StatusOr<RobotResult> RobotLoop::Run(const StopFn& stop) {
  stop_ = stop;
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options_));
  PLUMESCOUT_RETURN_IF_ERROR(driver_.Drive({}));  // whatever a former life told the robot
  PLUMESCOUT_RETURN_IF_ERROR(OpenLogOnDisk());
  PLUMESCOUT_RETURN_IF_ERROR(JoinMission());
  if (!over_) {
    StartSensing();
    const absl::Status explored = Explore();
    const absl::Status finished = Finish();
    PLUMESCOUT_RETURN_IF_ERROR(explored);
    PLUMESCOUT_RETURN_IF_ERROR(finished);
  }
  return result_;
}

absl::Status RobotLoop::OpenLogOnDisk() {
  Participation& participation = options_.participation;
  participation.log_epoch = options_.new_log_epoch;
  const LogStoreOptions& store = options_.ingest.store;
  if (store.folder.empty()) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(opened_log_, OpenLog(store, participation.mission,
                                                   participation.robot, options_.new_log_epoch));
  participation.log_epoch = opened_log_.log.epoch;
  for (const absl::Status& damage : opened_log_.damage) observer_.OnDisk(damage);
  return absl::OkStatus();
}

absl::Status RobotLoop::JoinMission() {
  Backoff backoff(options_.ingest.backoff);
  const absl::Time give_up = absl::Now() + options_.link_patience;
  while (!Over()) {
    absl::StatusOr<RobotSession> joined = Join(client_, options_.participation);
    if (joined.ok()) {
      joined_ = *std::move(joined);
      // A driver that knows the time by its own pace has to hear that some has gone by.
      return options_.real_clock ? driver_.Advance(0.0) : absl::OkStatus();
    }
    const bool may_pass =
        IsRetriable(joined.status()) || ErrorReason(joined.status()) == kLeaseHeld;
    if (!may_pass || absl::Now() > give_up) return joined.status();
    observer_.OnLink(joined.status());
    absl::SleepFor(std::max(backoff.Next(), RetryDelayOf(joined.status())));
  }
  return absl::OkStatus();
}

void RobotLoop::StartSensing() {
  start_ns_ = driver_.now_ns();
  last_tick_ns_ = start_ns_ - 1;
  last_position_ = driver_.pose().position();
  const auto join_again = [this] {
    Participation participation = options_.participation;
    participation.take_over = false;
    return Join(client_, participation);
  };
  IngestCallbacks callbacks{
      .rejoin = join_again,
      .on_rejected = [this](const ObservationRejected& r) { observer_.OnRejected(r); },
      .on_link = [this](const absl::Status& status) { observer_.OnLink(status); },
      .reclaim = join_again,
      .on_rolled_back =
          [this](std::int64_t applied_sequence, std::int64_t forgotten) {
            observer_.OnRolledBack(applied_sequence, forgotten);
          },
      .on_disk = [this](const absl::Status& status) { observer_.OnDisk(status); }};
  if (options_.real_clock) {
    clock_.Note(start_ns_);
    options_.ingest.robot_clock_ns = [this] { return clock_.Now_ns(); };
  }
  ingest_.emplace(client_, *std::move(joined_), std::move(callbacks), options_.ingest,
                  std::move(opened_log_));
  bridge_.emplace(driver_, options_.rates, options_.gas_sampling,
                  [this](std::int64_t time_ns, const Pose2& pose, ObservationPayload payload) {
                    Log(time_ns, pose, std::move(payload));
                  });
}

void RobotLoop::Log(std::int64_t time_ns, const Pose2& pose, ObservationPayload payload) {
  const std::int64_t sequence = ingest_->Append(time_ns, pose, payload);
  observer_.OnLogged({sequence, time_ns, pose, std::move(payload)});
}

absl::Status RobotLoop::Explore() {
  PLUMESCOUT_RETURN_IF_ERROR(Stand(options_.look_around_s));
  while (!Over()) {
    const absl::Status health = ingest_->health();
    if (ErrorReason(health) == reason::kMissionFinished) EndRun(RobotEnd::kMissionFinished);
    if (over_) break;
    PLUMESCOUT_RETURN_IF_ERROR(health);
    if (leg_.has_value() && !pending_.valid() && !WantsBetterPlan()) {
      PLUMESCOUT_RETURN_IF_ERROR(Tick(options_.tick_s));
    } else if ((notices_.standing().paused && !pending_.valid()) || GoesOnWithoutLink()) {
      PLUMESCOUT_RETURN_IF_ERROR(Stand(options_.tick_s));
    } else if (options_.pacing == Pacing::kLockstep) {
      PLUMESCOUT_RETURN_IF_ERROR(AskInLockstep());
    } else {
      PLUMESCOUT_RETURN_IF_ERROR(AskWhileRunning());
    }
  }
  return absl::OkStatus();
}

absl::Status RobotLoop::Finish() {
  absl::Status status = driver_.Drive({});
  if (leg_.has_value()) status.Update(EndLeg(ProgressOutcome::kAborted));
  DropPending();
  const bool drained = AwaitApplied(options_.drain_timeout);
  // What is not durable by now shows in the statistics; a log on disk keeps it.
  if (drained) {
    ingest_->WaitSafe(ingest_->statistics().last_sequence, options_.drain_timeout).IgnoreError();
  }
  if (report_.has_value() && drained) {
    status.Update(MakeReport(client_, ingest_->session(), *report_));
  }
  result_.elapsed_s = elapsed_s();
  result_.ingest = ingest_->statistics();
  return status;
}

// A plan that comes too late to be driven is given up, or its goal would stay claimed.
void RobotLoop::DropPending() {
  if (!pending_.valid()) return;
  const PlanReply answer = pending_.get();
  if (answer.reported) report_.reset();
  if (answer.plan.ok() && answer.plan->chosen >= 0) {
    report_ = PlanReport{.plan = answer.plan->id, .outcome = ProgressOutcome::kAborted};
  }
}

// Acts, senses, then lets time go by. A leg that ends here leaves no time to go by: the next plan
// is asked for at this very instant.
absl::Status RobotLoop::Tick(double duration_s) {
  if (leg_.has_value()) PLUMESCOUT_RETURN_IF_ERROR(leg_->motion->Step(driver_));
  const bool standing = !leg_.has_value() || leg_->motion->standing();
  if (options_.real_clock) clock_.Note(driver_.now_ns());
  PLUMESCOUT_RETURN_IF_ERROR(bridge_->Poll(standing));
  if (const auto status = status_reports_.Take(driver_.TakeStatus(), driver_.now_ns())) {
    Log(driver_.now_ns(), driver_.pose(), *status);
  }
  const bool world_waits = options_.pacing == Pacing::kLockstep && !GoesOnWithoutLink();
  if (world_waits) AwaitApplied(options_.link_patience);
  NoteProgress();
  HeedNotices();
  if (const auto outcome = LegOutcome(); outcome.has_value()) return EndLeg(*outcome);
  return driver_.Advance(duration_s);
}

absl::Status RobotLoop::Stand(double duration_s) {
  double left_s = duration_s;
  while (left_s > kTimeRounding_s && !Over()) {
    const double step_s = std::min(left_s, options_.tick_s);
    PLUMESCOUT_RETURN_IF_ERROR(Tick(step_s));
    left_s -= step_s;
  }
  return absl::OkStatus();
}

void RobotLoop::HeedNotices() {
  notices_.Poll(ingest_->session(), absl::Now());
  if (notices_.standing().finished) EndRun(RobotEnd::kMissionFinished);
}

void RobotLoop::NoteProgress() {
  const std::int64_t now_ns = driver_.now_ns();
  if (now_ns == last_tick_ns_) return;
  last_tick_ns_ = now_ns;
  const Pose2 pose = driver_.pose();
  NoteProgressOfLeg(pose, now_ns);
  result_.distance_m += Distance_m(last_position_, pose.position());
  last_position_ = pose.position();
  observer_.OnTick({.time_ns = now_ns,
                    .elapsed_s = elapsed_s(),
                    .pose = pose,
                    .plan = leg_.has_value() ? leg_->plan : 0,
                    .ingest = ingest_->statistics()});
}

void RobotLoop::NoteProgressOfLeg(const Pose2& pose, std::int64_t now_ns) {
  if (!leg_.has_value()) return;
  const double left_m = LengthOf_m(leg_->motion->PathAhead(pose));
  const bool comes_on = leg_->left_m - left_m >= kProgress_m;
  const bool turns = std::abs(WrapAngle_rad(pose.yaw_rad - leg_->yaw_rad)) >= kProgress_rad;
  if (comes_on) was_stuck_ = false;
  if (comes_on || turns || leg_->motion->standing()) {
    leg_->progressed_ns = now_ns;
    leg_->left_m = left_m;
    leg_->yaw_rad = pose.yaw_rad;
  }
  leg_->stuck = now_ns - leg_->progressed_ns > leg_->patience_ns;
}

// How the leg has ended; nothing while it goes on, or without one.
std::optional<ProgressOutcome> RobotLoop::LegOutcome() const {
  if (!leg_.has_value()) return std::nullopt;
  if (leg_->motion->done()) return ProgressOutcome::kReached;
  if (IsToldToStop()) return ProgressOutcome::kAborted;
  // A clock that was set back says nothing of how long the leg has taken.
  const std::int64_t now_ns = driver_.now_ns();
  if (now_ns > leg_->deadline_ns || now_ns < leg_->begun_ns) return ProgressOutcome::kAborted;
  // Stuck twice without having come on: what is in the way is not on the way to the goal.
  if (leg_->stuck) return was_stuck_ ? ProgressOutcome::kAborted : ProgressOutcome::kBlocked;
  // Who stands by plan, perhaps for another robot to pass, drives into nothing yet.
  const std::optional<Scan>& scan = bridge_->latest_scan();
  const bool blocked = !leg_->motion->standing() && scan.has_value() &&
                       PathBlocked(*scan, bridge_->latest_scan_pose(),
                                   leg_->motion->PathAhead(driver_.pose()), options_.blockage);
  return blocked ? std::optional(ProgressOutcome::kBlocked) : std::nullopt;
}

absl::Status RobotLoop::EndLeg(ProgressOutcome outcome) {
  report_ = PlanReport{.plan = leg_->plan, .outcome = outcome};
  was_stuck_ = was_stuck_ || leg_->stuck;
  if (outcome == ProgressOutcome::kAborted && IsToldToStop()) ++result_.invalidated;
  leg_.reset();
  int& count = outcome == ProgressOutcome::kReached   ? result_.reached
               : outcome == ProgressOutcome::kBlocked ? result_.blocked
                                                      : result_.aborted;
  ++count;
  observer_.OnReport(report_->plan, outcome);
  return driver_.Drive({});
}

// Whether what has been learned since the leg began may be worth another. Not for the last bit of
// it, nor against what the robot was told; nor where it waits for others, who reckon with it there.
bool RobotLoop::WantsBetterPlan() const {
  const double gone_s = SecondsSince(leg_->begun_ns);
  const bool pays = leg_->replan_after_s > 0.0 && gone_s >= leg_->replan_after_s &&
                    leg_->trajectory.duration_s - gone_s >= kWorthAnotherPlan_s;
  return pays && !leg_->homeward && !leg_->motion->standing() && !leg_->motion->done() &&
         !notices_.standing().paused && !GoesOnWithoutLink();
}

// Where the robot will be, on its way, when it has the answer to what it asks now.
Pose2 RobotLoop::PoseWhenAnswered() const {
  if (!leg_.has_value()) return driver_.pose();
  const double takes_s =
      options_.pacing == Pacing::kLockstep ? options_.plan_latency_s : answer_takes_s_;
  const auto nearest = FindNearest(leg_->trajectory, driver_.pose().position());
  return nearest ? PoseAt(leg_->trajectory, nearest->time_s + takes_s) : driver_.pose();
}

absl::Status RobotLoop::AskInLockstep() {
  Backoff backoff(options_.ingest.backoff);
  const absl::Time give_up = absl::Now() + options_.link_patience;
  while (!Over()) {
    PlanReply answer = RunPlanCall(client_, *ingest_, NextJob());
    if (answer.reported) report_.reset();
    const absl::Status status = answer.plan.status();
    if (status.ok()) {
      PLUMESCOUT_RETURN_IF_ERROR(Stand(options_.plan_latency_s));
      return Digest(std::move(answer));
    }
    observer_.OnPlanFailure(status);
    PLUMESCOUT_RETURN_IF_ERROR(ingest_->health());
    if (!MayAskAgain(status) || absl::Now() > give_up) return status;
    const bool homeless = ErrorReason(status) == kLeaseSuperseded;
    if (absl::IsFailedPrecondition(status) && !homeless) {  // the belief lacks what readings bring
      return Stand(options_.stand_before_retry_s);
    }
    absl::SleepFor(std::max(backoff.Next(), RetryDelayOf(status)));  // the world waits
  }
  return absl::OkStatus();
}

absl::Status RobotLoop::AskWhileRunning() {
  if (!pending_.valid()) {
    pending_ = std::async(std::launch::async, [this, job = NextJob()]() mutable {
      return RunPlanCall(client_, *ingest_, std::move(job));
    });
  }
  if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return Tick(std::min(options_.tick_s, options_.answer_look_s));
  }
  PlanReply answer = pending_.get();
  if (answer.reported) report_.reset();
  if (answer.plan.ok()) return Digest(std::move(answer));
  observer_.OnPlanFailure(answer.plan.status());
  if (!MayAskAgain(answer.plan.status())) return answer.plan.status();
  return Stand(options_.stand_before_retry_s);
}

PlanCall RobotLoop::NextJob() {
  asked_ns_ = driver_.now_ns();
  asked_on_the_way_ = leg_.has_value();
  asked_pose_ = PoseWhenAnswered();
  asked_homeward_ = notices_.standing().ordered_home;
  PlanCall job{.report = report_, .query = {}};
  job.query.request.robot = options_.participation.robot;
  job.query.request.start = InMission(options_.participation.frame, asked_pose_);
  job.query.request.max_edge_evaluations = options_.max_edge_evaluations;
  job.query.min_applied_sequence = ingest_->statistics().last_sequence;
  job.query.budget = options_.plan_budget;
  job.query.timeout = options_.plan_timeout;
  return job;
}

absl::Status RobotLoop::Digest(PlanReply answer) {
  const Plan& plan = *answer.plan;
  ++result_.plans;
  answer_takes_s_ = absl::ToDoubleSeconds(answer.rpc_wall);
  if (asked_on_the_way_) {  // the plan before is no more, nor is there anything to tell of it
    report_.reset();
    if (leg_.has_value()) ++result_.replaced;
    leg_.reset();
  }
  observer_.OnPlan({.time_ns = asked_ns_,
                    .elapsed_s = static_cast<double>(asked_ns_ - start_ns_) / kNanosecondsPerSecond,
                    .pose = asked_pose_,
                    .plan = plan,
                    .rpc_wall = answer.rpc_wall});
  if (plan.phase == MissionPhase::kComplete) {
    EndRun(RobotEnd::kMissionComplete);
    return absl::OkStatus();
  }
  return Depart(plan);
}

absl::Status RobotLoop::Depart(const Plan& plan) {
  if (plan.trajectory.waypoints.empty() || !(plan.trajectory.duration_s > 0.0)) {
    PLUMESCOUT_RETURN_IF_ERROR(driver_.Drive({}));
    return Stand(options_.stand_before_retry_s);
  }
  const std::int64_t now_ns = driver_.now_ns();
  const Trajectory trajectory = InOwnFrame(plan.trajectory);
  const double patience_s = kLegPatience_s + kLegPatienceFactor * plan.trajectory.duration_s;
  leg_ = Leg{
      .plan = plan.id,
      .trajectory = trajectory,
      .motion = StartMotion(options_.following, trajectory, options_.follower, now_ns),
      .begun_ns = now_ns,
      .deadline_ns = now_ns + ToNanoseconds(patience_s),
      .progressed_ns = now_ns,
      .yaw_rad = driver_.pose().yaw_rad,
      .patience_ns = ToNanoseconds(std::max(kStuck_s, kStuckShare * plan.trajectory.duration_s)),
      .homeward = asked_homeward_,
      .replan_after_s = options_.replan_period_s.value_or(plan.replan_after_s)};
  leg_->left_m = LengthOf_m(leg_->motion->PathAhead(driver_.pose()));
  return absl::OkStatus();
}

Trajectory RobotLoop::InOwnFrame(Trajectory trajectory) const {
  for (Waypoint& waypoint : trajectory.waypoints) {
    waypoint.pose = InRobot(options_.participation.frame, waypoint.pose);
  }
  return trajectory;
}

// Latches: a run that is over stays over.
bool RobotLoop::Over() {
  if (over_) return true;
  const bool time_up = options_.time_limit_s > 0.0 && bridge_.has_value() &&
                       elapsed_s() > options_.time_limit_s - kTimeRounding_s;
  if (time_up) result_.end = RobotEnd::kTimeLimit;
  over_ = time_up || stop_();
  return over_;
}

double RobotLoop::SecondsSince(std::int64_t time_ns) const {
  return static_cast<double>(driver_.now_ns() - time_ns) / kNanosecondsPerSecond;
}

}  // namespace plumescout::client
