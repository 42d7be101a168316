// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/planning_service.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/mission/conduct/conduct_errors.h"
#include "core/plan/frontier_list.h"
#include "core/plan/trajectory_check.h"
#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/inquiry.h"
#include "proto/convert/names.h"
#include "proto/convert/observation.h"
#include "proto/convert/plan.h"
#include "server/missions/plan_job.h"
#include "server/services/unary.h"
#include "server/streams/plan_order_from_proto.h"
#include "server/streams/plan_stream.h"

namespace plumescout::server {
namespace {

// What a CheckTrajectoryRequest asks about: a plan, or a path of the caller's own.
struct CheckSubject {
  std::optional<PlanId> plan;
  std::vector<Point2> vertices;
  GoalKind goal_kind = GoalKind::kRandomFreeSpace;
};

absl::StatusOr<CheckSubject> SubjectFromProto(const v1::CheckTrajectoryRequest& request,
                                              const MissionId& mission, double limit_m) {
  CheckSubject subject;
  if (request.has_plan()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const PlanName name, ParsePlanName("plan", request.plan()));
    if (name.mission != mission) {
      return FieldError("plan", request.plan(), "must be of the robot's mission");
    }
    subject.plan = name.plan;
    return subject;
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckPresent("subject", request.has_path()));
  PLUMESCOUT_ASSIGN_OR_RETURN(subject.vertices,
                              PointsFromProto(request.path().vertices(), limit_m, "path.vertices"));
  PLUMESCOUT_ASSIGN_OR_RETURN(subject.goal_kind,
                              FromProto(request.path().goal_kind(), "path.goal_kind"));
  return subject;
}

absl::Status CheckOn(const Belief& belief, const RobotId& robot, const CheckSubject& subject,
                     v1::CheckTrajectoryResponse& response) {
  IntendedPath path;
  if (subject.plan) {
    PLUMESCOUT_ASSIGN_OR_RETURN(path, RestOfPlan(belief, robot, *subject.plan));
  } else {
    path = PathTo(subject.goal_kind, subject.vertices, belief.geometry());
  }
  response = ToProto(CheckTrajectory(belief, robot, path, belief.options->planning));
  response.set_revision(belief.revision);
  return absl::OkStatus();
}

// A planning call: carries cancellation to the job and its answer back.
class PlanReactor final : public grpc::ServerUnaryReactor {
 public:
  explicit PlanReactor(v1::NextBestTrajectoryResponse* response) : response_(response) {}

  // The call owns itself until gRPC is done with it.
  static PlanReactor* Start(const ServiceContext& context, grpc::CallbackServerContext* call,
                            const v1::NextBestTrajectoryRequest& request,
                            v1::NextBestTrajectoryResponse* response) {
    auto reactor = std::make_shared<PlanReactor>(response);
    reactor->self_ = reactor;
    const absl::Status status = reactor->Order(context, call, request);
    if (!status.ok()) Answer(reactor.get(), status);
    return reactor.get();
  }

  void OnCancel() override {
    if (job_ != nullptr) job_->Cancel();
  }
  void OnDone() override {
    const auto self = std::move(self_);
    job_.reset();  // it holds this call in turn
  }

 private:
  absl::Status Order(const ServiceContext& context, grpc::CallbackServerContext* call,
                     const v1::NextBestTrajectoryRequest& request) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
    PLUMESCOUT_ASSIGN_OR_RETURN(PlanOrder order, PlanOrderFromProto(request, context.limits));
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context.registry->Find(name.mission));
    PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(name.robot, order.lease_token));
    order.request.robot = name.robot;
    order.deadline = After(ToSteady(call->deadline()), -context.limits.deadline_margin);
    job_ = std::make_shared<PlanJob>(
        PlanJob::Parts{host, context.planning_pool, std::move(order),
                       [self = self_, mission = name.mission](absl::StatusOr<PlanAnswer> answer) {
                         self->Reply(mission, answer);
                       }});
    job_->Start();
    return absl::OkStatus();
  }

  void Reply(const MissionId& mission, const absl::StatusOr<PlanAnswer>& answer) {
    if (answer.ok()) {
      LogPlan(mission, *answer);
      *response_->mutable_plan() = ToProto(answer->plan, mission);
    }
    Answer(this, WithField(answer.status(), ""));
  }

  v1::NextBestTrajectoryResponse* const response_;
  std::shared_ptr<PlanReactor> self_;  // until OnDone
  std::shared_ptr<PlanJob> job_;
};

}  // namespace

grpc::ServerUnaryReactor* PlanningService::NextBestTrajectory(
    grpc::CallbackServerContext* call, const v1::NextBestTrajectoryRequest* request,
    v1::NextBestTrajectoryResponse* response) {
  return PlanReactor::Start(context_, call, *request, response);
}

grpc::ServerWriteReactor<v1::StreamNextBestTrajectoryResponse>*
PlanningService::StreamNextBestTrajectory(grpc::CallbackServerContext* call,
                                          const v1::StreamNextBestTrajectoryRequest* request) {
  return PlanStream::Start(&context_, call, *request);
}

absl::Status PlanningService::Check(const v1::CheckTrajectoryRequest& request, SteadyTime deadline,
                                    v1::CheckTrajectoryResponse* response,
                                    grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange("min_applied_sequence", request.min_applied_sequence(), 0, kMaxSequence));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(name.mission));
  PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(name.robot, request.lease_token()));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      CheckSubject subject, SubjectFromProto(request, name.mission, host->options().pose_limit_m));
  BeliefRequest wanted{.wish = {.robot = name.robot,
                                .min_applied_sequence = request.min_applied_sequence(),
                                .lease_token = request.lease_token(),
                                .fresh_posterior = false},
                       .deadline = deadline};
  return AnswerFromBelief(*host, context_.map_pool, reactor, std::move(wanted),
                          [=, subject = std::move(subject)](const Belief& belief) {
                            return CheckOn(belief, name.robot, subject, *response);
                          });
}

grpc::ServerUnaryReactor* PlanningService::CheckTrajectory(
    grpc::CallbackServerContext* call, const v1::CheckTrajectoryRequest* request,
    v1::CheckTrajectoryResponse* response) {
  auto* reactor = call->DefaultReactor();
  const SteadyTime deadline = After(ToSteady(call->deadline()), -context_.limits.deadline_margin);
  const absl::Status started = Check(*request, deadline, response, reactor);
  if (!started.ok()) Answer(reactor, started);
  return reactor;
}

absl::Status PlanningService::List(const v1::ListFrontiersRequest& request,
                                   v1::ListFrontiersResponse* response,
                                   grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(name.mission));
  BeliefRequest wanted;
  wanted.wish.fresh_posterior = false;
  return AnswerFromBelief(*host, context_.map_pool, reactor, std::move(wanted),
                          [response, robot = name.robot](const Belief& belief) -> absl::Status {
                            if (belief.robots.count(robot) == 0) return RobotNotFound(robot);
                            PLUMESCOUT_ASSIGN_OR_RETURN(
                                const std::vector<JudgedFrontier> frontiers,
                                plumescout::ListFrontiers(belief, robot, belief.options->planning));
                            for (const JudgedFrontier& frontier : frontiers) {
                              *response->add_frontiers() = ToProto(frontier);
                            }
                            response->set_revision(belief.revision);
                            return absl::OkStatus();
                          });
}

grpc::ServerUnaryReactor* PlanningService::ListFrontiers(grpc::CallbackServerContext* call,
                                                         const v1::ListFrontiersRequest* request,
                                                         v1::ListFrontiersResponse* response) {
  auto* reactor = call->DefaultReactor();
  const absl::Status started = List(*request, response, reactor);
  if (!started.ok()) Answer(reactor, started);
  return reactor;
}

absl::Status PlanningService::Report(const v1::ReportProgressRequest& request,
                                     v1::ReportProgressResponse* response,
                                     grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlanName plan, ParsePlanName("plan", request.plan()));
  if (plan.mission != name.mission) {
    return FieldError("plan", request.plan(), "must be of the robot's mission");
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProgressOutcome outcome,
                              FromProto(request.outcome(), "outcome"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(name.mission));
  const std::int64_t token = request.lease_token();
  PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(name.robot, token));
  const ProgressReported report{name.robot, plan.plan, outcome};
  return host->Post([report, token, response, reactor](MissionWriter& writer) {
    const auto revision = writer.conduct().Report(report, token);
    if (revision.ok()) response->set_revision(*revision);
    Answer(reactor, revision.status());
  });
}

grpc::ServerUnaryReactor* PlanningService::ReportProgress(grpc::CallbackServerContext* call,
                                                          const v1::ReportProgressRequest* request,
                                                          v1::ReportProgressResponse* response) {
  auto* reactor = call->DefaultReactor();
  const absl::Status started = Report(*request, response, reactor);
  if (!started.ok()) Answer(reactor, started);
  return reactor;
}

}  // namespace plumescout::server
