// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/map_service.h"

#include <memory>
#include <utility>

#include "core/belief/belief.h"
#include "core/types/status_macros.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "server/unary.h"
#include "server/watch_stream.h"

namespace plumescout::server {

absl::Status MapService::Get(const v1::GetMapRequest& request, v1::GetMapResponse* response,
                             grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const MapView view, MapViewFromProto(request.layers(), request.full_precision(), "layers"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(mission));
  WorkerPool* const pool = context_.map_pool;
  BeliefRequest wanted;
  wanted.fresh_posterior = request.fresh_posterior();
  return host->AwaitBelief(
      std::move(wanted), [=](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
        if (!belief.ok()) return Answer(reactor, belief.status());
        const absl::Status queued = pool->Submit([=, belief = *std::move(belief)] {
          *response = ToProto(MakeMapSnapshot(*belief), mission, view);
          Answer(reactor, absl::OkStatus());
        });
        if (!queued.ok()) Answer(reactor, queued);
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

grpc::ServerWriteReactor<v1::WatchMapResponse>* MapService::WatchMap(
    grpc::CallbackServerContext*, const v1::WatchMapRequest* request) {
  return WatchStream::Start(&context_, *request);
}

}  // namespace plumescout::server
