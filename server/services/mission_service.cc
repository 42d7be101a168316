// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/mission_service.h"

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"
#include "proto/convert/options.h"
#include "server/base/errors.h"
#include "server/base/log.h"
#include "server/calls/answer_once.h"
#include "server/config/mission_options.h"
#include "server/services/mission_update.h"
#include "server/services/paging.h"

namespace plumescout::server {
namespace {

using plumescout::ToProto;  // the one below overloads these rather than hide them

v1::Latency ToProto(const LatencyFigures& figures) {
  v1::Latency proto;
  proto.set_sample_count(figures.samples);
  proto.set_median_s(absl::ToDoubleSeconds(figures.median));
  proto.set_p99_s(absl::ToDoubleSeconds(figures.p99));
  proto.set_max_s(absl::ToDoubleSeconds(figures.max));
  return proto;
}

v1::MissionState ToProto(MissionState state) {
  switch (state) {
    case MissionState::kRunning:
      return v1::MISSION_STATE_RUNNING;
    case MissionState::kPaused:
      return v1::MISSION_STATE_PAUSED;
    case MissionState::kFinished:
      return v1::MISSION_STATE_FINISHED;
  }
  return v1::MISSION_STATE_UNSPECIFIED;
}

// The last readings are in the posterior that stays, if there can be one: the writer says if not.
absl::Status Finish(MissionHost& host, MissionWriter& writer) {
  if (host.standing().state() == MissionState::kFinished) return absl::OkStatus();
  writer.conduct().FreshBelief().status().IgnoreError();
  host.standing().Finish();
  host.leases().EndAll(MissionFinished(host.id()));
  return absl::OkStatus();
}

MissionOptions WithoutPriorMap(MissionOptions options) {
  options.prior_map = nullptr;
  return options;
}

v1::Mission Describe(MissionHost& host, const MissionOptions& options) {
  const MissionSummary summary = host.summary();
  v1::Mission proto;
  proto.set_name(MissionResource(host.id()));
  *proto.mutable_options() = ToProto(options);
  proto.mutable_options()->mutable_gas()->set_lattice_factor(summary.lattice_factor);
  proto.mutable_memory()->set_used_bytes(summary.memory_bytes);
  proto.mutable_memory()->set_budget_bytes(options.memory_budget_bytes);
  proto.set_owner(host.owner());
  proto.set_state(ToProto(host.standing().state()));
  SetIdleTimeToLive(host.standing().idle_time_to_live(), proto);
  proto.set_revision(summary.revision);
  proto.set_phase(ToProto(summary.phase));
  if (summary.next_map_update_ns) proto.set_next_map_update_ns(*summary.next_map_update_ns);
  proto.set_robot_count(host.leases().robot_count());
  const GasTimings timings = host.gas_timings();
  *proto.mutable_gas_timings()->mutable_update() = ToProto(timings.update);
  *proto.mutable_gas_timings()->mutable_staleness() = ToProto(timings.staleness);
  return proto;
}

}  // namespace

absl::Status MissionService::Make(const v1::CreateMissionRequest& request, v1::Mission& mission,
                                  const std::shared_ptr<UnaryCall>& call) {
  absl::Duration idle_time_to_live = absl::InfiniteDuration();
  PLUMESCOUT_RETURN_IF_ERROR(WithField(ValidateId("mission_id", request.mission_id()), ""));
  if (request.has_idle_time_to_live()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        idle_time_to_live,
        IdleTimeToLiveFromProto(request.idle_time_to_live(), "idle_time_to_live"));
  }
  if (context_.registry->Find(request.mission_id(), call->caller().tenant).ok()) {
    return MissionExists(request.mission_id());
  }
  // A known map is unpacked and taken in: not in a reactor.
  return context_.creation_pool->Submit([this, &request, &mission, call, idle_time_to_live] {
    call->Answer(MakeNow(request, *call, idle_time_to_live, mission));
  });
}

absl::Status MissionService::MakeNow(const v1::CreateMissionRequest& request, const UnaryCall& call,
                                     absl::Duration idle_time_to_live, v1::Mission& mission) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const MissionOptions options,
      ReadMissionOptions(request.options(), context_.mission_defaults, "options"));
  const auto host = context_.registry->Create(request.mission_id(), options,
                                              {call.caller().name, call.caller().tenant});
  PLUMESCOUT_RETURN_IF_ERROR(WithField(host.status(), "options"));
  (*host)->standing().set_idle_time_to_live(idle_time_to_live);
  LogInfo("mission created",
          {{"mission", request.mission_id()},
           {"memory_budget_bytes", absl::StrCat(options.memory_budget_bytes)},
           {"lattice_factor", absl::StrCat((*host)->options().gas.lattice_factor)},
           {"strategy", options.planning.strategy},
           {"request_id", call.info().request_id}});
  mission = Describe(**host, WithoutPriorMap((*host)->options()));
  return absl::OkStatus();
}

absl::Status MissionService::Create(const v1::CreateMissionRequest* request,
                                    v1::CreateMissionResponse* response,
                                    const std::shared_ptr<UnaryCall>& call) {
  // A mission that is gone again was not made, whatever was answered then.
  if (!context_.FindMission(call->caller(), request->mission_id()).ok()) {
    context_.requests->Forget(KeyOf(*call, request->request_id()));
  }
  return AnswerOnce(context_.requests, request->request_id(), *request, response, call,
                    [this, request, response](const std::shared_ptr<UnaryCall>& runner) {
                      return Make(*request, *response->mutable_mission(), runner);
                    });
}

absl::Status MissionService::Get(const v1::GetMissionRequest& request, v1::Mission& mission,
                                 const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId id, ParseMissionName("name", request.name()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), id));
  mission = Describe(*host, WithoutPriorMap(host->options()));
  if (host->options().prior_map == nullptr) {
    call->Answer(absl::OkStatus());
    return absl::OkStatus();
  }
  return context_.query_pool->Submit([host, &mission, call] {
    *mission.mutable_options()->mutable_prior_map() = host->prior_map();
    call->Answer(absl::OkStatus());
  });
}

absl::Status MissionService::List(const v1::ListMissionsRequest& request,
                                  v1::ListMissionsResponse& response,
                                  const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Page page, ReadPage(request.page_size(), request.page_token()));
  return context_.query_pool->Submit([this, page, &response, call] {
    Fill(page, call->caller(), response);
    call->Answer(absl::OkStatus());
  });
}

void MissionService::Fill(const Page& page, const Principal& caller,
                          v1::ListMissionsResponse& response) {
  // One more than the page tells whether there is a next.
  auto hosts = context_.registry->List(
      page.after, page.size + 1, [&](const MissionHost& host) { return MaySee(caller, host); });
  if (hosts.size() > static_cast<std::size_t>(page.size)) {
    hosts.pop_back();
    response.set_next_page_token(
        PageTokenAfter(MissionKey(hosts.back()->tenant(), hosts.back()->id())));
  }
  for (const auto& host : hosts) {
    *response.add_missions() = Describe(*host, WithoutPriorMap(host->options()));
  }
}

absl::Status MissionService::Delete(const v1::DeleteMissionRequest& request,
                                    const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId id, ParseMissionName("name", request.name()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto found, context_.FindMission(call->caller(), id));
  return context_.registry->Delete(id, found->tenant(), [id, call] {
    LogInfo("mission deleted", {{"mission", id}, {"request_id", call->info().request_id}});
    call->Answer(absl::OkStatus());
  });
}

absl::Status MissionService::Update(const v1::UpdateMissionRequest& request, v1::Mission& mission,
                                    const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionUpdate update, MissionUpdateFromProto(request));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host,
                              context_.FindMission(call->caller(), update.mission));
  host->standing().set_idle_time_to_live(update.idle_time_to_live);
  LogInfo("mission updated",
          {{"mission", update.mission},
           {"idle_time_to_live", absl::FormatDuration(update.idle_time_to_live)}});
  mission = Describe(*host, WithoutPriorMap(host->options()));
  call->Answer(absl::OkStatus());
  return absl::OkStatus();
}

absl::Status MissionService::Change(const std::string& name, v1::Mission& mission,
                                    const std::shared_ptr<UnaryCall>& call, Step step) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId id, ParseMissionName("name", name));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), id));
  // On the writer's thread: what was asked before the change is done, what is asked after it sees
  // it.
  return host->Post(
      [host, step, call, &mission](MissionWriter& writer) {
        const absl::Status changed = step(*host, writer);
        if (changed.ok()) {
          mission = Describe(*host, WithoutPriorMap(host->options()));
          LogInfo("mission state", {{"mission", host->id()},
                                    {"state", v1::MissionState_Name(mission.state())},
                                    {"caller", call->caller().name}});
        }
        call->Answer(changed);
      },
      Refusal(call));
}

grpc::ServerUnaryReactor* MissionService::CreateMission(grpc::CallbackServerContext* context,
                                                        const v1::CreateMissionRequest* request,
                                                        v1::CreateMissionResponse* response) {
  return UnaryCall::Start(
      context_.door, Rpc::kCreateMission, context,
      [&](const std::shared_ptr<UnaryCall>& call) { return Create(request, response, call); });
}

grpc::ServerUnaryReactor* MissionService::GetMission(grpc::CallbackServerContext* context,
                                                     const v1::GetMissionRequest* request,
                                                     v1::GetMissionResponse* response) {
  return UnaryCall::Start(context_.door, Rpc::kGetMission, context,
                          [&](const std::shared_ptr<UnaryCall>& call) {
                            return Get(*request, *response->mutable_mission(), call);
                          });
}

grpc::ServerUnaryReactor* MissionService::ListMissions(grpc::CallbackServerContext* context,
                                                       const v1::ListMissionsRequest* request,
                                                       v1::ListMissionsResponse* response) {
  return UnaryCall::Start(
      context_.door, Rpc::kListMissions, context,
      [&](const std::shared_ptr<UnaryCall>& call) { return List(*request, *response, call); });
}

grpc::ServerUnaryReactor* MissionService::DeleteMission(grpc::CallbackServerContext* context,
                                                        const v1::DeleteMissionRequest* request,
                                                        v1::DeleteMissionResponse*) {
  return UnaryCall::Start(
      context_.door, Rpc::kDeleteMission, context,
      [&](const std::shared_ptr<UnaryCall>& call) { return Delete(*request, call); });
}

grpc::ServerUnaryReactor* MissionService::UpdateMission(grpc::CallbackServerContext* context,
                                                        const v1::UpdateMissionRequest* request,
                                                        v1::UpdateMissionResponse* response) {
  return UnaryCall::Start(context_.door, Rpc::kUpdateMission, context,
                          [&](const std::shared_ptr<UnaryCall>& call) {
                            return Update(*request, *response->mutable_mission(), call);
                          });
}

grpc::ServerUnaryReactor* MissionService::PauseMission(grpc::CallbackServerContext* context,
                                                       const v1::PauseMissionRequest* request,
                                                       v1::PauseMissionResponse* response) {
  return UnaryCall::Start(
      context_.door, Rpc::kPauseMission, context, [&](const std::shared_ptr<UnaryCall>& call) {
        return Change(request->name(), *response->mutable_mission(), call,
                      [](MissionHost& host, MissionWriter&) { return host.standing().Pause(); });
      });
}

grpc::ServerUnaryReactor* MissionService::ResumeMission(grpc::CallbackServerContext* context,
                                                        const v1::ResumeMissionRequest* request,
                                                        v1::ResumeMissionResponse* response) {
  return UnaryCall::Start(
      context_.door, Rpc::kResumeMission, context, [&](const std::shared_ptr<UnaryCall>& call) {
        return Change(request->name(), *response->mutable_mission(), call,
                      [](MissionHost& host, MissionWriter&) { return host.standing().Resume(); });
      });
}

grpc::ServerUnaryReactor* MissionService::FinishMission(grpc::CallbackServerContext* context,
                                                        const v1::FinishMissionRequest* request,
                                                        v1::FinishMissionResponse* response) {
  return UnaryCall::Start(
      context_.door, Rpc::kFinishMission, context, [&](const std::shared_ptr<UnaryCall>& call) {
        return Change(request->name(), *response->mutable_mission(), call, Finish);
      });
}

}  // namespace plumescout::server
