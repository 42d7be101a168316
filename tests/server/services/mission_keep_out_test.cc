// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission service: keep-out areas that change while robots drive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/services/mission_service.h"
#include "tests/server/bad_input_fixture.h"
#include "tests/server/bad_keep_out_input.h"
#include "tests/server/host_parts.h"
#include "tests/server/robot_watch_client.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace mission_keep_out_test {

using ::testing::ElementsAre;

v1::Polygon Box(const std::string& name, double x0_m, double y0_m, double x1_m, double y1_m) {
  v1::Polygon area;
  area.set_name(name);
  const std::pair<double, double> corners[] = {
      {x0_m, y0_m}, {x1_m, y0_m}, {x1_m, y1_m}, {x0_m, y1_m}};
  for (const auto& [x_m, y_m] : corners) {
    v1::Point2D& vertex = *area.add_vertices();
    vertex.set_x_m(x_m);
    vertex.set_y_m(y_m);
  }
  return area;
}

std::vector<std::string> Names(const google::protobuf::RepeatedPtrField<v1::Polygon>& areas) {
  std::vector<std::string> names;
  for (const v1::Polygon& area : areas) names.push_back(area.name());
  return names;
}

class MissionKeepOutTest : public ServiceTest {
 protected:
  absl::StatusOr<v1::ChangeKeepOutAreasResponse> Change(const std::vector<std::string>& deleted,
                                                        const std::vector<v1::Polygon>& added,
                                                        const std::string& request_id = "") {
    v1::ChangeKeepOutAreasRequest request;
    request.set_name("missions/hall");
    request.set_request_id(request_id);
    for (const std::string& name : deleted) request.add_deleted(name);
    for (const v1::Polygon& area : added) *request.add_added() = area;
    return Call(missions_, &v1::MissionService::Stub::ChangeKeepOutAreas, request);
  }
  std::vector<std::string> OptionNames() {
    v1::GetMissionRequest request;
    request.set_name("missions/hall");
    const auto got = Call(missions_, &v1::MissionService::Stub::GetMission, request);
    EXPECT_TRUE(got.ok()) << got.status();
    return Names(got->mission().options().keep_out());
  }
  std::vector<std::string> MapNames() { return Names(GetMap()->status().keep_out()); }
};

TEST_F(MissionKeepOutTest, EverybodySeesTheAreasOfNow) {
  StartServer();
  const auto added = Change({}, {Box("spill", 2, 1, 3, 2), Box("ramp", 5, 1, 6, 2)});
  ASSERT_TRUE(added.ok()) << added.status();
  EXPECT_THAT(Names(added->areas()), ElementsAre("spill", "ramp"));
  EXPECT_EQ(added->revision(), Revision());
  EXPECT_THAT(OptionNames(), ElementsAre("spill", "ramp"));
  EXPECT_THAT(MapNames(), ElementsAre("spill", "ramp"));
  ASSERT_TRUE(Change({"spill"}, {}).ok());
  EXPECT_THAT(OptionNames(), ElementsAre("ramp"));
  EXPECT_THAT(MapNames(), ElementsAre("ramp"));
}

TEST_F(MissionKeepOutTest, ARequestIsCarriedOutOnce) {
  StartServer();
  ASSERT_TRUE(Change({}, {Box("spill", 2, 1, 3, 2)}).ok());
  const auto first = Change({"spill"}, {}, "once");
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_EQ(Change({"spill"}, {}, "once")->revision(), first->revision());
  EXPECT_THAT(Change({"spill"}, {}).status(),
              Refuses(absl::StatusCode::kNotFound, "KEEP_OUT_AREA_NOT_FOUND"));
}

TEST_F(MissionKeepOutTest, RefusalsChangeNothing) {
  StartServer();
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  ASSERT_TRUE(Change({}, {Box("spill", 3, 1, 4, 2)}).ok());
  const std::int64_t revision = Revision();
  EXPECT_THAT(Change({"spill"}, {Box("ramp", 5, 1, 6, 2), Box("Ramp", 5, 1, 6, 2)}).status(),
              RefusesField("added[1].name"));
  EXPECT_THAT(Change({}, {Box("spill", 5, 1, 6, 2)}).status(),
              Refuses(absl::StatusCode::kAlreadyExists, "KEEP_OUT_AREA_EXISTS"));
  EXPECT_THAT(Change({}, {Box("everything", -99, -99, 99, 99)}).status(),
              Refuses(absl::StatusCode::kFailedPrecondition, "KEEP_OUT_COVERS_HOME"));
  EXPECT_EQ(Revision(), revision);
  EXPECT_THAT(OptionNames(), ElementsAre("spill"));
  v1::FinishMissionRequest finish;
  finish.set_name("missions/hall");
  ASSERT_TRUE(Call(missions_, &v1::MissionService::Stub::FinishMission, finish).ok());
  EXPECT_THAT(Change({"spill"}, {}).status(),
              Refuses(absl::StatusCode::kFailedPrecondition, "MISSION_FINISHED"));
}

// From (2, 1.5), where scans are from, three metres to the east.
absl::StatusOr<Plan> East(const Belief& belief, const PlanRequest& request, const StopFn&) {
  Plan plan = support::PlanTo(belief, request.robot, 5.0);
  plan.trajectory.waypoints = {{{2.0, 1.5, 0.0}}, {{5.0, 1.5, 0.0}, 3.0}};
  plan.trajectory.length_m = plan.trajectory.duration_s = 3.0;
  return plan;
}

TEST_F(MissionKeepOutTest, ARobotOnItsWayThroughANewAreaIsTold) {
  StartServer({}, ScriptedHooks(&East));
  const std::int64_t lease = Lease();
  for (int i = 1; i <= 3; ++i) ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(i)).ok());
  const auto plan = NextBest(PlanFor(lease));
  ASSERT_TRUE(plan.ok()) << plan.status();
  RobotWatchClient watch(*robots_, kRobot, lease);
  ASSERT_TRUE(watch.Read().has_standing());
  ASSERT_TRUE(Change({}, {Box("spill", 3, 1, 4, 2)}).ok());
  const v1::WatchRobotResponse notice = watch.Read();
  ASSERT_TRUE(notice.has_plan_invalidated()) << notice.DebugString();
  EXPECT_EQ(notice.plan_invalidated().plan(), plan->plan().name());
  EXPECT_EQ(notice.plan_invalidated().reason(), v1::PlanInvalidated::REASON_KEPT_OUT);
  EXPECT_NEAR(notice.plan_invalidated().place().x_m(), 3.05, 1e-6);
}

class BadKeepOutTest : public BadInputTest {};

TEST_F(BadKeepOutTest, IsRefusedByNameAndChangesNothing) {
  v1::ChangeKeepOutAreasRequest good;
  good.set_name("missions/hall");
  Check(BadKeepOut(), Copies(good),
        SenderOf(missions_, &v1::MissionService::Stub::ChangeKeepOutAreas));
}

}  // namespace mission_keep_out_test
}  // namespace plumescout::server
