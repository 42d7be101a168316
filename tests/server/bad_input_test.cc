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

#include "absl/strings/match.h"
#include "tests/server/bad_home_input.h"
#include "tests/server/bad_ingest_input.h"
#include "tests/server/bad_input_fixture.h"
#include "tests/server/bad_keep_out_input.h"
#include "tests/server/bad_map_input.h"
#include "tests/server/bad_mission_input.h"
#include "tests/server/bad_registration_input.h"
#include "tests/server/bad_robot_input.h"
#include "tests/server/bad_snapshot_input.h"
#include "tests/server/export_client.h"
#include "tests/server/free_fields.h"
#include "tests/server/robot_watch_client.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace bad_input_test {

// The rows by the name of the request's type.
std::map<std::string, BadInputs> AllBadInputs() {
  const BadInputs ingest = BadInputs().Rows(BadBatch()).Rows(BadObservation());
  return {{"CreateMissionRequest", BadCreateMission()},
          {"GetMissionRequest", BadMissionName("name")},
          {"ListMissionsRequest", BadListMissions()},
          {"DeleteMissionRequest", BadMissionName("name")},
          {"UpdateMissionRequest", BadUpdateMission()},
          {"PauseMissionRequest", BadMissionName("name")},
          {"ResumeMissionRequest", BadMissionName("name")},
          {"FinishMissionRequest", BadMissionName("name")},
          {"ChangeKeepOutAreasRequest", BadKeepOut()},
          {"RegisterRobotRequest", BadRegisterRobot()},
          {"RemoveRobotRequest", BadRemoveRobot()},
          {"GetRobotRequest", BadGetRobot()},
          {"ListRobotsRequest", BadListRobots()},
          {"ReleaseLeaseRequest", BadRemoveRobot()},
          {"OrderHomeRequest", BadInputs().Rows(BadOrderHome()).Rows(BadRequestId())},
          {"WatchRobotRequest", BadWatchRobot()},
          {"StreamObservationsRequest", ingest},
          {"BatchIngestObservationsRequest", ingest},
          {"NextBestTrajectoryRequest", BadInputs().Rows(BadNextBest()).Rows(BadRequestId())},
          {"StreamNextBestTrajectoryRequest", BadNextBest()},
          {"CheckTrajectoryRequest", BadCheckTrajectory()},
          {"ListFrontiersRequest",
           BadInputs().Rows(BadRobotName("robot")).Rows(UnknownMission("robot"))},
          {"ReportProgressRequest", BadReportProgress()},
          {"ListPlansRequest", BadMissionName("mission")},
          {"PlanTeamRequest", BadPlanTeam()},
          {"QueryGasRequest", BadQueryGas()},
          {"GetMapRequest", BadGetMap()},
          {"WatchMapRequest", BadWatchMap()},
          {"ExportMissionRequest", BadExport()},
          {"ImportMissionRequest", BadImport()},
          {"GetMissionHistoryRequest", BadHistory()},
          {"GetMissionFiguresRequest", BadMissionName("mission")}};
}

// Of the mission in an update, what no mask may name is not read.
bool IsRead(const std::string& name) {
  constexpr absl::string_view kMission = "UpdateMissionRequest.mission.";
  return !absl::StartsWith(name, kMission) ||
         absl::StartsWith(name, absl::StrCat(kMission, "name")) ||
         absl::StartsWith(name, absl::StrCat(kMission, "idle_time_to_live"));
}

// The requests of all services.
std::vector<const Descriptor*> RequestTypes() {
  std::vector<const Descriptor*> types;
  for (const Descriptor* member :
       {v1::Mission::descriptor(), v1::RegisterRobotRequest::descriptor(),
        v1::IngestState::descriptor(), v1::Plan::descriptor(), v1::MapTile::descriptor(),
        v1::MissionEvent::descriptor()}) {
    const auto& file = *member->file();
    for (int i = 0; i < file.service_count(); ++i) {
      for (int j = 0; j < file.service(i)->method_count(); ++j) {
        types.push_back(file.service(i)->method(j)->input_type());
      }
    }
  }
  return types;
}

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

TEST_F(BadInputTest, UpdateMission) {
  v1::UpdateMissionRequest good;
  good.mutable_mission()->set_name("missions/hall");
  good.mutable_update_mask()->add_paths("idle_time_to_live");
  Check(BadUpdateMission(), Copies(good),
        SenderOf(missions_, &v1::MissionService::Stub::UpdateMission));
}

TEST_F(BadInputTest, ChangesOfAMission) {
  Check(BadMissionName("name"), Copies(v1::PauseMissionRequest()),
        SenderOf(missions_, &v1::MissionService::Stub::PauseMission));
  Check(BadMissionName("name"), Copies(v1::ResumeMissionRequest()),
        SenderOf(missions_, &v1::MissionService::Stub::ResumeMission));
  Check(BadMissionName("name"), Copies(v1::FinishMissionRequest()),
        SenderOf(missions_, &v1::MissionService::Stub::FinishMission));
}

TEST_F(BadInputTest, LooksAtRobotsAndPlans) {
  v1::ListRobotsRequest list;
  list.set_mission("missions/hall");
  Check(BadGetRobot(), Copies(v1::GetRobotRequest()),
        SenderOf(robots_, &v1::RobotService::Stub::GetRobot));
  Check(BadListRobots(), Copies(list), SenderOf(robots_, &v1::RobotService::Stub::ListRobots));
  Check(BadMissionName("mission"), Copies(v1::ListPlansRequest()),
        SenderOf(planning_, &v1::PlanningService::Stub::ListPlans));
  v1::PlanTeamRequest team;
  team.set_mission("missions/hall");
  Check(BadPlanTeam(), Copies(team), SenderOf(planning_, &v1::PlanningService::Stub::PlanTeam));
}

TEST_F(BadInputTest, ReleaseLease) {
  v1::ReleaseLeaseRequest good;
  good.set_robot(kRobot);
  good.set_lease_token(lease_);
  Check(BadRemoveRobot(), Copies(good), SenderOf(robots_, &v1::RobotService::Stub::ReleaseLease));
}

TEST_F(BadInputTest, OrderHome) {
  v1::OrderHomeRequest good;
  good.set_robot(kRobot);
  Check(BadInputs().Rows(BadOrderHome()).Rows(BadRequestId()), Copies(good),
        SenderOf(robots_, &v1::RobotService::Stub::OrderHome));
}

TEST_F(BadInputTest, WatchRobot) {
  v1::WatchRobotRequest good;
  good.set_robot(kRobot);
  good.set_lease_token(lease_);
  Check(BadWatchRobot(), Copies(good), [this](const Message& message) {
    const auto& request = static_cast<const v1::WatchRobotRequest&>(message);
    return RobotWatchClient(*robots_, request.robot(), request.lease_token()).Finish();
  });
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
  Check(BadInputs().Rows(BadNextBest()).Rows(BadRequestId()), Copies(PlanFor(lease_)),
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
  Check(BadGetMap(), Copies(GoodView<v1::GetMapRequest>()),
        SenderOf(maps_, &v1::MapService::Stub::GetMap));
}

TEST_F(BadInputTest, WatchMap) {
  const auto good = GoodView<v1::WatchMapRequest>();
  Check(BadWatchMap(), Copies(good), [this](const Message& request) {
    WatchClient watch(*maps_, static_cast<const v1::WatchMapRequest&>(request));
    return watch.Finish();
  });
}

TEST_F(BadInputTest, ExportMission) {
  v1::ExportMissionRequest good;
  good.set_mission("missions/hall");
  Check(BadExport(), Copies(good), [this](const Message& message) {
    const auto& request = static_cast<const v1::ExportMissionRequest&>(message);
    return ExportClient(*snapshots_, request.mission(), request.format()).Finish();
  });
}

TEST_F(BadInputTest, ImportMission) {
  Check(BadImport(), Copies(v1::ImportMissionRequest()),
        [this](const Message& request) { return SendImport(request); });
}

TEST_F(BadInputTest, GetMissionHistory) {
  v1::GetMissionHistoryRequest good;
  good.set_mission("missions/hall");
  Check(BadHistory(), Copies(good),
        SenderOf(snapshots_, &v1::SnapshotService::Stub::GetMissionHistory));
}

TEST_F(BadInputTest, GetMissionFigures) {
  v1::GetMissionFiguresRequest good;
  good.set_mission("missions/hall");
  Check(BadMissionName("mission"), Copies(good),
        SenderOf(snapshots_, &v1::SnapshotService::Stub::GetMissionFigures));
}

TEST_F(BadInputTest, PartsOfAnImportOutOfOrderAndOfNothing) {
  const std::string state = State();
  ImportClient unopened(*snapshots_);
  unopened.Send(v1::MissionFilePiece());
  EXPECT_THAT(unopened.Finish().status(), RefusesField("start"));
  ImportClient twice(*snapshots_);
  twice.Open("attic");
  twice.Open("attic");
  EXPECT_THAT(twice.Finish().status(), RefusesField("start"));
  ImportClient nothing(*snapshots_);
  nothing.Send(v1::ImportMissionRequest());
  EXPECT_THAT(nothing.Finish().status(), RefusesField("part"));
  EXPECT_EQ(State(), state);
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
      if (!IsRead(name)) continue;
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
