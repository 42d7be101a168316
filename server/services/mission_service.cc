// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/mission_service.h"

#include <algorithm>
#include <string>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"
#include "proto/convert/options.h"
#include "server/base/errors.h"
#include "server/base/log.h"
#include "server/config/mission_options.h"
#include "server/services/unary.h"

namespace plumescout::server {
namespace {

using plumescout::ToProto;  // the one below overloads these rather than hide them

constexpr int kDefaultPage = 100;
constexpr int kMaxPage = 1000;

v1::Latency ToProto(const LatencyFigures& figures) {
  v1::Latency proto;
  proto.set_sample_count(figures.samples);
  proto.set_median_s(absl::ToDoubleSeconds(figures.median));
  proto.set_p99_s(absl::ToDoubleSeconds(figures.p99));
  proto.set_max_s(absl::ToDoubleSeconds(figures.max));
  return proto;
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
  proto.set_revision(summary.revision);
  proto.set_phase(ToProto(summary.phase));
  if (summary.next_map_update_ns) proto.set_next_map_update_ns(*summary.next_map_update_ns);
  proto.set_robot_count(host.leases().robot_count());
  const GasTimings timings = host.gas_timings();
  *proto.mutable_gas_timings()->mutable_update() = ToProto(timings.update);
  *proto.mutable_gas_timings()->mutable_staleness() = ToProto(timings.staleness);
  return proto;
}

// A page token is the last name of the page before, armoured so that nobody builds one by hand.
std::string PageToken(const MissionId& last) { return absl::WebSafeBase64Escape(last); }

absl::StatusOr<MissionId> ReadPageToken(const std::string& token) {
  MissionId last;
  if (token.empty()) return last;
  if (!absl::WebSafeBase64Unescape(token, &last) || !ValidateId("id", last).ok()) {
    return FieldError("page_token", token, "is not a token of this list");
  }
  return last;
}

}  // namespace

absl::Status MissionService::Create(const v1::CreateMissionRequest& request, v1::Mission& mission) {
  PLUMESCOUT_RETURN_IF_ERROR(WithField(ValidateId("mission_id", request.mission_id()), ""));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const MissionOptions options,
      ReadMissionOptions(request.options(), context_.mission_defaults, "options"));
  const auto host = context_.registry->Create(request.mission_id(), options);
  PLUMESCOUT_RETURN_IF_ERROR(WithField(host.status(), "options"));
  LogInfo("mission created", {{"mission", request.mission_id()},
                              {"max_cell_count", absl::StrCat(CellBound(options.occupancy))},
                              {"strategy", options.planning.strategy}});
  mission = Describe(**host, WithoutPriorMap(options));
  return absl::OkStatus();
}

absl::Status MissionService::Get(const v1::GetMissionRequest& request, v1::Mission& mission) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId id, ParseMissionName("name", request.name()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(id));
  mission = Describe(*host, host->options());
  return absl::OkStatus();
}

absl::Status MissionService::List(const v1::ListMissionsRequest& request,
                                  v1::ListMissionsResponse& response) {
  if (request.page_size() < 0) {
    return FieldError("page_size", request.page_size(), "must be >= 0");
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId after, ReadPageToken(request.page_token()));
  const int page_size =
      request.page_size() == 0 ? kDefaultPage : std::min(request.page_size(), kMaxPage);
  // One more than the page tells whether there is a next.
  auto hosts = context_.registry->List(after, page_size + 1);
  if (hosts.size() > static_cast<std::size_t>(page_size)) {
    hosts.pop_back();
    response.set_next_page_token(PageToken(hosts.back()->id()));
  }
  for (const auto& host : hosts) {
    *response.add_missions() = Describe(*host, WithoutPriorMap(host->options()));
  }
  return absl::OkStatus();
}

absl::Status MissionService::Delete(const v1::DeleteMissionRequest& request,
                                    grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId id, ParseMissionName("name", request.name()));
  // Joining the writer may take as long as a refresh of the posterior: not in a reactor.
  return context_.map_pool->Submit([registry = context_.registry, id, reactor] {
    const auto host = registry->Remove(id);
    if (host.ok()) {
      (*host)->Stop(MissionNotFound(id));
      LogInfo("mission deleted", {{"mission", id}});
    }
    Answer(reactor, host.status());
  });
}

grpc::ServerUnaryReactor* MissionService::CreateMission(grpc::CallbackServerContext* call,
                                                        const v1::CreateMissionRequest* request,
                                                        v1::CreateMissionResponse* response) {
  auto* reactor = call->DefaultReactor();
  Answer(reactor, Create(*request, *response->mutable_mission()));
  return reactor;
}

grpc::ServerUnaryReactor* MissionService::GetMission(grpc::CallbackServerContext* call,
                                                     const v1::GetMissionRequest* request,
                                                     v1::GetMissionResponse* response) {
  auto* reactor = call->DefaultReactor();
  Answer(reactor, Get(*request, *response->mutable_mission()));
  return reactor;
}

grpc::ServerUnaryReactor* MissionService::ListMissions(grpc::CallbackServerContext* call,
                                                       const v1::ListMissionsRequest* request,
                                                       v1::ListMissionsResponse* response) {
  auto* reactor = call->DefaultReactor();
  Answer(reactor, List(*request, *response));
  return reactor;
}

grpc::ServerUnaryReactor* MissionService::DeleteMission(grpc::CallbackServerContext* call,
                                                        const v1::DeleteMissionRequest* request,
                                                        v1::DeleteMissionResponse*) {
  auto* reactor = call->DefaultReactor();
  const absl::Status started = Delete(*request, reactor);
  if (!started.ok()) Answer(reactor, started);
  return reactor;
}

}  // namespace plumescout::server
