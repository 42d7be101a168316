// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_link.h"

#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "plumescout/v1/mission_service.grpc.pb.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {
namespace grpc_link_test {

// Loses the first answer, and notes the names of requests.
class ForgetfulMissions final : public v1::MissionService::Service {
 public:
  ForgetfulMissions() {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~ForgetfulMissions() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status CreateMission(grpc::ServerContext*, const v1::CreateMissionRequest* request,
                             v1::CreateMissionResponse*) override {
    names.push_back(request->request_id());
    return names.size() == 1 ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "lost") : grpc::Status();
  }
  grpc::Status ListMissions(grpc::ServerContext*, const v1::ListMissionsRequest*,
                            v1::ListMissionsResponse*) override {
    return ++lists <= lists_lost ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "lost")
                                 : grpc::Status();
  }
  int port() const { return port_; }

  std::vector<std::string> names;
  int lists = 0;
  int lists_lost = 0;

 private:
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST(GrpcLinkTest, ARequestThatIsMadeAgainKeepsItsNameUntilItIsAnswered) {
  ForgetfulMissions server;
  GrpcLink link({.target = absl::StrCat("127.0.0.1:", server.port()), .call_timeout = kPatience});
  v1::MissionService::Stub stub(link.channel());
  v1::CreateMissionRequest request;
  request.set_mission_id("house");
  v1::CreateMissionResponse response;
  const auto make = [&] {
    return link.CallNamed(stub, &v1::MissionService::Stub::CreateMission, request, &response);
  };
  EXPECT_TRUE(absl::IsUnavailable(make()));
  EXPECT_EQ(make(), absl::OkStatus());
  EXPECT_EQ(make(), absl::OkStatus());
  ASSERT_EQ(server.names.size(), 3U);
  EXPECT_NE(server.names[0], "");
  EXPECT_EQ(server.names[1], server.names[0]);
  EXPECT_NE(server.names[2], server.names[0]);
}

TEST(GrpcLinkTest, WhatOnlyReadsIsAskedAgainIfItsConnectionBreaks) {
  ForgetfulMissions server;
  const GrpcLink link(
      {.target = absl::StrCat("127.0.0.1:", server.port()), .call_timeout = kPatience});
  v1::MissionService::Stub stub(link.channel());
  v1::ListMissionsResponse response;
  const auto ask = [&] {
    return link.Ask(stub, &v1::MissionService::Stub::ListMissions, v1::ListMissionsRequest(),
                    &response);
  };
  server.lists_lost = 2;
  EXPECT_EQ(ask(), absl::OkStatus());
  EXPECT_EQ(server.lists, 3);
  server.lists_lost = 1000;
  EXPECT_TRUE(absl::IsUnavailable(ask())) << "not for ever";
  EXPECT_EQ(server.lists, 6);
}

TEST(GrpcLinkTest, WithoutALinkItIsTheServerThatIsUnavailable) {
  int port = 0;
  { port = ForgetfulMissions().port(); }  // nobody listens there any more
  const GrpcLink link(
      {.target = absl::StrCat("127.0.0.1:", port), .call_timeout = absl::Milliseconds(150)});
  v1::MissionService::Stub stub(link.channel());
  v1::ListMissionsResponse response;
  const absl::Status status = link.Call(stub, &v1::MissionService::Stub::ListMissions,
                                        v1::ListMissionsRequest(), &response);
  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
  EXPECT_THAT(std::string(status.message()), testing::HasSubstr(link.options().target));
}

TEST(SetDurationTest, SaysWhatTheWireCanSay) {
  google::protobuf::Duration proto;
  SetDuration(absl::Milliseconds(1500), &proto);
  EXPECT_EQ(proto.seconds(), 1);
  EXPECT_EQ(proto.nanos(), 500'000'000);
  SetDuration(absl::InfiniteDuration(), &proto);
  EXPECT_EQ(proto.seconds(), 315'576'000'000);
  EXPECT_EQ(proto.nanos(), 0);
}

}  // namespace grpc_link_test
}  // namespace plumescout::client
