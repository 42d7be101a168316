// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/robot_service.h"

#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"
#include "server/base/log.h"
#include "server/services/unary.h"
#include "server/streams/ingest_frames.h"

namespace plumescout::server {

absl::Status RobotService::Register(const v1::RegisterRobotRequest& request,
                                    v1::RegisterRobotResponse* response,
                                    grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_RETURN_IF_ERROR(WithField(ValidateId("robot_id", request.robot_id()), ""));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(mission));
  const Registration wish{request.robot_id(), request.radius_m(), request.take_over()};
  return host->Post([this, host, wish, response, reactor](MissionWriter& writer) {
    const auto registered = writer.conduct().Register(wish, host->leases());
    if (!registered.ok()) return Answer(reactor, WithField(registered.status(), ""));
    LogInfo("robot registered", {{"mission", host->id()},
                                 {"robot", wish.robot},
                                 {"lease", absl::StrCat(registered->lease_token)}});
    response->set_robot(RobotResource({host->id(), wish.robot}));
    response->set_lease_token(registered->lease_token);
    response->set_server_boot_id(context_.boot_id);
    *response->mutable_ingest_state() =
        ToIngestState(registered->position, context_.limits.stream_window_observations);
    Answer(reactor, absl::OkStatus());
  });
}

grpc::ServerUnaryReactor* RobotService::RegisterRobot(grpc::CallbackServerContext* call,
                                                      const v1::RegisterRobotRequest* request,
                                                      v1::RegisterRobotResponse* response) {
  auto* reactor = call->DefaultReactor();
  const absl::Status started = Register(*request, response, reactor);
  if (!started.ok()) Answer(reactor, started);
  return reactor;
}

absl::Status RobotService::Remove(const v1::RemoveRobotRequest& request,
                                  v1::RemoveRobotResponse* response,
                                  grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(name.mission));
  Removal wish{name.robot};
  if (!request.force()) wish.lease_token = request.lease_token();
  return host->Post([host, wish, response, reactor](MissionWriter& writer) {
    const auto revision = writer.conduct().Remove(wish, host->leases());
    if (revision.ok()) {
      LogInfo("robot removed", {{"mission", host->id()}, {"robot", wish.robot}});
      response->set_revision(*revision);
    }
    Answer(reactor, revision.status());
  });
}

grpc::ServerUnaryReactor* RobotService::RemoveRobot(grpc::CallbackServerContext* call,
                                                    const v1::RemoveRobotRequest* request,
                                                    v1::RemoveRobotResponse* response) {
  auto* reactor = call->DefaultReactor();
  const absl::Status started = Remove(*request, response, reactor);
  if (!started.ok()) Answer(reactor, started);
  return reactor;
}

}  // namespace plumescout::server
