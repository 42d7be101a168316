// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/mission_routes.h"

#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "client/grpc_link.h"
#include "client/grpc_planner_client.h"
#include "core/types/error_reason.h"
#include "plumescout/v1/ingest_service.grpc.pb.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "proto/convert/status.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {
namespace mission_routes_test {

using testing::ElementsAre;

// Nodes behind one address: a call goes to the one that it names, or else to "n1". All missions are
// at `owner`; calls that come to a node in `dead` end as a front ends them.
class Nodes final {
 public:
  Nodes() : missions_(*this), robots_(*this), ingest_(*this) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(&missions_);
    builder.RegisterService(&robots_);
    builder.RegisterService(&ingest_);
    server_ = builder.BuildAndStart();
  }
  ~Nodes() { server_->Shutdown(std::chrono::system_clock::now()); }

  GrpcClientOptions Options() const {
    return {.target = absl::StrCat("127.0.0.1:", port_), .call_timeout = kPatience};
  }

  // "mission@node" of each call since the last look.
  std::vector<std::string> TakeCalls() {
    absl::MutexLock lock(&mutex_);
    return std::exchange(calls_, {});
  }

  std::string owner = "n2";
  std::string dead;
  grpc::StatusCode death = grpc::StatusCode::UNKNOWN;

 private:
  grpc::Status Enter(grpc::ServerContext& context) {
    const auto value = [&](const char* key) {
      const auto found = context.client_metadata().find(key);
      return found == context.client_metadata().end()
                 ? std::string()
                 : std::string(found->second.data(), found->second.size());
    };
    const std::string named = value("x-node");
    const std::string node = named.empty() ? "n1" : named;
    absl::MutexLock lock(&mutex_);
    calls_.push_back(absl::StrCat(value("x-mission-id"), "@", named));
    if (node == dead) return {death, "No status received"};
    if (node == owner) return grpc::Status::OK;
    const absl::Status elsewhere =
        WithReason(absl::UnavailableError("it is elsewhere"), reason::kMissionElsewhere);
    context.AddTrailingMetadata("x-owner", owner);
    return {grpc::StatusCode::UNAVAILABLE, "it is elsewhere",
            ToProto(elsewhere).SerializeAsString()};
  }

  struct Missions final : v1::MissionService::Service {
    explicit Missions(Nodes& nodes) : nodes(nodes) {}
    grpc::Status GetMission(grpc::ServerContext* context, const v1::GetMissionRequest*,
                            v1::GetMissionResponse*) override {
      return nodes.Enter(*context);
    }
    Nodes& nodes;
  };
  struct Robots final : v1::RobotService::Service {
    explicit Robots(Nodes& nodes) : nodes(nodes) {}
    grpc::Status WatchRobot(grpc::ServerContext* context, const v1::WatchRobotRequest*,
                            grpc::ServerWriter<v1::WatchRobotResponse>*) override {
      return nodes.Enter(*context);
    }
    Nodes& nodes;
  };
  struct Ingest final : v1::IngestService::Service {
    explicit Ingest(Nodes& nodes) : nodes(nodes) {}
    grpc::Status StreamObservations(
        grpc::ServerContext* context,
        grpc::ServerReaderWriter<v1::StreamObservationsResponse, v1::StreamObservationsRequest>*
            stream) override {
      const grpc::Status entered = nodes.Enter(*context);
      if (!entered.ok()) return entered;
      v1::StreamObservationsResponse opened;
      opened.mutable_opened();
      stream->Write(opened);
      for (v1::StreamObservationsRequest frame; stream->Read(&frame);) continue;
      return entered;
    }
    Nodes& nodes;
  };

  Missions missions_;
  Robots robots_;
  Ingest ingest_;
  absl::Mutex mutex_;
  std::vector<std::string> calls_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

absl::Status Get(const GrpcLink& link, const std::string& mission = "house") {
  v1::MissionService::Stub stub(link.channel());
  v1::GetMissionRequest request;
  request.set_name("missions/" + mission);
  v1::GetMissionResponse response;
  return link.Ask(stub, &v1::MissionService::Stub::GetMission, request, &response);
}

TEST(MissionRoutesTest, CallsGoWhereTheMissionIsAndAreRememberedThere) {
  Nodes nodes;
  const GrpcLink link(nodes.Options());
  EXPECT_EQ(Get(link), absl::OkStatus());
  EXPECT_EQ(Get(link), absl::OkStatus());
  EXPECT_EQ(Get(link, "yard"), absl::OkStatus());
  EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@", "house@n2", "house@n2", "yard@", "yard@n2"));
  nodes.owner = "n3";
  EXPECT_EQ(Get(link), absl::OkStatus());
  EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@n2", "house@n3"));
}

TEST(MissionRoutesTest, ANodeThatDoesNotAnswerIsForgotten) {
  for (const auto death :
       {grpc::StatusCode::UNKNOWN, grpc::StatusCode::INTERNAL, grpc::StatusCode::UNAVAILABLE}) {
    Nodes nodes;
    const GrpcLink link(nodes.Options());
    ASSERT_EQ(Get(link), absl::OkStatus());
    nodes.TakeCalls();
    nodes.death = death;
    nodes.dead = "n2";
    nodes.owner = "n1";
    EXPECT_EQ(Get(link), absl::OkStatus()) << "it only reads: it is asked again";
    EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@n2", "house@"));
  }
}

TEST(MissionRoutesTest, ANodeThatDrainsIsForgottenAndOneThatRecoversIsNot) {
  const auto told = [&](absl::string_view reason) {
    const absl::Status status = WithReason(absl::UnavailableError("not now"), reason);
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "", ToProto(status).SerializeAsString());
  };
  Nodes nodes;
  const GrpcLink link(nodes.Options());
  ASSERT_EQ(Get(link), absl::OkStatus());
  grpc::ClientContext context;
  link.routes().Address("house", context);
  EXPECT_FALSE(link.routes().Note("house", "n2", told(reason::kRecovering), context));
  nodes.TakeCalls();
  ASSERT_EQ(Get(link), absl::OkStatus());
  EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@n2"));
  EXPECT_FALSE(link.routes().Note("house", "n3", told(reason::kDraining), context));
  ASSERT_EQ(Get(link), absl::OkStatus());
  EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@n2")) << "it was another node";
  EXPECT_FALSE(link.routes().Note("house", "n2", told(reason::kDraining), context));
  ASSERT_EQ(Get(link), absl::OkStatus());
  EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@", "house@n2"));
}

TEST(MissionRoutesTest, ServersThatSendACallRoundInCirclesAreLeftAlone) {
  Nodes nodes;
  const GrpcLink link(nodes.Options());
  nodes.owner = "bad value";  // it cannot be said again
  EXPECT_EQ(Reason(Get(link)), reason::kMissionElsewhere);
  EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@"));

  grpc::ClientContext context;
  MissionRoutes routes;
  EXPECT_EQ(routes.Address("two words", context), "") << "gRPC would abort";
}

TEST(MissionRoutesTest, StreamsGoThereToo) {
  Nodes nodes;
  const auto client = MakeGrpcPlannerClient(nodes.Options());
  RobotSession session;
  session.mission = "house";
  session.robot = "scout";
  {
    const auto stream = client->OpenObservationStream(session);
    ASSERT_TRUE(stream.ok()) << stream.status();
    EXPECT_EQ((*stream)->Finish(), absl::OkStatus());
  }
  EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@", "house@n2"));
  nodes.owner = "n3";
  {
    const auto watch = client->WatchRobot(session);
    ASSERT_TRUE(watch.ok()) << watch.status();
    const absl::Status ended = (*watch)->Read(kPatience).status();
    EXPECT_EQ(Reason(ended), "") << ended << ": it has come to its server, which ended it";
  }
  EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@n2", "house@n3"));
  nodes.dead = "n3";
  EXPECT_FALSE(client->OpenObservationStream(session).ok());
  nodes.dead = "";
  nodes.owner = "n1";
  EXPECT_TRUE(client->OpenObservationStream(session).ok());
  EXPECT_THAT(nodes.TakeCalls(), ElementsAre("house@n3", "house@"));
}

TEST(MissionOfTest, FindsItInEveryKindOfRequest) {
  v1::RegisterRobotRequest registration;
  registration.set_mission("missions/house");
  registration.set_robot_id("scout");
  EXPECT_EQ(MissionOf(registration), "house");
  v1::CreateMissionRequest creation;
  EXPECT_EQ(MissionOf(creation), "");
  creation.set_mission_id("house");
  EXPECT_EQ(MissionOf(creation), "house");
  v1::UpdateMissionRequest update;
  update.mutable_mission()->set_name("missions/house");
  EXPECT_EQ(MissionOf(update), "house");
  v1::BatchIngestObservationsRequest batch;
  batch.mutable_open()->set_robot("missions/house/robots/scout");
  EXPECT_EQ(MissionOf(batch), "house");
  v1::OrderHomeRequest order;
  order.set_robot("missions/house/robots/scout");
  EXPECT_EQ(MissionOf(order), "house");
  EXPECT_EQ(MissionOf(v1::ListMissionsRequest()), "");
}

}  // namespace mission_routes_test
}  // namespace plumescout::client
