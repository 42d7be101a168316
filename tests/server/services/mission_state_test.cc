// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission service: pause, finish, and the end of missions that idle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <string>
#include <vector>

#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "server/services/mission_service.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace mission_state_test {

using ::testing::ElementsAre;

constexpr auto kNotFound = absl::StatusCode::kNotFound;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;

class MissionStateTest : public ServiceTest {
 protected:
  v1::Mission Get() {
    v1::GetMissionRequest request;
    request.set_name("missions/hall");
    const auto response = Call(missions_, &v1::MissionService::Stub::GetMission, request);
    EXPECT_TRUE(response.ok()) << response.status();
    return response.ok() ? response->mission() : v1::Mission();
  }
  std::vector<std::string> Names() {
    std::vector<std::string> names;
    const auto page =
        Call(missions_, &v1::MissionService::Stub::ListMissions, v1::ListMissionsRequest());
    for (const v1::Mission& mission : page->missions()) names.push_back(mission.name());
    return names;
  }
  absl::StatusOr<v1::Mission> Pause(const std::string& name = "missions/hall") {
    v1::PauseMissionRequest request;
    request.set_name(name);
    const auto response = Call(missions_, &v1::MissionService::Stub::PauseMission, request);
    if (!response.ok()) return response.status();
    return response->mission();
  }
  absl::Status Resume() {
    v1::ResumeMissionRequest request;
    request.set_name("missions/hall");
    return Call(missions_, &v1::MissionService::Stub::ResumeMission, request).status();
  }
  absl::StatusOr<v1::Mission> FinishHall() {
    v1::FinishMissionRequest request;
    request.set_name("missions/hall");
    const auto response = Call(missions_, &v1::MissionService::Stub::FinishMission, request);
    if (!response.ok()) return response.status();
    return response->mission();
  }
};

TEST_F(MissionStateTest, APausedMissionListensAndPlansNothing) {
  StartServer();
  EXPECT_EQ(Get().state(), v1::MISSION_STATE_RUNNING);
  const std::int64_t lease = Lease();
  for (int i = 1; i <= 3; ++i) ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(i)).ok());
  EXPECT_EQ(Pause()->state(), v1::MISSION_STATE_PAUSED);
  EXPECT_THAT(NextBest(PlanFor(lease)).status(), Refuses(kPrecondition, "MISSION_PAUSED"));
  v1::StreamNextBestTrajectoryRequest stream;
  stream.set_robot(kRobot);
  stream.set_lease_token(lease);
  EXPECT_THAT(PlanStreamClient(*planning_, stream).Finish(),
              Refuses(kPrecondition, "MISSION_PAUSED"));
  EXPECT_TRUE(Ingest(kRobot, lease, RoomScan(4)).ok());
  ASSERT_TRUE(Resume().ok());
  EXPECT_TRUE(NextBest(PlanFor(lease)).ok());
  EXPECT_THAT(Pause("missions/attic").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

TEST_F(MissionStateTest, APlanThatIsBeingMadeWhenThePauseBeginsIsNotCommitted) {
  absl::Notification searching;
  absl::Notification release;
  StartServer({},
              ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
                searching.Notify();
                release.WaitForNotification();
                return PlanTo(belief, request.robot, 1.0);
              }));
  const std::int64_t lease = Lease();
  auto plan = std::async(std::launch::async, [&] { return NextBest(PlanFor(lease)).status(); });
  searching.WaitForNotification();
  ASSERT_TRUE(Pause().ok());
  const std::int64_t revision = Revision();
  release.Notify();
  EXPECT_THAT(plan.get(), Refuses(kPrecondition, "MISSION_PAUSED"));
  EXPECT_EQ(Revision(), revision);
}

TEST_F(MissionStateTest, AFinishedMissionIsReadAndNothingElse) {
  StartServer();
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(2, 3)).ok());
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease));
  ASSERT_TRUE(stream.Read().has_opened());
  const auto finished = FinishHall();
  ASSERT_TRUE(finished.ok()) << finished.status();
  EXPECT_EQ(finished->state(), v1::MISSION_STATE_FINISHED);
  EXPECT_THAT(stream.Finish(), Refuses(kPrecondition, "MISSION_FINISHED"));
  EXPECT_THAT(Ingest(kRobot, lease, GasReadings(4, 4)).status(),
              Refuses(kPrecondition, "MISSION_FINISHED"));
  EXPECT_THAT(NextBest(PlanFor(lease)).status(), Refuses(kPrecondition, "MISSION_FINISHED"));
  EXPECT_THAT(Register("r2").status(), Refuses(kPrecondition, "MISSION_FINISHED"));
  IngestClient late(*ingest_);
  late.Open(kRobot, lease);
  EXPECT_THAT(late.Finish(), Refuses(kPrecondition, "MISSION_FINISHED"));
  EXPECT_THAT(Pause().status(), Refuses(kPrecondition, "MISSION_FINISHED"));
  EXPECT_THAT(Resume(), Refuses(kPrecondition, "MISSION_FINISHED"));
  EXPECT_TRUE(FinishHall().ok());
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_fresh_posterior(true);
  EXPECT_TRUE(Call(maps_, &v1::MapService::Stub::GetMap, request).ok());
  EXPECT_EQ(Revision(), finished->revision()) << "nothing changes it any more";
  EXPECT_TRUE(DeleteMission("hall").ok());
}

TEST_F(MissionStateTest, TheTimeToLiveIsSetAndShown) {
  StartServer();
  EXPECT_FALSE(Get().has_idle_time_to_live());
  v1::UpdateMissionRequest update;
  update.mutable_mission()->set_name("missions/hall");
  update.mutable_mission()->mutable_idle_time_to_live()->set_seconds(90);
  update.mutable_update_mask()->add_paths("idle_time_to_live");
  const auto updated = Call(missions_, &v1::MissionService::Stub::UpdateMission, update);
  ASSERT_TRUE(updated.ok()) << updated.status();
  EXPECT_EQ(updated->mission().idle_time_to_live().seconds(), 90);
  EXPECT_EQ(Get().idle_time_to_live().seconds(), 90);
  v1::CreateMissionRequest create;
  create.set_mission_id("attic");
  create.mutable_idle_time_to_live()->set_seconds(3600);
  const auto created = Call(missions_, &v1::MissionService::Stub::CreateMission, create);
  EXPECT_EQ(created->mission().idle_time_to_live().seconds(), 3600);
  EXPECT_EQ(created->mission().owner(), "anonymous");
}

TEST_F(MissionStateTest, TheRetentionOfEventsIsSetAndShown) {
  StartServer();
  EXPECT_EQ(Get().event_retention(), v1::EVENT_RETENTION_ALL);
  v1::UpdateMissionRequest update;
  update.mutable_mission()->set_name("missions/hall");
  update.mutable_mission()->set_event_retention(v1::EVENT_RETENTION_SINCE_SNAPSHOT);
  update.mutable_update_mask()->add_paths("event_retention");
  const auto updated = Call(missions_, &v1::MissionService::Stub::UpdateMission, update);
  ASSERT_TRUE(updated.ok()) << updated.status();
  EXPECT_EQ(updated->mission().event_retention(), v1::EVENT_RETENTION_SINCE_SNAPSHOT);
  EXPECT_EQ(Get().event_retention(), v1::EVENT_RETENTION_SINCE_SNAPSHOT);
  v1::CreateMissionRequest create;
  create.set_mission_id("attic");
  create.set_event_retention(v1::EVENT_RETENTION_SINCE_SNAPSHOT);
  const auto created = Call(missions_, &v1::MissionService::Stub::CreateMission, create);
  EXPECT_EQ(created->mission().event_retention(), v1::EVENT_RETENTION_SINCE_SNAPSHOT);
}

// The watcher is all that keeps it.
TEST_F(MissionStateTest, AMissionThatNobodyCallsForIsDeleted) {
  StartServer();
  v1::CreateMissionRequest create;
  create.set_mission_id("brief");
  create.mutable_idle_time_to_live()->set_seconds(1);
  ASSERT_TRUE(Call(missions_, &v1::MissionService::Stub::CreateMission, create).ok());
  create.set_mission_id("watched");
  ASSERT_TRUE(Call(missions_, &v1::MissionService::Stub::CreateMission, create).ok());
  WatchClient watch(*maps_, "missions/watched");
  const absl::Time end = absl::Now() + absl::Seconds(60);
  while (Names().size() > 2 && absl::Now() < end) absl::SleepFor(absl::Milliseconds(20));
  EXPECT_THAT(Names(), ElementsAre("missions/hall", "missions/watched"));
}

}  // namespace mission_state_test
}  // namespace plumescout::server
