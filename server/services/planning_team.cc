// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the planning service: plans for teams.
#include <memory>
#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"
#include "proto/convert/plan.h"
#include "server/calls/answer_once.h"
#include "server/services/planning_service.h"
#include "server/streams/plan_order_from_proto.h"

namespace plumescout::server {
namespace {

void WriteTeam(const CommittedTeam& team, const MissionId& mission,
               v1::PlanTeamResponse& response) {
  for (const Plan& plan : team.plans) *response.add_plans() = ToProto(plan, mission);
  for (const LeftOut& left_out : team.left_out) {
    v1::PlanTeamResponse::LeftOut& proto = *response.add_left_out();
    proto.set_robot(RobotResource({mission, left_out.robot}));
    proto.set_reason(left_out.why);
  }
  response.set_order_count(team.order_count);
}

}  // namespace

absl::Status PlanningService::OrderTeam(const v1::PlanTeamRequest& request,
                                        v1::PlanTeamResponse* response,
                                        const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(TeamOrder order,
                              TeamOrderFromProto(request, mission, context_.limits));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), mission));
  return AnswerOnce(host->requests(), request.request_id(), request, response, call,
                    [this, host, order, response](const std::shared_ptr<UnaryCall>& runner) {
                      return SearchTeam(host, order, response, runner);
                    });
}

absl::Status PlanningService::SearchTeam(const std::shared_ptr<MissionHost>& host, TeamOrder order,
                                         v1::PlanTeamResponse* response,
                                         const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_RETURN_IF_ERROR(host->CheckMayPlan());
  order.deadline = After(call->info().deadline, -context_.limits.deadline_margin);
  const auto job = std::make_shared<TeamJob>(TeamJob::Parts{
      host, context_.planning_pool, std::move(order),
      [call, response, mission = host->id()](absl::StatusOr<CommittedTeam> answer) {
        if (answer.ok()) WriteTeam(*answer, mission, *response);
        call->Answer(WithField(answer.status(), ""));
      },
      [call, response, host](const CommittedTeam& team, const absl::Status& durable) {
        WriteTeam(team, host->id(), *response);
        call->AnswerUnder(OnceDurable(host), durable);
      }});
  call->WhenCancelled([job] { job->Cancel(); });
  job->Start();
  return absl::OkStatus();
}

grpc::ServerUnaryReactor* PlanningService::PlanTeam(grpc::CallbackServerContext* context,
                                                    const v1::PlanTeamRequest* request,
                                                    v1::PlanTeamResponse* response) {
  return UnaryCall::Start(context_, Rpc::kPlanTeam, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return OrderTeam(*request, response, call);
                          });
}

}  // namespace plumescout::server
