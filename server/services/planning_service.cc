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
#include "proto/convert/geometry.h"
#include "proto/convert/inquiry.h"
#include "proto/convert/names.h"
#include "proto/convert/observation.h"
#include "proto/convert/plan.h"
#include "server/calls/answer_once.h"
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
  if (belief.robots.count(robot) == 0) return RobotNotFound(robot);
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

v1::LivePlan LivePlanOf(const RobotRecord& record, const MissionId& mission) {
  v1::LivePlan proto;
  proto.set_name(PlanResource({mission, record.last_plan}));
  proto.set_robot(RobotResource({mission, record.state.id}));
  proto.set_goal_kind(ToProto(record.live_goal->kind));
  *proto.mutable_goal() = ToProto(record.live_goal->position);
  proto.set_arrival_time_ns(record.live_arrival_ns);
  if (record.live_trajectory != nullptr) {
    *proto.mutable_trajectory() = ToProto(*record.live_trajectory);
  }
  return proto;
}

// Those of robots that are in the mission still.
void WriteLatest(const LatestPlans& plans, const Belief& belief, const MissionId& mission,
                 v1::ListPlansResponse& response) {
  for (const LatestPlans::PlanPtr& plan : plans.All()) {
    if (belief.robots.count(plan->robot) > 0) *response.add_latest() = ToProto(*plan, mission);
  }
}

}  // namespace

absl::Status PlanningService::Order(const v1::NextBestTrajectoryRequest& request,
                                    v1::NextBestTrajectoryResponse* response,
                                    const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(PlanOrder order, PlanOrderFromProto(request, context_.limits));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMissionOf(call->caller(), name));
  order.request.robot = name.robot;
  return AnswerOnce(host->requests(), request.request_id(), request, response, call,
                    [this, host, order, response](const std::shared_ptr<UnaryCall>& runner) {
                      return Search(host, order, response, runner);
                    });
}

absl::Status PlanningService::Search(const std::shared_ptr<MissionHost>& host, PlanOrder order,
                                     v1::NextBestTrajectoryResponse* response,
                                     const std::shared_ptr<UnaryCall>& call) {
  const RobotId& robot = order.request.robot;
  PLUMESCOUT_RETURN_IF_ERROR(host->CheckMayPlan());
  PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(robot, order.lease_token));
  PLUMESCOUT_RETURN_IF_ERROR(host->rates().AdmitPlan(robot));
  order.deadline = After(call->info().deadline, -context_.limits.deadline_margin);
  const auto write = [call, response, mission = host->id()](const PlanAnswer& answer) {
    LogPlan(mission, answer, call->info().request_id);
    *response->mutable_plan() = ToProto(answer.plan, mission);
  };
  const auto job = std::make_shared<PlanJob>(
      PlanJob::Parts{host, context_.planning_pool, std::move(order),
                     [call, write](const absl::StatusOr<PlanAnswer>& answer) {
                       if (answer.ok()) write(*answer);
                       call->Answer(WithField(answer.status(), ""));
                     },
                     nullptr, call->info().stage_times,
                     [call, write, host](const PlanAnswer& answer, const absl::Status& durable) {
                       write(answer);
                       call->AnswerUnder(OnceDurable(host), durable);
                     }});
  call->WhenCancelled([job] { job->Cancel(); });
  job->Start();
  return absl::OkStatus();
}

grpc::ServerUnaryReactor* PlanningService::NextBestTrajectory(
    grpc::CallbackServerContext* context, const v1::NextBestTrajectoryRequest* request,
    v1::NextBestTrajectoryResponse* response) {
  return UnaryCall::Start(context_, Rpc::kNextBestTrajectory, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Order(*request, response, call);
                          });
}

grpc::ServerWriteReactor<v1::StreamNextBestTrajectoryResponse>*
PlanningService::StreamNextBestTrajectory(grpc::CallbackServerContext* context,
                                          const v1::StreamNextBestTrajectoryRequest* request) {
  return PlanStream::Start(&context_, context, *request);
}

absl::Status PlanningService::Check(const v1::CheckTrajectoryRequest& request,
                                    v1::CheckTrajectoryResponse* response,
                                    const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange("min_applied_sequence", request.min_applied_sequence(), 0, kMaxSequence));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMissionOf(call->caller(), name));
  BeliefWish wish{.robot = name.robot,
                  .min_applied_sequence = request.min_applied_sequence(),
                  .lease_token = std::nullopt,
                  .fresh_posterior = false};
  if (request.lease_token() != 0 || call->caller().role == Role::kRobot) {
    PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(name.robot, request.lease_token()));
    wish.lease_token = request.lease_token();
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(
      CheckSubject subject, SubjectFromProto(request, name.mission, host->options().pose_limit_m));
  return AnswerFromBelief(host, context_.query_pool, call, std::move(wish),
                          [=, subject = std::move(subject)](const Belief& belief) {
                            return CheckOn(belief, name.robot, subject, *response);
                          });
}

grpc::ServerUnaryReactor* PlanningService::CheckTrajectory(
    grpc::CallbackServerContext* context, const v1::CheckTrajectoryRequest* request,
    v1::CheckTrajectoryResponse* response) {
  return UnaryCall::Start(context_, Rpc::kCheckTrajectory, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Check(*request, response, call);
                          });
}

absl::Status PlanningService::List(const v1::ListFrontiersRequest& request,
                                   v1::ListFrontiersResponse* response,
                                   const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMissionOf(call->caller(), name));
  BeliefWish wish;
  wish.fresh_posterior = false;
  return AnswerFromBelief(host, context_.query_pool, call, std::move(wish),
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

grpc::ServerUnaryReactor* PlanningService::ListFrontiers(grpc::CallbackServerContext* context,
                                                         const v1::ListFrontiersRequest* request,
                                                         v1::ListFrontiersResponse* response) {
  return UnaryCall::Start(
      context_, Rpc::kListFrontiers, context,
      [=, this](const std::shared_ptr<UnaryCall>& call) { return List(*request, response, call); });
}

absl::Status PlanningService::Report(const v1::ReportProgressRequest& request,
                                     v1::ReportProgressResponse* response,
                                     const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlanName plan, ParsePlanName("plan", request.plan()));
  if (plan.mission != name.mission) {
    return FieldError("plan", request.plan(), "must be of the robot's mission");
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProgressOutcome outcome,
                              FromProto(request.outcome(), "outcome"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMissionOf(call->caller(), name));
  const std::int64_t token = request.lease_token();
  PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(name.robot, token));
  const ProgressReported report{name.robot, plan.plan, outcome};
  const auto run = [host, report, token, response](const std::shared_ptr<UnaryCall>& runner) {
    return PostFor(runner, *host, [host, report, token, response, runner](MissionWriter& writer) {
      absl::Status allowed = host->CheckMayWrite();
      allowed.Update(host->leases().CheckNotReleased(report.robot, token));
      if (!allowed.ok()) return runner->Answer(allowed);
      const auto revision = writer.conduct().Report(report, token);
      if (revision.ok()) response->set_revision(*revision);
      AnswerWhenDurable(host, runner, revision.status());
    });
  };
  return AnswerOnce(host->requests(), request.request_id(), request, response, call, run);
}

grpc::ServerUnaryReactor* PlanningService::ReportProgress(grpc::CallbackServerContext* context,
                                                          const v1::ReportProgressRequest* request,
                                                          v1::ReportProgressResponse* response) {
  return UnaryCall::Start(context_, Rpc::kReportProgress, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Report(*request, response, call);
                          });
}

absl::Status PlanningService::ListLive(const v1::ListPlansRequest& request,
                                       v1::ListPlansResponse* response,
                                       const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  if (request.with_latest() && call->caller().role == Role::kRobot) {
    return absl::PermissionDeniedError(
        "with_latest: robots may not read what other robots were told");
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), mission));
  BeliefWish wish;
  wish.fresh_posterior = false;
  return AnswerFromBelief(host, context_.query_pool, call, std::move(wish),
                          [=, with_latest = request.with_latest()](const Belief& belief) {
                            for (const auto& [robot, record] : belief.robots) {
                              if (!record.live_goal) continue;
                              *response->add_plans() = LivePlanOf(record, mission);
                            }
                            if (with_latest) {
                              WriteLatest(host->latest_plans(), belief, mission, *response);
                            }
                            response->set_revision(belief.revision);
                            return absl::OkStatus();
                          });
}

grpc::ServerUnaryReactor* PlanningService::ListPlans(grpc::CallbackServerContext* context,
                                                     const v1::ListPlansRequest* request,
                                                     v1::ListPlansResponse* response) {
  return UnaryCall::Start(context_, Rpc::kListPlans, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return ListLive(*request, response, call);
                          });
}

}  // namespace plumescout::server
