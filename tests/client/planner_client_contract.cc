// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/client/planner_client_contract.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "client/grpc_planner_client.h"
#include "lab/local/local_planner_client.h"
#include "server/server.h"

namespace plumescout::client {
namespace {

class LocalBackend final : public Backend {
 public:
  PlannerClient& client() override { return client_; }

 private:
  lab::LocalPlannerClient client_;
};

class GrpcBackend final : public Backend {
 public:
  GrpcBackend() {
    server::ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.planning.max_budget_s = 60.0;  // enough on any machine
    auto started = server::Server::Start(config);
    EXPECT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
    client_ = MakeGrpcPlannerClient({.target = absl::StrCat("127.0.0.1:", server_->port())});
  }
  PlannerClient& client() override { return *client_; }

 private:
  std::unique_ptr<server::Server> server_;
  std::unique_ptr<PlannerClient> client_;
};

}  // namespace

std::vector<BackendKind> AllBackends() {
  return {{"Local", [] { return std::make_unique<LocalBackend>(); }},
          {"Grpc", [] { return std::make_unique<GrpcBackend>(); }}};
}

std::string BackendName(const ::testing::TestParamInfo<BackendKind>& info) {
  return info.param.name;
}

void PlannerClientContract::SetUp() {
  ASSERT_EQ(client().CreateMission("house", MissionOptions{}), absl::OkStatus());
}

RobotSession PlannerClientContract::Register(const RobotId& robot) {
  absl::StatusOr<RobotSession> session =
      client().RegisterRobot("house", robot, kRadius_m, /*take_over=*/false);
  EXPECT_TRUE(session.ok()) << session.status();
  return session.ok() ? *session : RobotSession{};
}

std::unique_ptr<ObservationStream> PlannerClientContract::Open(const RobotSession& session) {
  auto stream = client().OpenObservationStream(session);
  EXPECT_TRUE(stream.ok()) << stream.status();
  return stream.ok() ? *std::move(stream) : nullptr;
}

PlanQuery PlannerClientContract::Query(const RobotSession& session,
                                       std::int64_t min_applied_sequence) {
  PlanQuery query;
  query.request.robot = session.robot;
  query.lease_token = session.lease_token;
  query.min_applied_sequence = min_applied_sequence;
  query.timeout = kPatience;
  return query;
}

}  // namespace plumescout::client
