// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Bad values of every field of every request: each is refused by name, changes nothing and leaves
// the server well.
#include "tests/server/bad_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "tests/server/bad_mission_input.h"
#include "tests/server/bad_robot_input.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace bad_input_test {

BadInputs BadMap() {
  return BadInputs()
      .Rows(BadMissionName("mission"))
      .ValuesBlaming("layers[0]", "layers", {"0", "99", "-1"});
}

BadInputs BadQueryGas() {
  using Request = v1::QueryGasRequest;
  const auto kInvalid = absl::StatusCode::kInvalidArgument;
  const std::initializer_list<const char*> off = {"nan", "inf", "-inf", "1001", "-1e300"};
  return BadInputs()
      .Rows(BadMissionName("mission"))
      .Row({"points", "none", [](Message& m) { static_cast<Request&>(m).clear_points(); }, kInvalid,
            "points"})
      .Row({"points", "too many",
            [](Message& m) {
              while (static_cast<Request&>(m).points_size() <= kMaxPoints) {
                static_cast<Request&>(m).add_points();
              }
            },
            kInvalid, "points"})
      .ValuesBlaming("points[0].x_m", "points.x_m", off)
      .ValuesBlaming("points[0].y_m", "points.y_m", off);
}

// The rows by the name of the request's type.
std::map<std::string, BadInputs> AllBadInputs() {
  const BadInputs ingest = BadInputs().Rows(BadBatch()).Rows(BadObservation());
  return {{"CreateMissionRequest", BadCreateMission()},
          {"GetMissionRequest", BadMissionName("name")},
          {"ListMissionsRequest", BadListMissions()},
          {"DeleteMissionRequest", BadMissionName("name")},
          {"RegisterRobotRequest", BadRegisterRobot()},
          {"RemoveRobotRequest", BadRemoveRobot()},
          {"StreamObservationsRequest", ingest},
          {"BatchIngestObservationsRequest", ingest},
          {"NextBestTrajectoryRequest", BadNextBest()},
          {"StreamNextBestTrajectoryRequest", BadNextBest()},
          {"CheckTrajectoryRequest", BadCheckTrajectory()},
          {"ListFrontiersRequest",
           BadInputs().Rows(BadRobotName("robot")).Rows(UnknownMission("robot"))},
          {"ReportProgressRequest", BadReportProgress()},
          {"QueryGasRequest", BadQueryGas()},
          {"GetMapRequest", BadMap()},
          {"WatchMapRequest", BadMap()}};
}

// Fields of which no value is bad, and messages that may be missing.
std::set<std::string> FreeFields() {
  return {
      // Every number is a seed; 0 has a meaning of its own.
      "CreateMissionRequest.options.seed",
      "NextBestTrajectoryRequest.seed",
      "StreamNextBestTrajectoryRequest.seed",
      // Both values of a bool are good.
      "CreateMissionRequest.options.planning.draw_goals",
      "CreateMissionRequest.options.planning.raw_variance",
      "CreateMissionRequest.options.planning.mixture_radius",
      "CreateMissionRequest.options.planning.grid_guard",
      "CreateMissionRequest.options.planning.fallback_to_unobserved",
      "CreateMissionRequest.options.planning.goal_vertices",
      "CreateMissionRequest.options.planning.informed_heuristic",
      "CreateMissionRequest.options.planning.straighten",
      "CreateMissionRequest.options.planning.return_home",
      "CreateMissionRequest.options.planning.sites.survey",
      "NextBestTrajectoryRequest.go_home",
      "StreamNextBestTrajectoryRequest.go_home",
      "RegisterRobotRequest.take_over",
      "RemoveRobotRequest.force",
      "GetMapRequest.full_precision",
      "GetMapRequest.fresh_posterior",
      "QueryGasRequest.fresh_posterior",
      "WatchMapRequest.full_precision",
      // Unset options are the server's.
      "CreateMissionRequest.options",
      "CreateMissionRequest.options.occupancy",
      "CreateMissionRequest.options.gas",
      "CreateMissionRequest.options.frontier",
      "CreateMissionRequest.options.planning",
      "CreateMissionRequest.options.planning.sites",
      "CreateMissionRequest.options.home",
      // Unset: the robot's latest pose, the server's budget.
      "NextBestTrajectoryRequest.start",
      "StreamNextBestTrajectoryRequest.start",
      "NextBestTrajectoryRequest.planning_budget",
      "StreamNextBestTrajectoryRequest.planning_budget",
      // Unset, they lack a name or observations, of which there are rows.
      "BatchIngestObservationsRequest.open",
      "BatchIngestObservationsRequest.batch",
      // What a frame holds; frames out of order and of nothing have a test below.
      "StreamObservationsRequest.frame",
      "StreamObservationsRequest.open",
      "StreamObservationsRequest.batch",
      // Parts of the payload, of which there is a row.
      "BatchIngestObservationsRequest.batch.observations.scan",
      "BatchIngestObservationsRequest.batch.observations.gas",
      "BatchIngestObservationsRequest.batch.observations.gap",
      "StreamObservationsRequest.batch.observations.scan",
      "StreamObservationsRequest.batch.observations.gas",
      "StreamObservationsRequest.batch.observations.gap",
  };
}

// The requests of all services.
std::vector<const Descriptor*> RequestTypes() {
  std::vector<const Descriptor*> types;
  for (const Descriptor* member :
       {v1::Mission::descriptor(), v1::RegisterRobotRequest::descriptor(),
        v1::IngestState::descriptor(), v1::Plan::descriptor(), v1::MapTile::descriptor()}) {
    const auto& file = *member->file();
    for (int i = 0; i < file.service_count(); ++i) {
      for (int j = 0; j < file.service(i)->method_count(); ++j) {
        types.push_back(file.service(i)->method(j)->input_type());
      }
    }
  }
  return types;
}

class BadInputTest : public ServiceTest {
 protected:
  using Sender = std::function<absl::Status(const Message&)>;

  // Mission "hall" has a robot with a scan, a reading and a plan, which leaves its posterior fresh.
  void SetUp() override {
    ServerConfig config;
    config.limits.max_total_cells = 3 * config.mission.occupancy.max_cell_count;
    StartServer(config);
    lease_ = Lease();
    ASSERT_TRUE(Ingest(kRobot, lease_, RoomScan(1)).ok());
    ASSERT_TRUE(Ingest(kRobot, lease_, GasReadings(2, 2)).ok());
    ASSERT_TRUE(NextBest(PlanFor(lease_)).ok());
  }

  template <typename Stub, typename Request, typename Response>
  Sender SenderOf(std::unique_ptr<Stub>& stub,
                  grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*)) {
    return [this, &stub, method](const Message& request) {
      return Call(stub, method, static_cast<const Request&>(request)).status();
    };
  }
  // The refusal of the batch or of its observation.
  absl::Status SendBatch(const Message& message) {
    const auto& request = static_cast<const v1::BatchIngestObservationsRequest&>(message);
    const auto response = Call(ingest_, &v1::IngestService::Stub::BatchIngestObservations, request);
    if (!response.ok()) return response.status();
    return response->rejections().empty() ? absl::OkStatus()
                                          : FromProto(response->rejections(0).status());
  }
  absl::Status SendOnStream(const Message& message) {
    const auto& request = static_cast<const v1::BatchIngestObservationsRequest&>(message);
    IngestClient stream(*ingest_);
    stream.Open(request.open().robot(), request.open().lease_token());
    stream.Send(request.batch());
    for (auto frame = stream.Read(); frame.frame_case() != 0; frame = stream.Read()) {
      if (frame.has_rejected()) return FromProto(frame.rejected().status());
    }
    return stream.Finish();
  }

  v1::BatchIngestObservationsRequest GoodBatch() {
    v1::BatchIngestObservationsRequest request;
    request.mutable_open()->set_robot(kRobot);
    request.mutable_open()->set_lease_token(lease_);
    *request.mutable_batch() = RoomScan(AppliedSequence() + 1);
    return request;
  }
  v1::ReportProgressRequest GoodReport() const {
    v1::ReportProgressRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease_);
    request.set_plan("missions/hall/plans/1");
    request.set_outcome(v1::ReportProgressRequest::OUTCOME_REACHED);
    return request;
  }

  std::int64_t AppliedSequence() { return GetMap()->status().robots(0).applied_sequence(); }
  // All that a bad request must not change: the map, and which missions there are.
  std::string State() {
    auto map = GetMap(/*full_precision=*/true);
    EXPECT_TRUE(map.ok()) << map.status();
    if (!map.ok()) return "";
    map->clear_revision();
    for (auto& robot : *map->mutable_status()->mutable_robots()) {
      robot.clear_applied_sequence();
      robot.clear_rejected_observation_count();
    }
    const auto list =
        Call(missions_, &v1::MissionService::Stub::ListMissions, v1::ListMissionsRequest());
    return absl::StrCat(map->SerializeAsString(), list->missions_size());
  }

  // `revisions`: by which a refusal moves the mission.
  void Check(const BadInputs& inputs, const std::function<std::unique_ptr<Message>()>& good,
             const Sender& send, int revisions = 0) {
    for (const BadInput& row : inputs.rows()) {
      SCOPED_TRACE(absl::StrCat(row.field, ": ", row.what.substr(0, 80)));
      const std::int64_t revision = Revision();
      const std::string state = State();
      const auto request = good();
      row.spoil(*request);
      const absl::Status refused = send(*request);
      if (row.code == absl::StatusCode::kInvalidArgument) {
        EXPECT_THAT(refused, RefusesField(row.blamed));
      } else {
        EXPECT_THAT(refused, Refuses(row.code, row.blamed));
      }
      EXPECT_EQ(Revision(), revision + revisions);
      EXPECT_TRUE(State() == state);  // not EXPECT_EQ: it would print the map
    }
  }
  template <typename Request>
  static std::function<std::unique_ptr<Message>()> Copies(const Request& request) {
    return [request] { return std::make_unique<Request>(request); };
  }
  std::function<std::unique_ptr<Message>()> GoodBatches() {
    return [this] { return std::make_unique<v1::BatchIngestObservationsRequest>(GoodBatch()); };
  }

  std::int64_t lease_ = 0;
};

TEST_F(BadInputTest, CreateMission) {
  v1::CreateMissionRequest good;
  good.set_mission_id("attic");
  Check(BadCreateMission(), Copies(good),
        SenderOf(missions_, &v1::MissionService::Stub::CreateMission));
}

TEST_F(BadInputTest, GetMission) {
  Check(BadMissionName("name"), Copies(v1::GetMissionRequest()),
        SenderOf(missions_, &v1::MissionService::Stub::GetMission));
}

TEST_F(BadInputTest, ListMissions) {
  Check(BadListMissions(), Copies(v1::ListMissionsRequest()),
        SenderOf(missions_, &v1::MissionService::Stub::ListMissions));
}

TEST_F(BadInputTest, DeleteMission) {
  Check(BadMissionName("name"), Copies(v1::DeleteMissionRequest()),
        SenderOf(missions_, &v1::MissionService::Stub::DeleteMission));
}

TEST_F(BadInputTest, RegisterRobot) {
  v1::RegisterRobotRequest good;
  good.set_mission("missions/hall");
  good.set_robot_id("r2");
  good.set_radius_m(0.2);
  Check(BadRegisterRobot(), Copies(good),
        SenderOf(robots_, &v1::RobotService::Stub::RegisterRobot));
}

TEST_F(BadInputTest, RemoveRobot) {
  v1::RemoveRobotRequest good;
  good.set_robot(kRobot);
  good.set_lease_token(lease_);
  Check(BadRemoveRobot(), Copies(good), SenderOf(robots_, &v1::RobotService::Stub::RemoveRobot));
}

TEST_F(BadInputTest, BatchIngestObservations) {
  const Sender send = [this](const Message& request) { return SendBatch(request); };
  Check(BadBatch(), GoodBatches(), send);
  Check(BadObservation(), GoodBatches(), send, 1);
}

TEST_F(BadInputTest, StreamObservations) {
  const Sender send = [this](const Message& request) { return SendOnStream(request); };
  Check(BadBatch(), GoodBatches(), send);
  Check(BadObservation(), GoodBatches(), send, 1);
}

TEST_F(BadInputTest, NextBestTrajectory) {
  Check(BadNextBest(), Copies(PlanFor(lease_)),
        SenderOf(planning_, &v1::PlanningService::Stub::NextBestTrajectory));
}

TEST_F(BadInputTest, StreamNextBestTrajectory) {
  v1::StreamNextBestTrajectoryRequest good;
  good.set_robot(kRobot);
  good.set_lease_token(lease_);
  Check(BadNextBest(), Copies(good), [this](const Message& request) {
    return PlanStreamClient(*planning_,
                            static_cast<const v1::StreamNextBestTrajectoryRequest&>(request))
        .Finish();
  });
}

TEST_F(BadInputTest, CheckTrajectory) {
  v1::CheckTrajectoryRequest good;
  good.set_robot(kRobot);
  good.set_lease_token(lease_);
  good.mutable_path()->add_vertices();
  good.mutable_path()->set_goal_kind(v1::GOAL_KIND_HOME);
  Check(BadCheckTrajectory(), Copies(good),
        SenderOf(planning_, &v1::PlanningService::Stub::CheckTrajectory));
}

TEST_F(BadInputTest, ListFrontiers) {
  Check(BadInputs().Rows(BadRobotName("robot")).Rows(UnknownMission("robot")),
        Copies(v1::ListFrontiersRequest()),
        SenderOf(planning_, &v1::PlanningService::Stub::ListFrontiers));
}

TEST_F(BadInputTest, QueryGas) {
  v1::QueryGasRequest good;
  good.set_mission("missions/hall");
  good.add_points();
  Check(BadQueryGas(), Copies(good), SenderOf(maps_, &v1::MapService::Stub::QueryGas));
}

TEST_F(BadInputTest, ReportProgress) {
  Check(BadReportProgress(), Copies(GoodReport()),
        SenderOf(planning_, &v1::PlanningService::Stub::ReportProgress));
}

TEST_F(BadInputTest, GetMap) {
  v1::GetMapRequest good;
  good.set_mission("missions/hall");
  Check(BadMap(), Copies(good), SenderOf(maps_, &v1::MapService::Stub::GetMap));
}

TEST_F(BadInputTest, WatchMap) {
  v1::WatchMapRequest good;
  good.set_mission("missions/hall");
  Check(BadMap(), Copies(good), [this](const Message& request) {
    WatchClient watch(*maps_, static_cast<const v1::WatchMapRequest&>(request));
    return watch.Finish();
  });
}

TEST_F(BadInputTest, FramesOutOfOrderAndOfNothing) {
  const std::string state = State();
  IngestClient unopened(*ingest_);
  unopened.Send(GoodBatch().batch());
  EXPECT_THAT(unopened.Finish(), RefusesField("open"));
  IngestClient twice(*ingest_);
  twice.Open(kRobot, lease_);
  twice.Open(kRobot, lease_);
  EXPECT_THAT(twice.Finish(), RefusesField("open"));
  IngestClient nothing(*ingest_);
  nothing.Write({});
  EXPECT_THAT(nothing.Finish(), RefusesField("frame"));
  EXPECT_EQ(State(), state);
}

TEST_F(BadInputTest, RepeatsAreNoMistakeWhateverTheySay) {
  const std::int64_t revision = Revision();
  v1::BatchIngestObservationsRequest request = GoodBatch();
  FirstObservation(request).set_sequence(1);
  SetField(request, "batch.observations.pose.x_m", "nan");
  EXPECT_TRUE(SendBatch(request).ok());
  EXPECT_EQ(Revision(), revision);
}

TEST(BadInputCoverageTest, EveryFieldOfEveryRequestHasARowOrAReason) {
  std::map<std::string, BadInputs> tables = AllBadInputs();
  const std::set<std::string> free = FreeFields();
  std::set<std::string> known;  // of the free ones
  for (const Descriptor* type : RequestTypes()) {
    std::set<std::string> covered;
    for (const BadInput& row : tables[type->name()].rows()) covered.insert(row.field);
    std::set<std::string> paths;
    CollectPaths(*type, "", paths);
    for (const std::string& path : paths) {
      const std::string name = absl::StrCat(type->name(), ".", path);
      const bool is_free = free.count(name) > 0;
      if (is_free) known.insert(name);
      EXPECT_NE(covered.count(path) > 0, is_free) << name;
    }
  }
  EXPECT_EQ(known, free);  // none is listed that no request has
  EXPECT_EQ(tables.size(), RequestTypes().size());
}

}  // namespace bad_input_test
}  // namespace plumescout::server
