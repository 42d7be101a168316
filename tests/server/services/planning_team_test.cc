// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the planning service: plans for teams.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/plan/trajectory_timing.h"
#include "server/services/planning_service.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace planning_team_test {

// From where the robot is to 2 m north of the mission's origin, or 2 m south.
absl::StatusOr<Plan> DriveApart(const Belief& belief, const PlanRequest& request, const StopFn&) {
  const double y_m = request.robot == "r1" ? 2.0 : -2.0;
  Plan plan = PlanTo(belief, request.robot, 0.0);
  plan.candidates[0].goal.position = {0.0, y_m};
  plan.candidates[0].path = {belief.robots.at(request.robot).state.pose.position(), {0.0, y_m}};
  plan.trajectory = TimeTrajectory(plan.candidates[0].path, 0.0, PlanningOptions());
  return plan;
}

class PlanningTeamTest : public ServiceTest {
 protected:
  // Robot r1 stands at (0, 1), r2 at (0, -1).
  void Start() {
    StartServer({}, ScriptedHooks(DriveApart));
    lease_ = Lease();
    const auto second = Register("r2");
    ASSERT_TRUE(second.ok());
    ASSERT_TRUE(Ingest(kRobot, lease_, Gas(1.0)).ok());
    ASSERT_TRUE(Ingest("missions/hall/robots/r2", second->lease_token(), Gas(-1.0)).ok());
  }
  static v1::ObservationBatch Gas(double y_m) {
    v1::ObservationBatch batch;
    *batch.add_observations() = ToProto(Observation{1, 1, {0.0, y_m, 0.0}, GasReading{1.0, 0.0}});
    return batch;
  }
  absl::StatusOr<v1::PlanTeamResponse> PlanTeam(const v1::PlanTeamRequest& request) {
    return Call(planning_, &v1::PlanningService::Stub::PlanTeam, request);
  }
  static v1::PlanTeamRequest All() {
    v1::PlanTeamRequest request;
    request.set_mission("missions/hall");
    return request;
  }

  std::int64_t lease_ = 0;
};

TEST_F(PlanningTeamTest, RobotsFetchWhatWasAssigned) {
  Start();
  const auto team = PlanTeam(All());
  ASSERT_TRUE(team.ok()) << team.status();
  ASSERT_EQ(team->plans_size(), 2);
  EXPECT_GE(team->order_count(), 1);
  const v1::Plan& mine = team->plans(0).robot() == kRobot ? team->plans(0) : team->plans(1);
  const std::int64_t revision = Revision();
  const auto fetched = NextBest(PlanFor(lease_));
  ASSERT_TRUE(fetched.ok()) << fetched.status();
  EXPECT_EQ(fetched->plan().name(), mine.name());
  EXPECT_EQ(fetched->plan().trajectory().SerializeAsString(),
            mine.trajectory().SerializeAsString());
  EXPECT_EQ(Revision(), revision) << "to fetch it changes nothing";
  v1::PlanTeamRequest again = All();
  EXPECT_EQ(PlanTeam(again)->plans_size(), 0) << "nobody is free";
  again.add_robots(kRobot);
  ASSERT_EQ(PlanTeam(again)->plans_size(), 1) << "who is named gets another";
}

TEST_F(PlanningTeamTest, TheSameRequestIdGetsTheSameAnswer) {
  Start();
  v1::PlanTeamRequest request = All();
  request.set_request_id("start");
  const auto first = PlanTeam(request);
  const auto second = PlanTeam(request);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first->SerializeAsString(), second->SerializeAsString());
}

TEST_F(PlanningTeamTest, APausedMissionPlansForNoTeam) {
  Start();
  v1::PauseMissionRequest pause;
  pause.set_name("missions/hall");
  ASSERT_TRUE(Call(missions_, &v1::MissionService::Stub::PauseMission, pause).ok());
  const absl::Status refused = PlanTeam(All()).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("MISSION_PAUSED"));
}

}  // namespace planning_team_test
}  // namespace plumescout::server
