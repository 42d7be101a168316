// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/robot_service.h"

#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"
#include "proto/convert/robot.h"
#include "proto/convert/robot_frame.h"
#include "server/base/log.h"
#include "server/calls/answer_once.h"
#include "server/services/paging.h"
#include "server/services/robot_message.h"
#include "server/streams/ingest_frames.h"
#include "server/streams/robot_watch_stream.h"

namespace plumescout::server {
namespace {

// A look at the robots is neither for fresh gas nor for a map.
BeliefWish JustTheRobots() {
  BeliefWish wish;
  wish.fresh_posterior = false;
  return wish;
}

}  // namespace

absl::Status RobotService::Register(const v1::RegisterRobotRequest& request,
                                    v1::RegisterRobotResponse* response,
                                    const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_RETURN_IF_ERROR(WithField(ValidateId("robot_id", request.robot_id()), ""));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const auto host, context_.FindMissionOf(call->caller(), {mission, request.robot_id()}));
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotFrame frame, FromProto(request.frame(), "frame"));
  const Registration wish{
      request.robot_id(),       request.radius_m(), request.take_over(), request.log_epoch(), frame,
      SensorsFromProto(request)};
  return AnswerOnce(host->requests(), request.request_id(), request, response, call,
                    [this, host, wish, response](const std::shared_ptr<UnaryCall>& runner) {
                      return Join(host, wish, response, runner);
                    });
}

absl::Status RobotService::Join(const std::shared_ptr<MissionHost>& host, const Registration& wish,
                                v1::RegisterRobotResponse* response,
                                const std::shared_ptr<UnaryCall>& call) {
  return PostFor(call, *host, [this, host, wish, response, call](MissionWriter& writer) {
    const absl::Status writable = host->CheckMayWrite();
    if (!writable.ok()) return call->Answer(writable);
    const auto registered = writer.conduct().Register(wish, host->leases());
    if (!registered.ok()) return call->Answer(WithField(registered.status(), ""));
    LogInfo("robot registered", {{"mission", host->id()},
                                 {"robot", wish.robot},
                                 {"lease", absl::StrCat(registered->lease_token)},
                                 {"request_id", call->info().request_id}});
    response->set_robot(RobotResource({host->id(), wish.robot}));
    response->set_lease_token(registered->lease_token);
    response->set_log_continues(registered->log_continues);
    response->set_server_boot_id(context_.boot_id);
    *response->mutable_ingest_state() =
        ToIngestState(registered->position, wish.robot, host->journal(),
                      context_.limits.stream_window_observations);
    AnswerWhenDurable(host, call, absl::OkStatus());
  });
}

grpc::ServerUnaryReactor* RobotService::RegisterRobot(grpc::CallbackServerContext* context,
                                                      const v1::RegisterRobotRequest* request,
                                                      v1::RegisterRobotResponse* response) {
  return UnaryCall::Start(context_, Rpc::kRegisterRobot, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Register(*request, response, call);
                          });
}

absl::Status RobotService::Remove(const v1::RemoveRobotRequest& request,
                                  v1::RemoveRobotResponse* response,
                                  const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMissionOf(call->caller(), name));
  Removal wish{name.robot};
  if (!request.force()) wish.lease_token = request.lease_token();
  return PostFor(call, *host, [host, wish, response, call](MissionWriter& writer) {
    const absl::Status writable = host->CheckMayWrite();
    if (!writable.ok()) return call->Answer(writable);
    const auto revision = writer.conduct().Remove(wish, host->leases());
    if (revision.ok()) {
      host->latest_plans().Forget(wish.robot);
      LogInfo("robot removed", {{"mission", host->id()},
                                {"robot", wish.robot},
                                {"request_id", call->info().request_id}});
      response->set_revision(*revision);
    }
    AnswerWhenDurable(host, call, revision.status());
  });
}

grpc::ServerUnaryReactor* RobotService::RemoveRobot(grpc::CallbackServerContext* context,
                                                    const v1::RemoveRobotRequest* request,
                                                    v1::RemoveRobotResponse* response) {
  return UnaryCall::Start(context_, Rpc::kRemoveRobot, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Remove(*request, response, call);
                          });
}

absl::Status RobotService::Get(const v1::GetRobotRequest& request, v1::GetRobotResponse* response,
                               const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("name", request.name()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), name.mission));
  return AnswerFromBelief(host, context_.query_pool, call, JustTheRobots(),
                          [host, response, robot = name.robot](const Belief& belief) {
                            const auto found = belief.robots.find(robot);
                            if (found == belief.robots.end()) return RobotNotFound(robot);
                            *response->mutable_robot() =
                                DescribeRobot(found->second, belief, *host);
                            return absl::OkStatus();
                          });
}

grpc::ServerUnaryReactor* RobotService::GetRobot(grpc::CallbackServerContext* context,
                                                 const v1::GetRobotRequest* request,
                                                 v1::GetRobotResponse* response) {
  return UnaryCall::Start(
      context_, Rpc::kGetRobot, context,
      [=, this](const std::shared_ptr<UnaryCall>& call) { return Get(*request, response, call); });
}

absl::Status RobotService::List(const v1::ListRobotsRequest& request,
                                v1::ListRobotsResponse* response,
                                const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Page page, ReadPage(request.page_size(), request.page_token()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), mission));
  return AnswerFromBelief(
      host, context_.query_pool, call, JustTheRobots(),
      [host, response, page](const Belief& belief) {
        auto next = belief.robots.upper_bound(page.after);
        for (; next != belief.robots.end() && response->robots_size() < page.size; ++next) {
          *response->add_robots() = DescribeRobot(next->second, belief, *host);
        }
        if (next != belief.robots.end()) {
          response->set_next_page_token(PageTokenAfter(std::prev(next)->first));
        }
        return absl::OkStatus();
      });
}

grpc::ServerUnaryReactor* RobotService::ListRobots(grpc::CallbackServerContext* context,
                                                   const v1::ListRobotsRequest* request,
                                                   v1::ListRobotsResponse* response) {
  return UnaryCall::Start(
      context_, Rpc::kListRobots, context,
      [=, this](const std::shared_ptr<UnaryCall>& call) { return List(*request, response, call); });
}

absl::Status RobotService::Release(const v1::ReleaseLeaseRequest& request,
                                   const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMissionOf(call->caller(), name));
  const auto token =
      request.force() ? std::nullopt : std::optional<std::int64_t>(request.lease_token());
  PLUMESCOUT_RETURN_IF_ERROR(host->journal().CheckTakesMore());
  PLUMESCOUT_RETURN_IF_ERROR(host->leases().Release(name.robot, token));
  host->KeepStanding();
  LogInfo("lease released", {{"mission", host->id()},
                             {"robot", name.robot},
                             {"caller", call->caller().name},
                             {"request_id", call->info().request_id}});
  AnswerWhenDurable(host, call, absl::OkStatus());
  return absl::OkStatus();
}

grpc::ServerUnaryReactor* RobotService::ReleaseLease(grpc::CallbackServerContext* context,
                                                     const v1::ReleaseLeaseRequest* request,
                                                     v1::ReleaseLeaseResponse*) {
  return UnaryCall::Start(
      context_, Rpc::kReleaseLease, context,
      [=, this](const std::shared_ptr<UnaryCall>& call) { return Release(*request, call); });
}

absl::Status RobotService::Order(const v1::OrderHomeRequest& request,
                                 v1::OrderHomeResponse* response,
                                 const std::shared_ptr<UnaryCall>& call) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ReadHomeOrder(request));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(call->caller(), name.mission));
  const auto run = [host, name, response,
                    home = request.home()](const std::shared_ptr<UnaryCall>& runner) {
    return PostFor(runner, *host, [host, name, home, response, runner](MissionWriter& writer) {
      const absl::Status writable = host->CheckMayWrite();
      if (!writable.ok()) return runner->Answer(writable);
      const auto robots =
          name.robot.empty() ? writer.mission().RobotIds() : std::vector<RobotId>{name.robot};
      const auto revision = writer.conduct().OrderHome(robots, home);
      if (revision.ok()) {
        LogInfo(home ? "robots sent home" : "robots called back to work",
                {{"mission", host->id()},
                 {"robot", name.robot.empty() ? "all" : name.robot},
                 {"caller", runner->caller().name},
                 {"request_id", runner->info().request_id}});
        response->set_revision(*revision);
      }
      AnswerWhenDurable(host, runner, revision.status());
    });
  };
  return AnswerOnce(host->requests(), request.request_id(), request, response, call, run);
}

grpc::ServerUnaryReactor* RobotService::OrderHome(grpc::CallbackServerContext* context,
                                                  const v1::OrderHomeRequest* request,
                                                  v1::OrderHomeResponse* response) {
  return UnaryCall::Start(context_, Rpc::kOrderHome, context,
                          [=, this](const std::shared_ptr<UnaryCall>& call) {
                            return Order(*request, response, call);
                          });
}

grpc::ServerWriteReactor<v1::WatchRobotResponse>* RobotService::WatchRobot(
    grpc::CallbackServerContext* context, const v1::WatchRobotRequest* request) {
  return RobotWatchStream::Start(&context_, context, *request);
}

}  // namespace plumescout::server
