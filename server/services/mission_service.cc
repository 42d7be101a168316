// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/mission_service.h"

#include <map>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/keep_out.h"
#include "proto/convert/names.h"
#include "server/base/errors.h"
#include "server/base/log.h"
#include "server/calls/answer_once.h"
#include "server/config/mission_options.h"
#include "server/services/mission_message.h"
#include "server/services/paging.h"

namespace plumescout::server {
namespace {

// The last readings are in the posterior that stays, if there can be one: the writer says if not.
// Of a sensor that lags the very last is not: it waits for the next.
absl::Status Finish(MissionHost& host, MissionWriter& writer) {
  if (host.standing().state() == MissionState::kFinished) return absl::OkStatus();
  writer.conduct().FreshBelief().status().IgnoreError();
  host.standing().Finish();
  host.leases().EndAll(MissionFinished(host.id()));
  return absl::OkStatus();
}

void Apply(const MissionUpdate& update, MissionHost& host) {
  if (!update.idle_time_to_live && !update.event_retention) return;
  if (update.idle_time_to_live) host.standing().set_idle_time_to_live(*update.idle_time_to_live);
  if (update.event_retention) host.standing().set_event_retention(*update.event_retention);
  host.KeepStanding();
}

// The disk may take long, and the server goes down only when callers have their answers.
MissionJournal::Callback AnswerOnceDeleted(const MissionId& id,
                                           const std::shared_ptr<UnaryCall>& call) {
  call->WhenCancelled([call] { call->Answer(GivenUp()); });
  return [id, call](const absl::Status& removed) {
    LogInfo("mission deleted", {{"mission", id},
                                {"code", absl::StatusCodeToString(removed.code())},
                                {"request_id", call->info().request_id}});
    call->Answer(removed);
  };
}

}  // namespace

absl::Status MissionService::Make(const v1::CreateMissionRequest& request, v1::Mission& mission,
                                  const std::shared_ptr<UnaryCall>& call) {
  MissionUpdate wishes;
  PLUMESCOUT_RETURN_IF_ERROR(WithField(ValidateId("mission_id", request.mission_id()), ""));
  if (request.has_idle_time_to_live()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        wishes.idle_time_to_live,
        IdleTimeToLiveFromProto(request.idle_time_to_live(), "idle_time_to_live"));
  }
  if (request.event_retention() != v1::EVENT_RETENTION_UNSPECIFIED) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        wishes.event_retention,
        EventRetentionFromProto(request.event_retention(), "event_retention"));
  }
  if (context_.registry->Find(request.mission_id(), call->caller().tenant).ok()) {
    return MissionExists(request.mission_id());
  }
  // A known map is unpacked and taken in: not in a reactor.
  return context_.creation_pool->Submit([this, &request, &mission, call, wishes] {
    const absl::Status made = MakeNow(request, wishes, mission, call);
    if (!made.ok()) call->Answer(made);
  });
}

absl::Status MissionService::MakeNow(const v1::CreateMissionRequest& request,
                                     const MissionUpdate& wishes, v1::Mission& mission,
                                     const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const MissionOptions options,
      ReadMissionOptions(request.options(), context_.mission_defaults, "options"));
  const auto host = context_.registry->Create(request.mission_id(), options,
                                              {call->caller().name, call->caller().tenant});
  PLUMESCOUT_RETURN_IF_ERROR(WithField(host.status(), "options"));
  Apply(wishes, **host);
  LogInfo("mission created",
          {{"mission", request.mission_id()},
           {"memory_budget_bytes", absl::StrCat(options.memory_budget_bytes)},
           {"lattice_factor", absl::StrCat((*host)->options().gas.lattice_factor)},
           {"strategy", options.planning.strategy},
           {"request_id", call->info().request_id}});
  mission = Describe(**host);
  AnswerWhenDurable(*host, call, absl::OkStatus());
  return absl::OkStatus();
}

absl::Status MissionService::Create(const v1::CreateMissionRequest* request,
                                    v1::CreateMissionResponse* response,
                                    const std::shared_ptr<UnaryCall>& call) {
  const absl::Status found =
      context_.registry->Find(request->mission_id(), call->caller().tenant).status();
  if (!AwaitedMission(found).empty()) return found;  // it may be there
  // A mission that is gone again was not made, whatever was answered then.
  if (absl::IsNotFound(found)) {
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
  mission = Describe(*host);
  if (host->options().prior_map == nullptr) {
    call->Answer(absl::OkStatus());
    return absl::OkStatus();
  }
  return AnswerInTurn(call, id, context_.query_pool, [host, &mission] {
    *mission.mutable_options()->mutable_prior_map() = host->prior_map();
    return absl::OkStatus();
  });
}

absl::Status MissionService::List(const v1::ListMissionsRequest& request,
                                  v1::ListMissionsResponse& response,
                                  const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Page page, ReadPage(request.page_size(), request.page_token()));
  return AnswerInTurn(call, "", context_.query_pool, [this, page, &response, call] {
    return Fill(page, call->caller(), response);
  });
}

absl::Status MissionService::Fill(const Page& page, const Principal& caller,
                                  v1::ListMissionsResponse& response) {
  const MissionRegistry& registry = *context_.registry;
  const int limit = page.size + 1;  // one more than the page tells whether there is a next
  const auto may_see = [&](const std::string& key) { return MaySeeTenant(caller, TenantOf(key)); };
  const bool sees_all = caller.role == Role::kAdmin || caller.tenant.empty();
  const std::string begins_with = sees_all ? "" : absl::StrCat(caller.tenant, "/");
  std::map<std::string, v1::Mission> missions;  // by key
  // In this order: what is taken over or recovered in between stands with both, and then it runs.
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<OwnedMission> elsewhere,
                              registry.ListElsewhere(page.after, limit, begins_with, may_see));
  for (const OwnedMission& owned : elsewhere) missions[owned.key] = DescribeMission(owned);
  for (const AbsentMission& absent : registry.ListAbsent(page.after, limit, may_see)) {
    missions[absent.key] = DescribeMission(absent, registry.node());
  }
  const auto hosts = registry.List(page.after, limit,
                                   [&](const MissionHost& host) { return MaySee(caller, host); });
  for (const auto& host : hosts) missions[MissionKey(host->tenant(), host->id())] = Describe(*host);
  std::string last_key;
  for (auto& [key, mission] : missions) {
    if (response.missions_size() == page.size) {
      response.set_next_page_token(PageTokenAfter(last_key));
      break;
    }
    *response.add_missions() = std::move(mission);
    last_key = key;
  }
  return absl::OkStatus();
}

v1::Mission MissionService::Describe(MissionHost& host) const {
  return DescribeMission(host, WithoutPriorMap(host.options()), context_.registry->node());
}

absl::Status MissionService::Delete(const v1::DeleteMissionRequest& request,
                                    const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId id, ParseMissionName("name", request.name()));
  const auto found = context_.FindMission(call->caller(), id);
  if (absl::IsDataLoss(found.status())) return Discard(id, call);
  PLUMESCOUT_RETURN_IF_ERROR(found.status());
  // What is damaged may go; but that the disk takes nothing now is said at once.
  const absl::Status takes = (*found)->journal().CheckTakesMore();
  if (absl::IsUnavailable(takes)) return takes;
  return context_.registry->Delete(id, (*found)->tenant(), AnswerOnceDeleted(id, call));
}

absl::Status MissionService::Discard(const MissionId& id, const std::shared_ptr<UnaryCall>& call) {
  const std::string own_key = MissionKey(call->caller().tenant, id);
  std::string key;
  for (const AbsentMission& absent : context_.registry->ListAbsent("")) {
    const bool is_it = MissionIdOf(absent.key) == id && absl::IsDataLoss(absent.status) &&
                       MaySeeTenant(call->caller(), TenantOf(absent.key));
    if (is_it && key != own_key) key = absent.key;
  }
  if (key.empty()) key = own_key;  // servers that share a store list no missions of the store
  return context_.creation_pool->Submit([this, key, id, call] {
    absl::Status status = context_.registry->Discard(key, AnswerOnceDeleted(id, call));
    if (absl::IsNotFound(status)) status = DiscardOfAnyTenant(id, call);
    if (!status.ok()) call->Answer(status);
  });
}

// Of a store that servers share.
absl::Status MissionService::DiscardOfAnyTenant(const MissionId& id,
                                                const std::shared_ptr<UnaryCall>& call) {
  const auto is_it = [&](const std::string& key) {
    return MissionIdOf(key) == id && MaySeeTenant(call->caller(), TenantOf(key));
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<OwnedMission> found,
                              context_.registry->ListElsewhere("", 2, "", is_it));
  if (found.size() != 1) return found.empty() ? MissionNotFound(id) : NameOfSeveral(id);
  return context_.registry->Discard(found.front().key, AnswerOnceDeleted(id, call));
}

absl::Status MissionService::Update(const v1::UpdateMissionRequest& request, v1::Mission& mission,
                                    const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionUpdate update, MissionUpdateFromProto(request));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host,
                              context_.FindMission(call->caller(), update.mission));
  PLUMESCOUT_RETURN_IF_ERROR(host->journal().CheckTakesMore());
  Apply(update, *host);
  LogInfo("mission updated",
          {{"mission", update.mission},
           {"idle_time_to_live", absl::FormatDuration(host->standing().idle_time_to_live())},
           {"event_retention",
            v1::EventRetention_Name(EventRetentionToProto(host->standing().event_retention()))},
           {"request_id", call->info().request_id}});
  mission = Describe(*host);
  AnswerWhenDurable(host, call, absl::OkStatus());
  return absl::OkStatus();
}

absl::Status MissionService::Change(const std::string& name, v1::Mission& mission,
                                    const std::shared_ptr<UnaryCall>& call, Step step) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId id, ParseMissionName("name", name));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), id));
  // On the writer's thread: what was asked before the change is done, what is asked after it sees
  // it.
  return PostFor(call, *host, [this, host, step, call, &mission](MissionWriter& writer) {
    absl::Status changed = host->journal().CheckTakesMore();
    if (changed.ok()) changed = step(*host, writer);
    if (changed.ok()) {
      host->KeepStanding();
      mission = Describe(*host);
      LogInfo("mission state", {{"mission", host->id()},
                                {"state", v1::MissionState_Name(mission.state())},
                                {"caller", call->caller().name},
                                {"request_id", call->info().request_id}});
    }
    AnswerWhenDurable(host, call, changed);
  });
}

grpc::ServerUnaryReactor* MissionService::CreateMission(grpc::CallbackServerContext* context,
                                                        const v1::CreateMissionRequest* request,
                                                        v1::CreateMissionResponse* response) {
  return UnaryCall::Start(context_, Rpc::kCreateMission, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Create(request, response, call);
                          });
}

grpc::ServerUnaryReactor* MissionService::GetMission(grpc::CallbackServerContext* context,
                                                     const v1::GetMissionRequest* request,
                                                     v1::GetMissionResponse* response) {
  return UnaryCall::Start(context_, Rpc::kGetMission, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Get(*request, *response->mutable_mission(), call);
                          });
}

grpc::ServerUnaryReactor* MissionService::ListMissions(grpc::CallbackServerContext* context,
                                                       const v1::ListMissionsRequest* request,
                                                       v1::ListMissionsResponse* response) {
  return UnaryCall::Start(context_, Rpc::kListMissions, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return List(*request, *response, call);
                          });
}

grpc::ServerUnaryReactor* MissionService::DeleteMission(grpc::CallbackServerContext* context,
                                                        const v1::DeleteMissionRequest* request,
                                                        v1::DeleteMissionResponse*) {
  return UnaryCall::Start(
      context_, Rpc::kDeleteMission, context,
      [=, this](const std::shared_ptr<UnaryCall>& call) { return Delete(*request, call); });
}

grpc::ServerUnaryReactor* MissionService::UpdateMission(grpc::CallbackServerContext* context,
                                                        const v1::UpdateMissionRequest* request,
                                                        v1::UpdateMissionResponse* response) {
  return UnaryCall::Start(context_, Rpc::kUpdateMission, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Update(*request, *response->mutable_mission(), call);
                          });
}

grpc::ServerUnaryReactor* MissionService::PauseMission(grpc::CallbackServerContext* context,
                                                       const v1::PauseMissionRequest* request,
                                                       v1::PauseMissionResponse* response) {
  return UnaryCall::Start(
      context_, Rpc::kPauseMission, context, [=, this](const std::shared_ptr<UnaryCall>& call) {
        return Change(request->name(), *response->mutable_mission(), call,
                      [](MissionHost& host, MissionWriter&) { return host.standing().Pause(); });
      });
}

grpc::ServerUnaryReactor* MissionService::ResumeMission(grpc::CallbackServerContext* context,
                                                        const v1::ResumeMissionRequest* request,
                                                        v1::ResumeMissionResponse* response) {
  return UnaryCall::Start(
      context_, Rpc::kResumeMission, context, [=, this](const std::shared_ptr<UnaryCall>& call) {
        return Change(request->name(), *response->mutable_mission(), call,
                      [](MissionHost& host, MissionWriter&) { return host.standing().Resume(); });
      });
}

grpc::ServerUnaryReactor* MissionService::FinishMission(grpc::CallbackServerContext* context,
                                                        const v1::FinishMissionRequest* request,
                                                        v1::FinishMissionResponse* response) {
  return UnaryCall::Start(
      context_, Rpc::kFinishMission, context, [=, this](const std::shared_ptr<UnaryCall>& call) {
        return Change(request->name(), *response->mutable_mission(), call, Finish);
      });
}

absl::Status MissionService::KeepOut(const v1::ChangeKeepOutAreasRequest& request,
                                     v1::ChangeKeepOutAreasResponse* response,
                                     const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId id, ParseMissionName("name", request.name()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), id));
  PLUMESCOUT_ASSIGN_OR_RETURN(const KeepOutChanged change, FromProto(request));
  const auto run = [host, change, response](const std::shared_ptr<UnaryCall>& runner) {
    return PostFor(runner, *host, [host, change, response, runner](MissionWriter& writer) {
      const absl::Status writable = host->CheckMayWrite();
      if (!writable.ok()) return runner->Answer(writable);
      const auto revision = writer.conduct().ChangeKeepOut(change);
      if (revision.ok()) {
        LogInfo("keep-out areas changed", {{"mission", host->id()},
                                           {"added", absl::StrCat(change.added.size())},
                                           {"deleted", absl::StrCat(change.deleted.size())},
                                           {"caller", runner->caller().name},
                                           {"request_id", runner->info().request_id}});
        *response->mutable_areas() = ToProto(writer.mission().options().keep_out);
        response->set_revision(*revision);
      }
      AnswerWhenDurable(host, runner, WithField(revision.status(), ""));
    });
  };
  return AnswerOnce(host->requests(), request.request_id(), request, response, call, run);
}

grpc::ServerUnaryReactor* MissionService::ChangeKeepOutAreas(
    grpc::CallbackServerContext* context, const v1::ChangeKeepOutAreasRequest* request,
    v1::ChangeKeepOutAreasResponse* response) {
  return UnaryCall::Start(context_, Rpc::kChangeKeepOutAreas, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return KeepOut(*request, response, call);
                          });
}

}  // namespace plumescout::server
