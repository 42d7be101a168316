// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_viewer_client.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "client/error_reason.h"
#include "client/grpc_operator_client.h"
#include "client/grpc_planner_client.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "server/server.h"
#include "tests/client/ingest_traffic.h"
#include "tests/support/memory_store.h"

namespace plumescout::client {
namespace grpc_viewer_client_test {

// A server with a mission, "house", in which a robot has looked around and smelt something.
class GrpcViewerClientTest : public ::testing::Test {
 protected:
  void SetUp() override {
    store_ = std::make_unique<server::MemoryStore>(/*is_durable=*/true);
    server::RegistryHooks hooks;
    hooks.store = store_.get();
    server::ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.planning.max_budget_s = 60.0;  // enough on any machine
    auto started = server::Server::Start(config, hooks);
    ASSERT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
    const auto link = MakeGrpcLink(
        {.target = absl::StrCat("127.0.0.1:", server_->port()), .call_timeout = kPatience});
    robots_ = MakeGrpcPlannerClient(link);
    viewer_ = MakeGrpcViewerClient(link);
    operator_ = MakeGrpcOperatorClient(link);
    ASSERT_EQ(robots_->CreateMission("house", {}), absl::OkStatus());
    const auto session = robots_->RegisterRobot("house", "scout", 0.2, false);
    ASSERT_TRUE(session.ok()) << session.status();
    session_ = *session;
    Send(LookAround(kScans));
    Send({GasAt(kScans + 1)});
  }
  void Send(const std::vector<Observation>& batch) {
    const auto reply = robots_->IngestBatch(session_, batch);
    ASSERT_TRUE(reply.ok()) << reply.status();
    EXPECT_TRUE(reply->rejected.empty());
    EXPECT_EQ(reply->state.applied_sequence, LastSequence(batch.back()));
  }
  PlanQuery Query() const {
    PlanQuery query{.lease_token = session_.lease_token, .timeout = kPatience};
    query.request.robot = "scout";
    return query;
  }

  static constexpr int kScans = 5;
  std::unique_ptr<server::MemoryStore> store_;
  std::unique_ptr<server::Server> server_;
  std::unique_ptr<PlannerClient> robots_;
  std::unique_ptr<ViewerClient> viewer_;
  std::unique_ptr<OperatorClient> operator_;
  RobotSession session_;
};

TEST_F(GrpcViewerClientTest, MissionsAreTold) {
  ASSERT_EQ(robots_->CreateMission("attic", {}), absl::OkStatus());
  const auto missions = viewer_->ListMissions();
  ASSERT_TRUE(missions.ok()) << missions.status();
  ASSERT_EQ(missions->size(), 2U);
  EXPECT_EQ((*missions)[0].id, "attic");
  EXPECT_EQ((*missions)[1].id, "house");
  const auto house = viewer_->GetMission("house");
  ASSERT_TRUE(house.ok()) << house.status();
  EXPECT_EQ(house->state, MissionState::kRunning);
  EXPECT_EQ(house->robot_count, 1);
  EXPECT_EQ(ErrorReason(viewer_->GetMission("cellar").status()), reason::kMissionNotFound);
}

TEST_F(GrpcViewerClientTest, AWatchedMapIsTheMap) {
  const auto watch = viewer_->WatchMap("house", {.view = {.full_precision = true}});
  ASSERT_TRUE(watch.ok()) << watch.status();
  const auto changes = (*watch)->Read(kPatience);
  ASSERT_TRUE(changes.ok()) << changes.status();
  EXPECT_TRUE(changes->everything);
  const auto map = viewer_->GetMap("house", {});
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ((*watch)->map().occupancy, map->occupancy);
  ASSERT_EQ(map->robots.size(), 1U);
  EXPECT_EQ(map->robots[0].id, "scout");
}

TEST_F(GrpcViewerClientTest, LayersThatWereNotAskedForAreUnknown) {
  const auto gas = viewer_->GetMap(
      "house", {.view = {.occupancy = false, .gas_variance = false}, .fresh_posterior = true});
  ASSERT_TRUE(gas.ok()) << gas.status();
  const Cell here = gas->occupancy.geometry().CellAt({0.0, 0.0});
  EXPECT_EQ(gas->occupancy[here], CellState::kUnknown);
  EXPECT_FALSE(std::isnan(gas->gas_mean_ppm[here]));
  EXPECT_TRUE(std::isnan(gas->gas_variance_ppm2[here]));
}

TEST_F(GrpcViewerClientTest, GasIsToldOfPlaces) {
  const auto answer =
      viewer_->QueryGas("house", {.points = {{0.0, 0.0}, {500.0, 0.0}}, .fresh_posterior = true});
  ASSERT_TRUE(answer.ok()) << answer.status();
  ASSERT_EQ(answer->gas.size(), 2U);
  EXPECT_EQ(answer->gas[0].state, CellState::kFree);
  EXPECT_TRUE(answer->gas[0].mean_ppm.has_value());
  EXPECT_EQ(answer->gas[1].state, std::nullopt) << "off the map";
  const auto then = viewer_->QueryGas("house", {.points = {{0.0, 0.0}}, .revision = 1});
  ASSERT_TRUE(then.ok()) << then.status();
  EXPECT_EQ(then->revision, 1);
  EXPECT_EQ(RefusedFields(viewer_->QueryGas("house", {}).status()),
            std::vector<std::string>{"points"});
}

TEST_F(GrpcViewerClientTest, HowTheObjectiveStandsIsToldOfPlacesIfAskedFor) {
  MissionOptions clean;
  clean.objective = {.kind = ObjectiveKind::kConfirmClean, .threshold_ppm = 10.0};
  ASSERT_EQ(robots_->CreateMission("attic", clean), absl::OkStatus());
  const auto session = robots_->RegisterRobot("attic", "scout", 0.2, false);
  ASSERT_TRUE(session.ok()) << session.status();
  session_ = *session;
  Send(LookAround(kScans));
  Send({GasAt(kScans + 1)});
  GasQuery query{.points = {{0.0, 0.0}, {500.0, 0.0}}, .fresh_posterior = true};
  const auto without = viewer_->QueryGas("attic", query);
  ASSERT_TRUE(without.ok()) << without.status();
  EXPECT_EQ(without->gas[0].verdict, std::nullopt);
  query.with_verdicts = true;
  const auto with = viewer_->QueryGas("attic", query);
  ASSERT_TRUE(with.ok()) << with.status();
  EXPECT_TRUE(with->gas[0].verdict.has_value());
  EXPECT_EQ(with->gas[1].verdict, std::nullopt) << "off the map";
}

TEST_F(GrpcViewerClientTest, PlansAndFrontiersAreListed) {
  const auto frontiers = viewer_->ListFrontiers("house", "scout");
  ASSERT_TRUE(frontiers.ok()) << frontiers.status();
  EXPECT_GE(frontiers->revision, kScans);
  const auto stream = robots_->StreamNextBestTrajectory("house", Query());
  ASSERT_TRUE(stream.ok()) << stream.status();
  std::optional<Plan> last;
  for (auto plan = (*stream)->Read(kPatience); plan.ok() && *plan;
       plan = (*stream)->Read(kPatience)) {
    last = *plan;
  }
  ASSERT_TRUE(last.has_value());
  EXPECT_GT(last->id, 0);
  const auto plans = viewer_->ListPlans("house", /*with_latest=*/true);
  ASSERT_TRUE(plans.ok()) << plans.status();
  ASSERT_EQ(plans->latest.size(), 1U);
  EXPECT_EQ(plans->latest[0].id, last->id);
  for (const LivePlan& live : plans->live) {
    EXPECT_EQ(live.plan, last->id);
    EXPECT_EQ(live.robot, "scout");
    EXPECT_EQ(live.trajectory, last->trajectory);
  }
}

TEST_F(GrpcViewerClientTest, HistoryIsReadByPages) {
  HistoryQuery query{.kinds = {MissionEventKind::kScan}, .page_size = 2};
  std::vector<MissionEvent> events;
  do {
    const auto page = viewer_->GetHistory("house", query);
    ASSERT_TRUE(page.ok()) << page.status();
    EXPECT_LE(page->events.size(), 2U);
    events.insert(events.end(), page->events.begin(), page->events.end());
    query.page_token = page->next_page_token;
  } while (!query.page_token.empty());
  ASSERT_EQ(events.size(), static_cast<std::size_t>(kScans));
  EXPECT_EQ(events[0].kind, MissionEventKind::kScan);
  EXPECT_EQ(events[0].robot, "scout");
}

TEST_F(GrpcViewerClientTest, FiguresLeadFromTheBeginningToNow) {
  absl::StatusOr<FigureHistory> history = viewer_->GetFigures("house");
  const absl::Time end = absl::Now() + absl::Seconds(60);
  while (history.ok() && history->more_follow && absl::Now() < end) {
    absl::SleepFor(absl::Milliseconds(10));  // callers without a pause are refused
    history = viewer_->GetFigures("house");
  }
  ASSERT_TRUE(history.ok()) << history.status();
  ASSERT_FALSE(history->more_follow);
  ASSERT_FALSE(history->figures.empty());
  const MissionFigures& last = history->figures.back();
  EXPECT_GT(last.known_area_m2, 0.0);
  EXPECT_GT(last.elapsed_s, 0.0);
  ASSERT_EQ(last.gases.size(), 1U);
  EXPECT_GT(last.gases[0].in_posterior, 0);
  EXPECT_EQ(last.applied_sequences.count("scout"), 1U);
}

TEST_F(GrpcViewerClientTest, AMissionIsCopiedByItsFile) {
  std::string file;
  const MissionFileSink into = [&](const MissionFilePiece& piece) {
    file.append(piece.bytes.data(), piece.bytes.size());
    return absl::OkStatus();
  };
  ASSERT_TRUE(operator_->ExportMission("house", MissionFileFormat::kMcap, into).ok());
  EXPECT_EQ(file.substr(1, 4), "MCAP");
  file.clear();
  const auto exported = operator_->ExportMission("house", MissionFileFormat::kJournal, into);
  ASSERT_TRUE(exported.ok()) << exported.status();
  const auto source = [&](std::size_t max_bytes) {
    const std::string piece = file.substr(0, max_bytes);
    file.erase(0, piece.size());
    return piece;
  };
  const auto copy = operator_->ImportMission("copy", source);
  ASSERT_TRUE(copy.ok()) << copy.status();
  EXPECT_EQ(*copy, "copy");
  EXPECT_EQ(viewer_->GetMission("copy")->revision, exported->revision);
  EXPECT_EQ(viewer_->GetMap("copy", {})->occupancy, viewer_->GetMap("house", {})->occupancy);
}

TEST_F(GrpcViewerClientTest, APathIsCheckedAndALeaseGivenBack) {
  const auto check = robots_->CheckTrajectory(
      session_, {.subject = IntendedPath{.vertices = {{0.0, 0.0}, {100.0, 0.0}},
                                         .goal_kind = GoalKind::kRandomFreeSpace}});
  ASSERT_TRUE(check.ok()) << check.status();
  EXPECT_TRUE(check->verdict.blockage.has_value()) << "the room is 10 m wide";
  EXPECT_FALSE(check->verdict.rest.has_value());
  ASSERT_EQ(robots_->ReleaseLease(session_), absl::OkStatus());
  EXPECT_FALSE(viewer_->GetRobot("house", "scout")->leased);
}

// Tells of one robot whatever it is given.
class OtherRobots final : public v1::RobotService::Service {
 public:
  OtherRobots() {
    robot.mutable_on_map()->set_robot("missions/house/robots/scout");
    robot.set_link(v1::ROBOT_LINK_IDLE);
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~OtherRobots() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status GetRobot(grpc::ServerContext*, const v1::GetRobotRequest*,
                        v1::GetRobotResponse* response) override {
    *response->mutable_robot() = robot;
    return {};
  }
  grpc::Status ListRobots(grpc::ServerContext*, const v1::ListRobotsRequest*,
                          v1::ListRobotsResponse* response) override {
    *response->add_robots() = robot;
    return {};
  }
  std::unique_ptr<ViewerClient> Client() const {
    return MakeGrpcViewerClient(
        {.target = absl::StrCat("127.0.0.1:", port_), .call_timeout = kPatience});
  }

  v1::Robot robot;

 private:
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST(GrpcViewerClientOfOthersTest, ALinkThatIsNotKnownFailsNoList) {
  OtherRobots server;
  constexpr int kOfAnotherDay = 99;
  server.robot.set_link(static_cast<v1::RobotLink>(kOfAnotherDay));
  const auto robots = server.Client()->ListRobots("house");
  ASSERT_TRUE(robots.ok()) << robots.status();
  ASSERT_EQ(robots->size(), 1U);
  EXPECT_EQ(robots->front().link, RobotLink::kUnknown);
  EXPECT_EQ(robots->front().clock_offset_ns, std::nullopt);
}

TEST(GrpcViewerClientOfOthersTest, AnOffsetOfNothingIsAnOffset) {
  OtherRobots server;
  server.robot.set_clock_offset_s(0.0);
  const auto details = server.Client()->GetRobot("house", "scout");
  ASSERT_TRUE(details.ok()) << details.status();
  EXPECT_EQ(details->clock_offset_ns, 0);
}

TEST(GrpcViewerClientOfOthersTest, AnAnswerThatCannotBeReadIsTheServersFault) {
  OtherRobots server;
  server.robot.set_clock_offset_s(1e12);
  EXPECT_EQ(server.Client()->GetRobot("house", "scout").status().code(),
            absl::StatusCode::kInternal);
  EXPECT_EQ(server.Client()->ListRobots("house").status().code(), absl::StatusCode::kInternal);
}

}  // namespace grpc_viewer_client_test
}  // namespace plumescout::client
