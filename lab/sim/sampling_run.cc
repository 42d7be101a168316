// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/sampling_run.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "client/plan_call.h"
#include "core/types/checker.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "core/types/trajectory.h"
#include "lab/sim/map_judge.h"

namespace plumescout::lab {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;

// Keeps the first refusal, told on the session's thread.
class Refusals {
 public:
  void Note(const client::ObservationRejected& refused) {
    absl::MutexLock lock(&mutex_);
    if (first_.ok()) first_ = refused.status;
  }
  absl::Status first() const {
    absl::MutexLock lock(&mutex_);
    return first_;
  }

 private:
  mutable absl::Mutex mutex_;
  absl::Status first_ ABSL_GUARDED_BY(mutex_);
};

class SamplingRobot {
 public:
  SamplingRobot(client::PlannerClient& planner, const Scene& truth, const DwellSensor& sensor,
                const SamplingRunOptions& options, const StopFn& stop)
      : planner_(planner),
        truth_(truth),
        sensor_(sensor),
        options_(options),
        stop_(stop),
        rng_(options.seed),
        pose_(options.start) {}

  absl::StatusOr<SamplingRecord> Run() {
    PLUMESCOUT_RETURN_IF_ERROR(Begin());
    while (!end_) PLUMESCOUT_RETURN_IF_ERROR(FollowNextPlan());
    if (report_) {
      PLUMESCOUT_RETURN_IF_ERROR(client::MakeReport(planner_, ingest_->session(), *report_));
    }
    record_.end = *end_;
    record_.elapsed_s = now_s_;
    return std::move(record_);
  }

 private:
  absl::Status Begin() {
    PLUMESCOUT_ASSIGN_OR_RETURN(client::RobotSession joined,
                                client::Join(planner_, options_.participation));
    client::IngestCallbacks callbacks{
        .rejoin = [this] { return client::Join(planner_, options_.participation); },
        .on_rejected = [this](const client::ObservationRejected& r) { refusals_.Note(r); },
        .on_link = nullptr};
    ingest_.emplace(planner_, std::move(joined), std::move(callbacks), options_.ingest);
    if (options_.first_dwell_s > 0.0) PLUMESCOUT_RETURN_IF_ERROR(Sample(options_.first_dwell_s));
    return Judge();
  }

  absl::Status FollowNextPlan() {
    if (stop_()) return End(SamplingEnd::kStopped);
    client::PlanReply answer = client::RunPlanCall(planner_, *ingest_, NextCall());
    if (answer.reported) report_.reset();
    PLUMESCOUT_RETURN_IF_ERROR(answer.plan.status());
    const Plan& plan = *answer.plan;
    ++record_.plans;
    if (options_.on_plan) options_.on_plan(now_s_, plan);
    if (plan.phase == MissionPhase::kComplete) return End(SamplingEnd::kMissionComplete);
    const double departure_s = now_s_;
    PLUMESCOUT_RETURN_IF_ERROR(Follow(plan.trajectory));
    report_ = {plan.id, end_ ? ProgressOutcome::kAborted : ProgressOutcome::kReached};
    if (!end_ && now_s_ <= departure_s) return End(SamplingEnd::kNowhereToGo);
    return judged_s_ < sampled_s_ ? Judge() : absl::OkStatus();
  }

  absl::Status End(SamplingEnd end) {
    end_ = end;
    return absl::OkStatus();
  }

  client::PlanCall NextCall() const {
    client::PlanCall job{.report = report_, .query = {}};
    job.query.request.robot = options_.participation.robot;
    job.query.request.start = pose_;
    job.query.min_applied_sequence = ingest_->statistics().last_sequence;
    job.query.budget = options_.plan_budget;
    job.query.timeout = options_.plan_timeout;
    return job;
  }

  // Until it ends, the time is up or the run is stopped.
  absl::Status Follow(const Trajectory& trajectory) {
    const double departure_s = now_s_;
    for (const Waypoint& waypoint : trajectory.waypoints) {
      const double arrival_s = departure_s + waypoint.arrival_time_s;
      if (arrival_s + waypoint.dwell_s > options_.time_limit_s) {
        const double left_s = options_.time_limit_s - departure_s;
        MoveTo(PoseAt(trajectory, left_s), options_.time_limit_s);
        return End(SamplingEnd::kTimeLimit);
      }
      MoveTo(waypoint.pose, arrival_s);
      if (!(waypoint.dwell_s > 0.0)) continue;
      PLUMESCOUT_RETURN_IF_ERROR(Sample(waypoint.dwell_s));
      if (now_s_ - judged_s_ >= options_.judge_period_s) PLUMESCOUT_RETURN_IF_ERROR(Judge());
      if (stop_()) return End(SamplingEnd::kStopped);
    }
    return absl::OkStatus();
  }

  void MoveTo(const Pose2& pose, double time_s) {
    record_.driven_m += Distance_m(pose_.position(), pose.position());
    pose_ = pose;
    now_s_ = std::max(now_s_, time_s);
  }

  // Stands and samples; the mission has the reading when this returns.
  absl::Status Sample(double dwell_s) {
    const Dwell dwell{pose_.position(), now_s_, now_s_ + dwell_s};
    now_s_ = dwell.end_s;
    sampled_s_ = now_s_;
    record_.samples.push_back({now_s_, dwell.place, sensor_(dwell, rng_), record_.driven_m});
    const std::int64_t sequence =
        ingest_->Append(options_.start_time_ns + std::llround(now_s_ * kNanosecondsPerSecond),
                        pose_, record_.samples.back().reading);
    PLUMESCOUT_RETURN_IF_ERROR(ingest_->WaitApplied(sequence, options_.plan_timeout));
    return refusals_.first();
  }

  absl::Status Judge() {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        const MapSnapshot map,
        AwaitMap(planner_, options_.participation.mission,
                 {{options_.participation.robot, ingest_->statistics().last_sequence}}));
    judged_s_ = now_s_;
    record_.errors.push_back({now_s_, FieldRmse_ppm(truth_, map, options_.background_ppm)});
    if (options_.on_map) options_.on_map(record_.errors.back(), map);
    return absl::OkStatus();
  }

  client::PlannerClient& planner_;
  const Scene& truth_;
  const DwellSensor& sensor_;
  const SamplingRunOptions& options_;
  const StopFn& stop_;

  Rng rng_;
  Pose2 pose_;
  double now_s_ = 0.0;
  double sampled_s_ = 0.0;
  double judged_s_ = 0.0;
  std::optional<client::PlanReport> report_;  // of the last plan, not yet told
  std::optional<SamplingEnd> end_;
  SamplingRecord record_;
  Refusals refusals_;
  std::optional<client::IngestSession> ingest_;  // last: its thread uses refusals_
};

}  // namespace

absl::Status Validate(const SamplingRunOptions& options) {
  constexpr double kMost_s = 1e8;
  const bool finite = std::isfinite(options.start.x_m) && std::isfinite(options.start.y_m) &&
                      std::isfinite(options.start.yaw_rad);
  if (!finite) return absl::InvalidArgumentError("start must be finite");
  return Checker()
      .InRange("first_dwell_s", options.first_dwell_s, 0.0, kMost_s)
      .Positive("time_limit_s", options.time_limit_s)
      .InRange("judge_period_s", options.judge_period_s, 0.0, kMost_s)
      .status();
}

absl::StatusOr<SamplingRecord> RunSampling(client::PlannerClient& planner, const Scene& truth,
                                           const DwellSensor& sensor,
                                           const SamplingRunOptions& options, const StopFn& stop) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  return SamplingRobot(planner, truth, sensor, options, stop).Run();
}

}  // namespace plumescout::lab
