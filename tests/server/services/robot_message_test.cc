// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/robot_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/time/clock.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace robot_message_test {

constexpr double kHour_s = 3600.0;

absl::StatusOr<Plan> DriveEast(const Belief& belief, const PlanRequest& request, const StopFn&) {
  Plan plan = PlanTo(belief, request.robot, 1.0);
  plan.trajectory.waypoints = {{{0.0, 0.0, 0.0}, 0.0, 0.0, 0.5}, {{1.0, 0.0, 0.0}, 2.0, 0.0, 0.0}};
  plan.trajectory.length_m = 1.0;
  plan.trajectory.duration_s = 2.0;
  return plan;
}

class RobotMessageTest : public ServiceTest {
 protected:
  v1::Robot Get(const std::string& robot = kRobot) {
    v1::GetRobotRequest request;
    request.set_name(robot);
    auto response = Call(robots_, &v1::RobotService::Stub::GetRobot, request);
    EXPECT_TRUE(response.ok()) << response.status();
    return response.ok() ? response->robot() : v1::Robot();
  }
  // Scans of now by a clock that is so far ahead of the server's, sent now.
  void IngestNow(std::int64_t lease, std::int64_t first, std::int64_t last, double ahead_s) {
    v1::ObservationBatch batch;
    const std::int64_t now_ns = absl::ToUnixNanos(absl::Now() + absl::Seconds(ahead_s));
    for (std::int64_t sequence = first; sequence <= last; ++sequence) {
      *batch.add_observations() = RoomScan(sequence).observations(0);
      batch.mutable_observations()->rbegin()->set_sample_time_ns(now_ns);
    }
    batch.set_sent_time_ns(now_ns);
    const auto response = Ingest(kRobot, lease, batch);
    ASSERT_TRUE(response.ok()) << response.status();
    EXPECT_EQ(response->rejections_size(), 0);
  }
};

TEST_F(RobotMessageTest, BeforeItsFirstBatchThereIsLittleToTell) {
  StartServer();
  ASSERT_TRUE(Register("r1").ok());
  const v1::Robot robot = Get();
  EXPECT_EQ(robot.link(), v1::ROBOT_LINK_IDLE);
  EXPECT_FALSE(robot.has_last_heard_age_s());
  EXPECT_FALSE(robot.has_ingest_lag_s());
  EXPECT_FALSE(robot.has_clock_offset_s());
  EXPECT_FALSE(robot.has_battery_share());
  EXPECT_FALSE(robot.has_frame());
  EXPECT_EQ(robot.live_plan(), "");
}

TEST_F(RobotMessageTest, AClockThatIsAnHourAheadIsToldAndCostsNoLag) {
  StartServer();
  IngestNow(Lease(), 1, 2, kHour_s);
  const v1::Robot robot = Get();
  EXPECT_NEAR(robot.clock_offset_s(), -kHour_s, kAmpleBudget_s);
  EXPECT_TRUE(robot.has_ingest_lag_s());
  EXPECT_GE(robot.ingest_lag_s(), 0.0);
  EXPECT_LT(robot.ingest_lag_s(), kHour_s);
  EXPECT_GE(robot.last_heard_age_s(), 0.0);
}

TEST_F(RobotMessageTest, WhoDoesNotSayWhenItSendsHasNeitherOffsetNorLag) {
  StartServer();
  ASSERT_TRUE(Ingest(kRobot, Lease(), GasReadings(1, 2)).ok());
  const v1::Robot robot = Get();
  EXPECT_TRUE(robot.has_last_heard_age_s());
  EXPECT_FALSE(robot.has_ingest_lag_s());
  EXPECT_FALSE(robot.has_clock_offset_s());
}

TEST_F(RobotMessageTest, TheBatteryIsWhatItToldWithoutAPose) {
  StartServer();
  v1::ObservationBatch batch;
  v1::Observation& observation = *batch.add_observations();
  observation.set_sequence(1);
  observation.set_sample_time_ns(1);
  observation.mutable_status()->set_battery_share(0.75);
  const auto response = Ingest(kRobot, Lease(), batch);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->rejections_size(), 0);
  EXPECT_EQ(Get().battery_share(), 0.75);
  EXPECT_FALSE(Get().on_map().has_pose());
}

TEST_F(RobotMessageTest, HomeIsWhereItBeganUnlessTheMissionNamesOne) {
  StartServer();
  const std::int64_t lease = Lease();
  EXPECT_FALSE(Get().has_home());
  for (int k = 1; k <= 2; ++k) {
    ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(k, {1.0 + k, 1.5, 0.0})).ok());
  }
  EXPECT_EQ(Get().home().x_m(), 2.0);
  EXPECT_EQ(Get().home().y_m(), 1.5);
  v1::MissionOptions options;
  options.mutable_home()->set_x_m(4.0);
  ASSERT_TRUE(CreateMission("yard", options).ok());
  v1::RegisterRobotRequest request;
  request.set_mission("missions/yard");
  request.set_robot_id("r1");
  request.set_radius_m(0.2);
  ASSERT_TRUE(Call(robots_, &v1::RobotService::Stub::RegisterRobot, request).ok());
  EXPECT_EQ(Get("missions/yard/robots/r1").home().x_m(), 4.0);
}

TEST_F(RobotMessageTest, ALivePlanHasProgress) {
  StartServer({}, ScriptedHooks(DriveEast));
  const std::int64_t lease = Lease();
  for (int i = 1; i <= 4; ++i) ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(i)).ok());
  const auto planned = NextBest(PlanFor(lease));
  ASSERT_TRUE(planned.ok()) << planned.status();
  const v1::Robot robot = Get();
  EXPECT_EQ(robot.live_plan(), planned->plan().name());
  EXPECT_GE(robot.progress_s(), 0.0);
  EXPECT_GE(robot.lateness_s(), 0.0);
  EXPECT_GT(robot.arrival_time_ns(), 0);
}

TEST_F(RobotMessageTest, ALinkIsStreamingOrGone) {
  StartServer();
  const std::int64_t lease = Lease();
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease));
  ASSERT_TRUE(stream.Read().has_opened());
  EXPECT_EQ(Get().link(), v1::ROBOT_LINK_STREAMING);
  v1::ReleaseLeaseRequest release;
  release.set_robot(kRobot);
  release.set_force(true);
  ASSERT_TRUE(Call(robots_, &v1::RobotService::Stub::ReleaseLease, release).ok());
  EXPECT_EQ(Get().link(), v1::ROBOT_LINK_GONE);
}

// In one mission an hour ahead, an hour behind and right: the map is that of right clocks.
TEST_F(RobotMessageTest, ATeamOfWrongClocksMakesTheMapOfRightOnes) {
  std::vector<v1::GetMapResponse> maps;
  for (const double off_s : {0.0, kHour_s}) {
    StartServer();
    double ahead_s = -off_s;
    const absl::Time begun = absl::Now();
    for (const char* id : {"r1", "r2", "r3"}) {
      const auto robot = Register(id);
      ASSERT_TRUE(robot.ok()) << robot.status();
      v1::ObservationBatch batch;
      const std::int64_t sample_ns = absl::ToUnixNanos(begun + absl::Seconds(ahead_s));
      for (int k = 1; k <= 4; ++k) {
        *batch.add_observations() = RoomScan(k, {1.0 + k, 1.5, 0.0}).observations(0);
      }
      *batch.add_observations() = ToProto(Observation{5, 0, {2.0, 1.5, 0.0}, GasReading{7.0}});
      for (v1::Observation& observation : *batch.mutable_observations()) {
        observation.set_sample_time_ns(sample_ns);
      }
      batch.set_sent_time_ns(absl::ToUnixNanos(absl::Now() + absl::Seconds(ahead_s)));
      const auto response = Ingest(robot->robot(), robot->lease_token(), batch);
      ASSERT_TRUE(response.ok()) << response.status();
      EXPECT_EQ(response->rejections_size(), 0) << id;
      ahead_s += off_s;
    }
    v1::GetMapRequest request;
    request.set_mission("missions/hall");
    request.set_full_precision(true);
    request.set_fresh_posterior(true);
    const auto map = Call(maps_, &v1::MapService::Stub::GetMap, request);
    ASSERT_TRUE(map.ok()) << map.status();
    maps.push_back(*map);
  }
  ASSERT_EQ(maps[0].tiles_size(), maps[1].tiles_size());
  EXPECT_GT(maps[0].tiles_size(), 0);
  for (int i = 0; i < maps[0].tiles_size(); ++i) {
    EXPECT_EQ(maps[0].tiles(i).SerializeAsString(), maps[1].tiles(i).SerializeAsString());
  }
}

TEST(ReadHomeOrderTest, NamesOneOrAll) {
  v1::OrderHomeRequest request;
  EXPECT_TRUE(absl::IsInvalidArgument(ReadHomeOrder(request).status()));
  request.set_robot(kRobot);
  EXPECT_EQ(ReadHomeOrder(request).value(), (RobotName{"hall", "r1"}));
  request.set_mission("missions/hall");
  EXPECT_EQ(ReadHomeOrder(request).value(), (RobotName{"hall", ""}));
  request.set_mission("hall");
  EXPECT_TRUE(absl::IsInvalidArgument(ReadHomeOrder(request).status()));
}

}  // namespace robot_message_test
}  // namespace plumescout::server
