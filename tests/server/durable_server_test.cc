// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of servers whose missions outlive them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <string>
#include <thread>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "tests/server/held_store.h"
#include "tests/server/service_fixture.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace durable_server_test {

using ::testing::HasSubstr;

constexpr auto kUnavailable = absl::StatusCode::kUnavailable;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;

class DurableServerTest : public ServiceTest {
 protected:
  ~DurableServerTest() override {
    store_.Release();
    server_.reset();
  }

  ServerConfig Config() {
    ServerConfig config;
    config.store.engine = kSqliteStore;
    config.store.folder = folder_.path();
    return config;
  }
  void Hold(RegistryHooks hooks = {}) {
    hooks.store = &store_;
    StartServer({}, std::move(hooks));
  }
  // A server on the same folder, after this one, whose missions are in memory again.
  void Restart() {
    server_.reset();
    StartAgain(Config());
    AwaitRecovered();
  }
  void StartAgain(ServerConfig config) {
    config.listen = "127.0.0.1:0";
    auto server = Server::Start(config);
    ASSERT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
    Connect(absl::StrCat("127.0.0.1:", server_->port()));
  }
  void AwaitRecovered() {
    const SteadyTime deadline = After(SteadyNow(), absl::Seconds(60));
    while (!server_->NotReady().empty()) {
      ASSERT_LT(SteadyNow(), deadline);
      std::this_thread::yield();
    }
  }
  v1::Mission Get() {
    v1::GetMissionRequest request;
    request.set_name("missions/hall");
    const auto response = Call(missions_, &v1::MissionService::Stub::GetMission, request);
    EXPECT_TRUE(response.ok()) << response.status();
    return response.ok() ? response->mission() : v1::Mission();
  }
  absl::Status Pause() {
    v1::PauseMissionRequest request;
    request.set_name("missions/hall");
    return Call(missions_, &v1::MissionService::Stub::PauseMission, request).status();
  }
  template <typename Work>
  static auto Begin(Work work) {
    return std::async(std::launch::async, work);
  }

  const TempFolder folder_;
  HeldStore store_;
};

TEST_F(DurableServerTest, MissionsComeBackByteForByte) {
  StartServer(Config());
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  const auto sent = Ingest(kRobot, lease, GasReadings(2, 20));
  ASSERT_TRUE(sent.ok()) << sent.status();
  EXPECT_EQ(sent->ingest_state().durable_sequence(), 20) << "it waits until that is so";
  const auto plan = NextBest(PlanFor(lease));
  ASSERT_TRUE(plan.ok()) << plan.status();
  const auto map = GetMap(/*full_precision=*/true);
  ASSERT_TRUE(map.ok()) << map.status();
  ASSERT_TRUE(Pause().ok());
  const v1::Mission before = Get();
  Restart();
  const v1::Mission after = Get();
  EXPECT_EQ(after.revision(), before.revision());
  EXPECT_EQ(after.state(), v1::MISSION_STATE_PAUSED);
  EXPECT_EQ(after.owner(), before.owner());
  EXPECT_EQ(after.options().SerializeAsString(), before.options().SerializeAsString());
  EXPECT_EQ(GetMap(/*full_precision=*/true)->SerializeAsString(), map->SerializeAsString());
  EXPECT_THAT(NextBest(PlanFor(lease)).status(), Refuses(kPrecondition, "MISSION_PAUSED"));
  v1::ResumeMissionRequest resume;
  resume.set_name("missions/hall");
  ASSERT_TRUE(Call(missions_, &v1::MissionService::Stub::ResumeMission, resume).ok());
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(21, 22)).ok()) << "the lease holds on";
  const auto next = NextBest(PlanFor(lease));
  ASSERT_TRUE(next.ok()) << next.status();
  EXPECT_EQ(plan->plan().name(), "missions/hall/plans/1");
  EXPECT_EQ(next->plan().name(), "missions/hall/plans/2");
}

TEST_F(DurableServerTest, DeletedMissionsDoNotComeBack) {
  StartServer(Config());
  ASSERT_TRUE(DeleteMission("hall").ok());
  Restart();
  v1::GetMissionRequest request;
  request.set_name("missions/hall");
  EXPECT_TRUE(
      absl::IsNotFound(Call(missions_, &v1::MissionService::Stub::GetMission, request).status()));
}

TEST_F(DurableServerTest, TwoServersOnOneFolderAreOneTooMany) {
  StartServer(Config());
  ServerConfig config = Config();
  config.listen.clear();
  const absl::Status second = Server::Start(config).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(second)) << second;
  EXPECT_THAT(std::string(second.message()), HasSubstr(folder_.path()));
}

TEST_F(DurableServerTest, AStreamHearsWhatIsAppliedAndThenWhatIsDurable) {
  Hold();
  const std::int64_t lease = Lease();
  store_.Hold();
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease));
  EXPECT_EQ(stream.Read().opened().ingest_state().durable_sequence(), 0);
  ASSERT_TRUE(stream.Send(GasReadings(1, 5)));
  EXPECT_EQ(stream.ReadAck(5).durable_sequence(), 0);
  store_.AwaitHeld(1);
  ASSERT_TRUE(stream.Send(GasReadings(6, 7)));
  EXPECT_EQ(stream.ReadAck(7).durable_sequence(), 0);
  stream.HalfClose();
  store_.Release();
  std::int64_t durable = 0;
  for (auto frame = stream.Read(); frame.has_ack(); frame = stream.Read()) {
    EXPECT_GE(frame.ack().durable_sequence(), durable);
    durable = frame.ack().durable_sequence();
  }
  EXPECT_EQ(durable, 7) << "who has sent everything hears of it";
  EXPECT_TRUE(stream.Finish().ok());
}

TEST_F(DurableServerTest, AnswersWaitForTheDisk) {
  Hold();
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(2, 20)).ok());
  const auto waits = [&](auto work) {
    store_.Hold();
    auto call = Begin(work);
    store_.AwaitHeld(1);
    EXPECT_NE(call.wait_for(std::chrono::milliseconds(20)), std::future_status::ready);
    store_.Release();
    const absl::Status answer = call.get();
    EXPECT_TRUE(answer.ok()) << answer;
  };
  waits([&] { return Register("r2").status(); });
  waits([&] { return NextBest(PlanFor(lease)).status(); });
  waits([&] { return Ingest(kRobot, lease, GasReadings(21, 21)).status(); });
  waits([&] {
    v1::ReportProgressRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease);
    request.set_plan("missions/hall/plans/1");
    request.set_outcome(v1::ReportProgressRequest::OUTCOME_REACHED);
    return Call(planning_, &v1::PlanningService::Stub::ReportProgress, request).status();
  });
  waits([&] {
    v1::StreamNextBestTrajectoryRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease);
    request.mutable_planning_budget()->set_seconds(1);
    PlanStreamClient stream(*planning_, request);
    return stream.Finish();
  });
  waits([&] { return Pause(); });
  waits([&] {
    v1::ReleaseLeaseRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease);
    return Call(robots_, &v1::RobotService::Stub::ReleaseLease, request).status();
  });
  waits([&] { return DeleteMission("hall"); });
}

TEST_F(DurableServerTest, ADiskThatFailsMakesMissionsReadOnly) {
  Hold();
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  store_.set_state(Refusing("missions.db: no space"));
  const auto refused = Refuses(kUnavailable, "STORE_UNAVAILABLE");
  const absl::Status ingested = Ingest(kRobot, lease, GasReadings(2, 2)).status();
  EXPECT_THAT(ingested, refused);
  EXPECT_THAT(std::string(ingested.message()), HasSubstr("missions.db: no space"));
  EXPECT_TRUE(RetryDelay(ingested).has_value());
  EXPECT_THAT(Register("r2").status(), refused);
  EXPECT_THAT(NextBest(PlanFor(lease)).status(), refused);
  EXPECT_THAT(Pause(), refused);
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease));
  EXPECT_THAT(stream.Finish(), refused);
  EXPECT_TRUE(GetMap().ok());
  v1::CheckTrajectoryRequest check;
  check.set_robot(kRobot);
  check.set_lease_token(lease);
  check.mutable_path()->set_goal_kind(v1::GOAL_KIND_RANDOM_FREE_SPACE);
  v1::Point2D* const vertex = check.mutable_path()->add_vertices();
  vertex->set_x_m(0.5);
  vertex->set_y_m(0.5);
  const absl::Status checked =
      Call(planning_, &v1::PlanningService::Stub::CheckTrajectory, check).status();
  EXPECT_NE(Reason(checked), "STORE_UNAVAILABLE");
  EXPECT_THAT(server_->MetricsText(), HasSubstr("plumescout_store_available 0\n"));
  EXPECT_EQ(server_->Trouble(), "missions.db: no space");
  EXPECT_EQ(server_->NotReady(), "");
  store_.set_state({});
  EXPECT_TRUE(Ingest(kRobot, lease, GasReadings(2, 2)).ok());
  EXPECT_THAT(server_->MetricsText(), HasSubstr("plumescout_store_available 1\n"));
}

TEST_F(DurableServerTest, ARobotThatKnowsMoreThanTheServerIsTold) {
  Hold();
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(1, 5)).ok());
  v1::StreamObservationsRequest open;
  open.mutable_open()->set_robot(kRobot);
  open.mutable_open()->set_lease_token(lease);
  open.mutable_open()->set_durable_sequence(9);
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Write(open));
  const absl::Status refused = stream.Finish();
  EXPECT_THAT(refused, Refuses(kPrecondition, "STORE_ROLLED_BACK"));
  EXPECT_EQ(ReasonMetadata(refused).at("applied_sequence"), "5");
  EXPECT_THAT(server_->MetricsText(), HasSubstr("plumescout_store_rollbacks_total 1\n"));
  open.mutable_open()->set_durable_sequence(5);
  IngestClient again(*ingest_);
  ASSERT_TRUE(again.Write(open));
  EXPECT_EQ(again.Read().opened().ingest_state().durable_sequence(), 5);
  v1::BatchIngestObservationsRequest batch;
  *batch.mutable_open() = open.open();
  batch.mutable_open()->set_durable_sequence(6);
  *batch.mutable_batch() = GasReadings(7, 7);
  EXPECT_THAT(Call(ingest_, &v1::IngestService::Stub::BatchIngestObservations, batch).status(),
              Refuses(kPrecondition, "STORE_ROLLED_BACK"));
}

TEST_F(DurableServerTest, ADrainEndsThoseWhoWaitForTheDisk) {
  Hold();
  store_.Hold();
  auto registered = Begin([&] { return Register("r1").status(); });
  store_.AwaitHeld(1);
  server_->Drain();
  EXPECT_FALSE(registered.get().ok());
  store_.Release();
}

TEST_F(DurableServerTest, DamagedMissionsAreListedAndRefused) {
  ASSERT_TRUE(store_.Create("bad", "rubbish").ok());
  Hold();
  AwaitRecovered();
  v1::GetMissionRequest request;
  request.set_name("missions/bad");
  EXPECT_THAT(Call(missions_, &v1::MissionService::Stub::GetMission, request).status(),
              Refuses(absl::StatusCode::kDataLoss, "STORE_DAMAGED"));
  const auto page =
      Call(missions_, &v1::MissionService::Stub::ListMissions, v1::ListMissionsRequest());
  ASSERT_TRUE(page.ok()) << page.status();
  ASSERT_EQ(page->missions_size(), 2);
  EXPECT_EQ(page->missions(0).name(), "missions/bad");
  EXPECT_EQ(page->missions(0).state(), v1::MISSION_STATE_DAMAGED);
  EXPECT_THAT(page->missions(0).damage(), HasSubstr("missions/bad: "));
  EXPECT_EQ(page->missions(1).state(), v1::MISSION_STATE_RUNNING);
  v1::ListMissionsRequest first;
  first.set_page_size(1);
  const auto short_page = Call(missions_, &v1::MissionService::Stub::ListMissions, first);
  ASSERT_EQ(short_page->missions_size(), 1);
  first.set_page_token(short_page->next_page_token());
  const auto rest = Call(missions_, &v1::MissionService::Stub::ListMissions, first);
  ASSERT_EQ(rest->missions_size(), 1);
  EXPECT_EQ(rest->missions(0).name(), "missions/hall");
  EXPECT_EQ(rest->next_page_token(), "");
  EXPECT_THAT(server_->MetricsText(), HasSubstr("plumescout_missions_damaged 1\n"));
  EXPECT_THAT(server_->MetricsText(),
              HasSubstr("plumescout_mission_durable_revision{mission=\"hall\"} 0\n"));
}

TEST_F(DurableServerTest, DamagedMissionsCanBeDeleted) {
  ASSERT_TRUE(store_.Create("bad", "rubbish").ok());
  Hold();
  AwaitRecovered();
  v1::DeleteMissionRequest request;
  request.set_name("missions/bad");
  const auto deleted = Call(missions_, &v1::MissionService::Stub::DeleteMission, request);
  EXPECT_TRUE(deleted.ok()) << deleted.status();
  EXPECT_THAT(Call(missions_, &v1::MissionService::Stub::DeleteMission, request).status(),
              Refuses(absl::StatusCode::kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_TRUE(absl::IsNotFound(store_.Peek("bad").status()));
}

}  // namespace durable_server_test
}  // namespace plumescout::server
