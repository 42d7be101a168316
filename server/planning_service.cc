// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/planning_service.h"

#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"
#include "proto/convert/plan.h"
#include "server/log.h"
#include "server/plan_job.h"
#include "server/plan_order_from_proto.h"
#include "server/unary.h"

namespace plumescout::server {
namespace {

void FillResponse(const PlanAnswer& answer, const MissionId& mission,
                  v1::NextBestTrajectoryResponse& response) {
  *response.mutable_plan() = ToProto(answer.plan, mission);
  absl::Duration rest;
  auto& cpu = *response.mutable_plan()->mutable_cpu_duration();
  cpu.set_seconds(absl::IDivDuration(answer.cpu_time, absl::Seconds(1), &rest));
  cpu.set_nanos(static_cast<int>(absl::ToInt64Nanoseconds(rest)));
}

void LogPlan(const MissionId& mission, const PlanAnswer& answer) {
  LogInfo("plan", {{"mission", mission},
                   {"robot", answer.plan.robot},
                   {"plan", absl::StrCat(answer.plan.id)},
                   {"candidates", absl::StrCat(answer.plan.candidates.size())},
                   {"length_m", absl::StrCat(answer.plan.trajectory.length_m)},
                   {"cpu_ms", absl::StrCat(absl::ToInt64Milliseconds(answer.cpu_time))}});
}

// A planning call: carries cancellation to the job and its answer back.
class PlanCall final : public grpc::ServerUnaryReactor {
 public:
  explicit PlanCall(v1::NextBestTrajectoryResponse* response) : response_(response) {}

  // The call owns itself until gRPC is done with it.
  static PlanCall* Start(const ServiceContext& context, grpc::CallbackServerContext* call,
                         const v1::NextBestTrajectoryRequest& request,
                         v1::NextBestTrajectoryResponse* response) {
    auto plan_call = std::make_shared<PlanCall>(response);
    plan_call->self_ = plan_call;
    const absl::Status status = plan_call->Order(context, call, request);
    if (!status.ok()) Answer(plan_call.get(), status);
    return plan_call.get();
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
    PLUMESCOUT_RETURN_IF_ERROR(host->leases().Check(name.robot, order.lease_token));
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
      FillResponse(*answer, mission, *response_);
    }
    Answer(this, WithField(answer.status(), ""));
  }

  v1::NextBestTrajectoryResponse* const response_;
  std::shared_ptr<PlanCall> self_;  // until OnDone
  std::shared_ptr<PlanJob> job_;
};

}  // namespace

grpc::ServerUnaryReactor* PlanningService::NextBestTrajectory(
    grpc::CallbackServerContext* call, const v1::NextBestTrajectoryRequest* request,
    v1::NextBestTrajectoryResponse* response) {
  return PlanCall::Start(context_, call, *request, response);
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
  PLUMESCOUT_RETURN_IF_ERROR(host->leases().Check(name.robot, token));
  const ProgressReported report{name.robot, plan.plan, outcome};
  return host->Post([report, token, response, reactor](MissionWriter& writer) {
    const auto revision = writer.Report(report, token);
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
