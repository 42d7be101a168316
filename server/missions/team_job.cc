// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/team_job.h"

#include <algorithm>
#include <utility>

#include "core/mission/conduct/conduct_errors.h"
#include "server/base/errors.h"
#include "server/missions/mission_registry.h"

namespace plumescout::server {
void TeamJob::Start() {
  listener_ = parts_.host->end_listeners().Add([weak = weak_from_this()](const absl::Status& end) {
    if (const auto self = weak.lock()) self->Finish(end);
  });
  // Whoever answered before has not seen the listener.
  if (answered_) return parts_.host->end_listeners().Remove(listener_);
  AwaitBelief();
}

void TeamJob::Cancel() {
  if (!guard_.GiveUp()) return;
  Finish(GivenUp());
  parts_.host->Wake();
}

bool TeamJob::TakeAnswer() {
  if (answered_.exchange(true)) return false;
  parts_.host->end_listeners().Remove(listener_);
  return true;
}

void TeamJob::Finish(absl::StatusOr<CommittedTeam> answer) {
  if (TakeAnswer()) parts_.done(std::move(answer));
}

void TeamJob::AwaitBelief() {
  BeliefRequest request;
  request.deadline = parts_.order.deadline;
  request.abandoned = [self = shared_from_this()] { return self->answered_.load(); };
  const absl::Status posted = parts_.host->AwaitBelief(
      std::move(request),
      [self = shared_from_this()](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
        if (!belief.ok()) return self->Finish(belief.status());
        self->Enqueue(*std::move(belief));
      });
  if (!posted.ok()) Finish(posted);
}

void TeamJob::Enqueue(std::shared_ptr<const Belief> belief) {
  const auto self = shared_from_this();
  const absl::Status queued =
      parts_.pool->Submit({parts_.host->id(), "", parts_.host->tenant()},
                          {[self, belief = std::move(belief)] { self->Search(*belief); },
                           [self] { return self->answered_.load(); }});
  if (!queued.ok()) Finish(queued);
}

void TeamJob::Search(const Belief& belief) {
  const TeamOrder& order = parts_.order;
  for (const RobotId& robot : order.request.robots) {
    if (!belief.robots.contains(robot)) return Finish(RobotNotFound(robot));
  }
  const SteadyTime stop_at = std::min(After(SteadyNow(), order.budget), order.deadline);
  auto team = PlanTeam(parts_.host->strategy(), belief, order.request,
                       [&] { return answered_.load() || SteadyNow() >= stop_at; });
  if (answered_) return;
  if (!team.ok()) return Finish(team.status());
  Commit(*std::move(team));
}

void TeamJob::Commit(TeamPlan team) {
  const absl::Status posted = parts_.host->Post(
      [self = shared_from_this(), team = std::move(team)](MissionWriter& writer) mutable {
        if (self->answered_) return;
        if (!self->guard_.Begin()) return self->Finish(GivenUp());
        const absl::Status allowed = self->parts_.host->CheckMayPlan();
        if (!allowed.ok()) return self->Finish(allowed);
        CommittedTeam answer = CommitTeam(std::move(team), writer.conduct());
        for (const Plan& plan : answer.plans) self->parts_.host->latest_plans().Note(plan);
        self->parts_.host->WhenDurable(
            [self, answer = std::move(answer)](const absl::Status& durable) mutable {
              self->AnswerAfter(std::move(answer), durable);
            });
      },
      [self = shared_from_this()](const absl::Status& status) { self->Finish(status); });
  if (!posted.ok()) Finish(posted);
}

void TeamJob::AnswerAfter(CommittedTeam answer, const absl::Status& durable) {
  if (durable.ok()) return Finish(std::move(answer));
  if (parts_.late == nullptr) return Finish(durable);
  if (TakeAnswer()) parts_.late(std::move(answer), durable);
}

}  // namespace plumescout::server
