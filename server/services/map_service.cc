// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/map_service.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/belief/belief.h"
#include "core/belief/gas_query.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/inquiry.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "proto/convert/species.h"
#include "server/calls/call_stop.h"
#include "server/calls/unary_call.h"
#include "server/maps/map_feed.h"
#include "server/maps/wire_message.h"
#include "server/streams/watch_stream.h"

namespace plumescout::server {

absl::Status MapService::Get(const grpc::ByteBuffer& bytes, grpc::ByteBuffer* response,
                             const std::shared_ptr<UnaryCall>& call) {
  v1::GetMapRequest request;
  PLUMESCOUT_RETURN_IF_ERROR(Parse(bytes, request));
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const MapView view, MapViewFromProto(request));
  const std::int64_t max_bytes = request.max_part_bytes();
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative("max_part_bytes", static_cast<double>(max_bytes)));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), mission));
  PLUMESCOUT_RETURN_IF_ERROR(CheckSpecies(view.species, host->options(), "species"));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative("revision", static_cast<double>(request.revision())));
  if (request.revision() > 0) {
    return GetPast(host, {request.revision(), view, request.part_token(), max_bytes}, response,
                   call);
  }
  const std::shared_ptr<MapFeed> feed = host->map_feed();
  if (!request.part_token().empty()) {
    return AnswerInTurn(call, mission, context_.query_pool, [=, token = request.part_token()] {
      auto part = feed->store().NextPart(token, view, max_bytes);
      if (part.ok()) response->Swap(&*part);
      return part.status();
    });
  }
  BeliefWish wish;
  wish.fresh_posterior = request.fresh_posterior();
  return AnswerFromBelief(host, context_.query_pool, call, std::move(wish),
                          [=](const Belief& belief) {
                            *response = feed->store().FirstPart(belief, view, max_bytes);
                            return absl::OkStatus();
                          });
}

absl::Status MapService::GetPast(const std::shared_ptr<MissionHost>& host, const PastMapWish& wish,
                                 grpc::ByteBuffer* response,
                                 const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_RETURN_IF_ERROR(context_.CheckKeepsHistory());
  return AnswerInTurn(call, host->id(), context_.past_pool,
                      [=, maps = &context_.history->past_maps] {
                        const CallStop stop(call, host);
                        auto part = maps->Part(host, wish, [&stop] { return stop.stops(); });
                        if (part.ok()) response->Swap(&*part);
                        return stop.AnswerOf(part.status());
                      });
}

absl::Status MapService::Query(const v1::QueryGasRequest& request, v1::QueryGasResponse* response,
                               const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), mission));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      std::vector<Point2> points,
      PointsFromProto(request.points(), host->options().pose_limit_m, "points"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::size_t species,
                              SpeciesFromProto(request.species(), host->options(), "species"));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative("revision", static_cast<double>(request.revision())));
  const auto answer = [response, species, with_verdicts = request.with_verdicts(),
                       points = std::move(points)](const Belief& belief) {
    for (const GasAtPlace& gas : plumescout::QueryGas(belief, points, species, with_verdicts)) {
      *response->add_gas() = ToProto(gas);
    }
    const GasField field = belief.Gas(species);
    response->set_revision(belief.revision);
    response->set_sample_time_ns(belief.sample_time_ns);
    response->set_posterior_time_ns(belief.posterior_time_ns);
    *response->mutable_gas_quality() = ToProto(field.quality, field.audits);
    return absl::OkStatus();
  };
  if (request.revision() > 0) {
    PLUMESCOUT_RETURN_IF_ERROR(context_.CheckKeepsHistory());
    return AnswerInTurn(call, mission, context_.past_pool,
                        [=, revision = request.revision(), maps = &context_.history->past_maps] {
                          const CallStop stop(call, host);
                          const auto belief =
                              maps->BeliefAt(host, revision, [&stop] { return stop.stops(); });
                          return stop.AnswerOf(belief.ok() ? answer(**belief) : belief.status());
                        });
  }
  BeliefWish wish;
  wish.fresh_posterior = request.fresh_posterior();
  return AnswerFromBelief(host, context_.query_pool, call, std::move(wish), answer);
}

grpc::ServerUnaryReactor* MapService::GetMap(grpc::CallbackServerContext* context,
                                             const grpc::ByteBuffer* request,
                                             grpc::ByteBuffer* response) {
  return UnaryCall::Start(
      context_, Rpc::kGetMap, context,
      [=, this](const std::shared_ptr<UnaryCall>& call) { return Get(*request, response, call); });
}

grpc::ServerUnaryReactor* MapService::QueryGas(grpc::CallbackServerContext* context,
                                               const v1::QueryGasRequest* request,
                                               v1::QueryGasResponse* response) {
  return UnaryCall::Start(context_, Rpc::kQueryGas, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Query(*request, response, call);
                          });
}

grpc::ServerWriteReactor<grpc::ByteBuffer>* MapService::WatchMap(
    grpc::CallbackServerContext* context, const grpc::ByteBuffer* request) {
  return WatchStream::Start(&context_, context, *request);
}

}  // namespace plumescout::server
