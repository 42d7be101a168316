// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/snapshot_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "tests/server/export_client.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace snapshot_service_test {

class SnapshotServiceTest : public ServiceTest {
 protected:
  void SetUp() override {
    StartServerWithStore();
    lease_ = Lease();
    ASSERT_TRUE(Ingest(kRobot, lease_, RoomScan(1)).ok());
    ASSERT_TRUE(Ingest(kRobot, lease_, GasReadings(2, 5)).ok());
    ASSERT_TRUE(NextBest(PlanFor(lease_)).ok());
  }
  std::vector<v1::ExportMissionResponse> Export(const std::string& mission = "missions/hall") {
    ExportClient client(*snapshots_, mission);
    std::vector<v1::ExportMissionResponse> parts;
    for (auto part = client.Read(); part.part_case() != 0; part = client.Read()) {
      parts.push_back(part);
    }
    EXPECT_TRUE(client.Finish().ok());
    return parts;
  }
  absl::StatusOr<v1::ImportMissionResponse> Import(
      const std::vector<v1::ExportMissionResponse>& parts, const std::string& id) {
    ImportClient client(*snapshots_);
    client.Open(id);
    for (const auto& part : parts) {
      if (part.has_piece()) client.Send(part.piece());
      if (part.has_end()) client.Send(part.end());
    }
    return client.Finish();
  }
  std::string MapOf(const std::string& mission) {
    v1::GetMapRequest request;
    request.set_mission(mission);
    request.set_full_precision(true);
    auto map = Call(maps_, &v1::MapService::Stub::GetMap, request);
    EXPECT_TRUE(map.ok()) << map.status();
    if (!map.ok()) return "";
    for (auto& robot : *map->mutable_status()->mutable_robots()) robot.clear_robot();
    return map->SerializeAsString();
  }

  std::int64_t lease_ = 0;
};

TEST_F(SnapshotServiceTest, ImportedMissionIsTheExportedOne) {
  const auto parts = Export();
  ASSERT_GE(parts.size(), 3u);
  EXPECT_EQ(parts.front().start().revision(), Revision());
  EXPECT_TRUE(parts.back().has_end());
  const auto imported = Import(parts, "copy");
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->mission().name(), "missions/copy");
  EXPECT_EQ(imported->mission().revision(), Revision());
  EXPECT_EQ(imported->mission().state(), v1::MISSION_STATE_RUNNING);
  EXPECT_TRUE(MapOf("missions/copy") == MapOf("missions/hall"));
}

TEST_F(SnapshotServiceTest, NameInTheFileIsTakenWhereNoneIsGiven) {
  const auto parts = Export();
  EXPECT_THAT(Import(parts, "").status(),
              Refuses(absl::StatusCode::kAlreadyExists, "MISSION_EXISTS"));
  ASSERT_TRUE(DeleteMission("hall").ok());
  const auto imported = Import(parts, "");
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->mission().name(), "missions/hall");
}

TEST_F(SnapshotServiceTest, FileThatEndsTooSoonChangesNothing) {
  auto parts = Export();
  parts.pop_back();
  EXPECT_THAT(Import(parts, "copy").status(), RefusesField("end"));
  v1::GetMissionRequest request;
  request.set_name("missions/copy");
  EXPECT_TRUE(
      absl::IsNotFound(Call(missions_, &v1::MissionService::Stub::GetMission, request).status()));
}

TEST_F(SnapshotServiceTest, HistoryTellsWhatHappened) {
  v1::GetMissionHistoryRequest request;
  request.set_mission("missions/hall");
  const auto history = Call(snapshots_, &v1::SnapshotService::Stub::GetMissionHistory, request);
  ASSERT_TRUE(history.ok()) << history.status();
  EXPECT_EQ(history->head_revision(), Revision());
  ASSERT_EQ(history->events_size(), Revision());
  EXPECT_EQ(history->events(0).robot(), kRobot);
  EXPECT_EQ(history->events(1).summary(), "scan 1, 360 beams at (2.00, 1.50)");
  request.add_kinds(v1::MISSION_EVENT_KIND_PLAN);
  const auto plans = Call(snapshots_, &v1::SnapshotService::Stub::GetMissionHistory, request);
  ASSERT_TRUE(plans.ok()) << plans.status();
  ASSERT_EQ(plans->events_size(), 1);
  EXPECT_THAT(plans->events(0).summary(), testing::StartsWith("plan to "));
}

TEST_F(SnapshotServiceTest, FiguresOfThePastAreTold) {
  v1::GetMissionFiguresRequest request;
  request.set_mission("missions/hall");
  auto answer = Call(snapshots_, &v1::SnapshotService::Stub::GetMissionFigures, request);
  const absl::Time end = absl::Now() + absl::Seconds(60);
  while (answer.ok() && answer->more_follow() && absl::Now() < end) {
    absl::SleepFor(absl::Milliseconds(10));  // callers without a pause are refused
    answer = Call(snapshots_, &v1::SnapshotService::Stub::GetMissionFigures, request);
  }
  ASSERT_TRUE(answer.ok()) << answer.status();
  ASSERT_FALSE(answer->more_follow());
  ASSERT_GT(answer->figures_size(), 0);
  const v1::MissionFigures& last = answer->figures(answer->figures_size() - 1);
  EXPECT_EQ(last.revision(), Revision());
  EXPECT_EQ(last.robots(0).robot(), kRobot);
}

TEST_F(SnapshotServiceTest, PastMapsAreServed) {
  const std::string then = MapOf("missions/hall");
  const std::int64_t revision = Revision();
  ASSERT_TRUE(Ingest(kRobot, lease_, RoomScan(6, {5.0, 3.0, 0.0})).ok());
  ASSERT_FALSE(MapOf("missions/hall") == then);
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_full_precision(true);
  request.set_revision(revision);
  auto map = Call(maps_, &v1::MapService::Stub::GetMap, request);
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->revision(), revision);
  for (auto& robot : *map->mutable_status()->mutable_robots()) robot.clear_robot();
  EXPECT_TRUE(map->SerializeAsString() == then);
}

TEST_F(SnapshotServiceTest, ServerWithoutAJournalSaysSo) {
  StartServer();
  v1::GetMissionHistoryRequest request;
  request.set_mission("missions/hall");
  EXPECT_TRUE(absl::IsFailedPrecondition(
      Call(snapshots_, &v1::SnapshotService::Stub::GetMissionHistory, request).status()));
  v1::GetMissionFiguresRequest figures;
  figures.set_mission("missions/hall");
  EXPECT_TRUE(absl::IsFailedPrecondition(
      Call(snapshots_, &v1::SnapshotService::Stub::GetMissionFigures, figures).status()));
  EXPECT_TRUE(absl::IsFailedPrecondition(ExportClient(*snapshots_, "missions/hall").Finish()));
  EXPECT_TRUE(absl::IsFailedPrecondition(ImportClient(*snapshots_).Finish().status()));
}

}  // namespace snapshot_service_test
}  // namespace plumescout::server
