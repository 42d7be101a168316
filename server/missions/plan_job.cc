// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/plan_job.h"

#include <time.h>

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

absl::Duration ThreadCpuTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return absl::DurationFromTimespec(time);
}

absl::Status Cancelled() { return absl::CancelledError("the caller gave up"); }

}  // namespace

void LogPlan(const MissionId& mission, const PlanAnswer& answer) {
  LogInfo("plan", {{"mission", mission},
                   {"robot", answer.plan.robot},
                   {"plan", absl::StrCat(answer.plan.id)},
                   {"candidates", absl::StrCat(answer.plan.candidates.size())},
                   {"length_m", absl::StrCat(answer.plan.trajectory.length_m)},
                   {"cpu_ms", absl::StrCat(absl::ToInt64Milliseconds(answer.cpu_time))}});
}

void PlanJob::Cancel() {
  cancelled_ = true;
  parts_.host->Wake();
}

void PlanJob::AwaitBelief() {
  const PlanOrder& order = parts_.order;
  BeliefRequest request;
  request.wish.robot = order.request.robot;
  request.wish.min_applied_sequence = order.min_applied_sequence;
  request.wish.lease_token = order.lease_token;
  request.deadline = order.deadline;
  request.abandoned = [self = shared_from_this()] { return self->cancelled_.load(); };
  const absl::Status posted = parts_.host->AwaitBelief(
      std::move(request),
      [self = shared_from_this()](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
        if (!belief.ok()) return self->Finish(belief.status());
        self->Enqueue(*std::move(belief));
      });
  if (!posted.ok()) Finish(posted);
}

void PlanJob::Enqueue(std::shared_ptr<const Belief> belief) {
  const absl::Status queued = parts_.pool->Submit(
      [self = shared_from_this(), belief = std::move(belief)] { self->Search(*belief); });
  if (!queued.ok()) Finish(queued);
}

void PlanJob::Search(const Belief& belief) {
  const PlanOrder& order = parts_.order;
  const SteadyTime stop_at = std::min(After(SteadyNow(), order.budget), order.deadline);
  const absl::Duration cpu_before = ThreadCpuTime();
  auto plan = parts_.host->strategy().Plan(
      belief, order.request, [&] { return cancelled_.load() || SteadyNow() >= stop_at; },
      parts_.improved);
  cpu_time_ += ThreadCpuTime() - cpu_before;
  if (cancelled_) return Finish(Cancelled());
  if (!plan.ok()) return Finish(plan.status());
  Commit(*std::move(plan));
}

void PlanJob::Commit(Plan plan) {
  const absl::Status posted = parts_.host->Post(
      [self = shared_from_this(), plan = std::move(plan)](MissionWriter& writer) mutable {
        if (self->cancelled_) return self->Finish(Cancelled());
        const auto id = writer.conduct().Commit(plan, self->parts_.order.lease_token);
        self->Committed(std::move(plan), id);
      });
  if (!posted.ok()) Finish(posted);
}

void PlanJob::Committed(Plan plan, absl::StatusOr<PlanId> id) {
  if (race_.SearchAgainAfter(id.status())) return AwaitBelief();
  if (!id.ok()) return Finish(id.status());
  plan.id = *id;
  plan.cpu_s = absl::ToDoubleSeconds(cpu_time_);
  Finish(PlanAnswer{std::move(plan), cpu_time_});
}

}  // namespace plumescout::server
