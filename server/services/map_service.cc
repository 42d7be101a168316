// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/map_service.h"

#include <utility>
#include <vector>

#include "core/belief/belief.h"
#include "core/belief/gas_query.h"
#include "core/types/status_macros.h"
#include "proto/convert/inquiry.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "server/services/unary.h"
#include "server/streams/watch_stream.h"

namespace plumescout::server {

absl::Status MapService::Get(const v1::GetMapRequest& request, v1::GetMapResponse* response,
                             grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const MapView view, MapViewFromProto(request.layers(), request.full_precision(), "layers"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(mission));
  BeliefRequest wanted;
  wanted.wish.fresh_posterior = request.fresh_posterior();
  return AnswerFromBelief(*host, context_.map_pool, reactor, std::move(wanted),
                          [=](const Belief& belief) {
                            *response = ToProto(MakeMapSnapshot(belief), mission, view);
                            return absl::OkStatus();
                          });
}

absl::Status MapService::Query(const v1::QueryGasRequest& request, v1::QueryGasResponse* response,
                               grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(mission));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      std::vector<Point2> points,
      PointsFromProto(request.points(), host->options().pose_limit_m, "points"));
  BeliefRequest wanted;
  wanted.wish.fresh_posterior = request.fresh_posterior();
  return AnswerFromBelief(*host, context_.map_pool, reactor, std::move(wanted),
                          [response, points = std::move(points)](const Belief& belief) {
                            for (const GasAtPlace& gas : plumescout::QueryGas(belief, points))
                              *response->add_gas() = ToProto(gas);
                            response->set_revision(belief.revision);
                            response->set_posterior_time_ns(belief.posterior_time_ns);
                            *response->mutable_gas_quality() =
                                ToProto(belief.gas_quality, belief.gas_audits);
                            return absl::OkStatus();
                          });
}

grpc::ServerUnaryReactor* MapService::GetMap(grpc::CallbackServerContext* call,
                                             const v1::GetMapRequest* request,
                                             v1::GetMapResponse* response) {
  auto* reactor = call->DefaultReactor();
  const absl::Status started = Get(*request, response, reactor);
  if (!started.ok()) Answer(reactor, started);
  return reactor;
}

grpc::ServerUnaryReactor* MapService::QueryGas(grpc::CallbackServerContext* call,
                                               const v1::QueryGasRequest* request,
                                               v1::QueryGasResponse* response) {
  auto* reactor = call->DefaultReactor();
  const absl::Status started = Query(*request, response, reactor);
  if (!started.ok()) Answer(reactor, started);
  return reactor;
}

grpc::ServerWriteReactor<v1::WatchMapResponse>* MapService::WatchMap(
    grpc::CallbackServerContext*, const v1::WatchMapRequest* request) {
  return WatchStream::Start(&context_, *request);
}

}  // namespace plumescout::server
