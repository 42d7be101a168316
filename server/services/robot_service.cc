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
namespace {

struct Registration {
  RobotId robot;
  double radius_m = 0.0;
  bool take_over = false;
};

struct Registered {
  std::int64_t lease_token = 0;
  LogPosition position;
};

// The mission is told first: a lease is in force only if its registration is an event.
absl::StatusOr<Registered> Register(MissionWriter& writer, LeaseTable& leases,
                                    const Registration& wish) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t token, leases.Propose(wish.robot, wish.take_over));
  const auto position = writer.Register({wish.robot, wish.radius_m, token});
  PLUMESCOUT_RETURN_IF_ERROR(WithField(position.status(), ""));
  leases.Grant(wish.robot, token);
  return Registered{token, *position};
}

}  // namespace

absl::Status RobotService::Register(const v1::RegisterRobotRequest& request,
                                    v1::RegisterRobotResponse* response,
                                    grpc::ServerUnaryReactor* reactor) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_RETURN_IF_ERROR(WithField(ValidateId("robot_id", request.robot_id()), ""));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(mission));
  const Registration wish{request.robot_id(), request.radius_m(), request.take_over()};
  return host->Post([this, host, wish, response, reactor](MissionWriter& writer) {
    const auto registered = server::Register(writer, host->leases(), wish);
    if (!registered.ok()) return Answer(reactor, registered.status());
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
  std::optional<std::int64_t> token;
  if (!request.force()) token = request.lease_token();
  return host->Post([host, robot = name.robot, token, response, reactor](MissionWriter& writer) {
    const auto revision = writer.Remove(robot, token);
    if (revision.ok()) {
      host->leases().Remove(robot);
      LogInfo("robot removed", {{"mission", host->id()}, {"robot", robot}});
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
