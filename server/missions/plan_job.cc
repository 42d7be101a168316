// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/plan_job.h"

#include <time.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/plan/team/assigned_plan.h"
#include "server/base/errors.h"
#include "server/base/log.h"
#include "server/missions/mission_registry.h"

namespace plumescout::server {
namespace {

absl::Duration ThreadCpuTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return absl::DurationFromTimespec(time);
}

}  // namespace

void LogPlan(const MissionId& mission, const PlanAnswer& answer, const std::string& request_id) {
  LogInfo("plan", {{"mission", mission},
                   {"robot", answer.plan.robot},
                   {"plan", absl::StrCat(answer.plan.id)},
                   {"candidates", absl::StrCat(answer.plan.candidates.size())},
                   {"length_m", absl::StrCat(answer.plan.trajectory.length_m)},
                   {"cpu_ms", absl::StrCat(absl::ToInt64Milliseconds(answer.cpu_time))},
                   {"request_id", request_id}});
}

void PlanJob::Start() {
  listener_ = parts_.host->end_listeners().Add([weak = weak_from_this()](const absl::Status& end) {
    if (const auto self = weak.lock()) self->Finish(end);
  });
  // Whoever answered before has not seen the listener.
  if (answered_) return parts_.host->end_listeners().Remove(listener_);
  AwaitBelief();
}

void PlanJob::Cancel() {
  if (!guard_.GiveUp()) return;
  Finish(GivenUp());
  parts_.host->Wake();
}

bool PlanJob::TakeAnswer() {
  if (answered_.exchange(true)) return false;
  parts_.host->end_listeners().Remove(listener_);
  return true;
}

void PlanJob::Finish(absl::StatusOr<PlanAnswer> answer) {
  if (TakeAnswer()) parts_.done(std::move(answer));
}

void PlanJob::EndStage(Stage stage) {
  const SteadyTime now = SteadyNow();
  const absl::Duration time = absl::FromChrono(now - stage_began_);
  stage_began_ = now;
  parts_.host->metrics().NotePlanStage(stage, time);
  if (parts_.stage_times != nullptr) parts_.stage_times->Add(stage, time);
}

void PlanJob::AwaitBelief() {
  stage_began_ = SteadyNow();
  const PlanOrder& order = parts_.order;
  BeliefRequest request;
  request.wish.robot = order.request.robot;
  request.wish.min_applied_sequence = order.min_applied_sequence;
  request.wish.lease_token = order.lease_token;
  request.deadline = order.deadline;
  request.abandoned = [self = shared_from_this()] { return self->answered_.load(); };
  const absl::Status posted = parts_.host->AwaitBelief(
      std::move(request),
      [self = shared_from_this()](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
        self->EndStage(Stage::kBelief);
        if (!belief.ok()) return self->Finish(belief.status());
        self->Enqueue(*std::move(belief));
      });
  if (!posted.ok()) Finish(posted);
}

void PlanJob::Enqueue(std::shared_ptr<const Belief> belief) {
  const auto self = shared_from_this();
  const absl::Status queued =
      parts_.pool->Submit({parts_.host->id(), parts_.order.request.robot, parts_.host->tenant()},
                          {[self, belief = std::move(belief)] { self->Search(*belief); },
                           [self] { return self->answered_.load(); }});
  if (!queued.ok()) Finish(queued);
}

void PlanJob::Search(const Belief& belief) {
  EndStage(Stage::kQueue);
  const PlanOrder& order = parts_.order;
  if (std::optional<Plan> assigned = AssignedPlan(belief, order.request)) {
    return AnswerOnceDurable(*std::move(assigned));
  }
  const SteadyTime stop_at = std::min(After(SteadyNow(), order.budget), order.deadline);
  const absl::Duration cpu_before = ThreadCpuTime();
  auto plan = parts_.host->strategy().Plan(
      belief, order.request, [&] { return answered_.load() || SteadyNow() >= stop_at; },
      parts_.improved);
  cpu_time_ += ThreadCpuTime() - cpu_before;
  EndStage(Stage::kSearch);
  if (answered_) return;
  if (!plan.ok()) return Finish(plan.status());
  Commit(*std::move(plan));
}

void PlanJob::Commit(Plan plan) {
  const absl::Status posted = parts_.host->Post(
      [self = shared_from_this(), plan = std::move(plan)](MissionWriter& writer) mutable {
        if (self->answered_) return;
        if (!self->guard_.Begin()) return self->Finish(GivenUp());
        const absl::Status allowed = self->parts_.host->CheckMayPlan();
        if (!allowed.ok()) return self->Finish(allowed);
        // It may have been released while the search went on.
        const absl::Status leased = self->parts_.host->leases().CheckNotReleased(
            plan.robot, self->parts_.order.lease_token);
        if (!leased.ok()) return self->Finish(leased);
        const auto id = writer.conduct().Commit(plan, self->parts_.order.lease_token);
        self->EndStage(Stage::kCommit);
        self->Committed(std::move(plan), id);
      },
      [self = shared_from_this()](const absl::Status& status) { self->Finish(status); });
  if (!posted.ok()) Finish(posted);
}

void PlanJob::Committed(Plan plan, absl::StatusOr<PlanId> id) {
  if (race_.SearchAgainAfter(id.status())) {
    if (guard_.Undo()) return AwaitBelief();
    return Finish(GivenUp());
  }
  if (!id.ok()) return Finish(id.status());
  plan.id = *id;
  plan.cpu_s = absl::ToDoubleSeconds(cpu_time_);
  parts_.host->metrics().NotePlan(cpu_time_);
  parts_.host->latest_plans().Note(plan);
  AnswerOnceDurable(std::move(plan));
}

// After a crash the next plan must not get its number.
void PlanJob::AnswerOnceDurable(Plan plan) {
  parts_.host->WhenDurable(
      [self = shared_from_this(), plan = std::move(plan)](const absl::Status& durable) mutable {
        self->EndStage(Stage::kDurable);
        self->AnswerAfter(PlanAnswer{std::move(plan), self->cpu_time_}, durable);
      });
}

void PlanJob::AnswerAfter(PlanAnswer answer, const absl::Status& durable) {
  if (durable.ok()) return Finish(std::move(answer));
  if (parts_.late == nullptr) return Finish(durable);
  if (TakeAnswer()) parts_.late(std::move(answer), durable);
}

}  // namespace plumescout::server
