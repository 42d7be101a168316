// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/robot_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace robot_service_test {

constexpr auto kNotFound = absl::StatusCode::kNotFound;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;

class RobotServiceTest : public ServiceTest {
 protected:
  absl::Status RegisterWith(const std::function<void(v1::RegisterRobotRequest&)>& change) {
    v1::RegisterRobotRequest request;
    request.set_mission("missions/hall");
    request.set_robot_id("r1");
    request.set_radius_m(0.2);
    change(request);
    return Call(robots_, &v1::RobotService::Stub::RegisterRobot, request).status();
  }
  absl::StatusOr<v1::RemoveRobotResponse> Remove(const std::string& robot, std::int64_t lease_token,
                                                 bool force = false) {
    v1::RemoveRobotRequest request;
    request.set_robot(robot);
    request.set_lease_token(lease_token);
    request.set_force(force);
    return Call(robots_, &v1::RobotService::Stub::RemoveRobot, request);
  }
};

ServerConfig WithLeaseHold(double seconds) {
  ServerConfig config;
  config.connection.lease_hold_s = seconds;
  return config;
}

TEST_F(RobotServiceTest, NewRobotStartsItsLogAtTheBeginning) {
  StartServer();
  const auto response = Register("r1");
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->robot(), kRobot);
  EXPECT_GT(response->lease_token(), 0);
  EXPECT_EQ(response->server_boot_id(), server_->boot_id());
  EXPECT_EQ(response->ingest_state().applied_sequence(), 0);
  EXPECT_EQ(response->ingest_state().credit_sequence(), LimitConfig{}.stream_window_observations);
  EXPECT_EQ(response->ingest_state().revision(), 1);
}

TEST_F(RobotServiceTest, HeldLeaseIsRefusedAndSaysWhenToRetry) {
  StartServer(WithLeaseHold(3600.0));
  ASSERT_TRUE(Register("r1").ok());
  const absl::Status refused = Register("r1").status();
  EXPECT_THAT(refused, Refuses(kPrecondition, "LEASE_HELD"));
  EXPECT_GT(RetryDelay(refused).value(), absl::ZeroDuration());
  EXPECT_EQ(Revision(), 1);
}

TEST_F(RobotServiceTest, TakeOverGrantsANewerLeaseAndTheLogGoesOn) {
  StartServer();
  const std::int64_t old_lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, old_lease, GasReadings(1, 3)).ok());
  const auto response = Register("r1", /*take_over=*/true);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_GT(response->lease_token(), old_lease);
  EXPECT_EQ(response->ingest_state().applied_sequence(), 3);
}

TEST_F(RobotServiceTest, LeaseThatRanOutIsFree) {
  StartServer(WithLeaseHold(0.0));
  ASSERT_TRUE(Register("r1").ok());
  EXPECT_TRUE(Register("r1").ok());
}

TEST_F(RobotServiceTest, OpenStreamHoldsTheLease) {
  StartServer(WithLeaseHold(0.0));
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, Lease()));
  ASSERT_TRUE(stream.Read().has_opened());
  EXPECT_THAT(Register("r1").status(), Refuses(kPrecondition, "LEASE_HELD"));
}

TEST_F(RobotServiceTest, EachFieldIsNamedWhenItIsRefused) {
  StartServer();
  EXPECT_THAT(RegisterWith([](auto& request) { request.set_mission("hall"); }),
              RefusesField("mission"));
  EXPECT_THAT(RegisterWith([](auto& request) { request.set_robot_id("R 1"); }),
              RefusesField("robot_id"));
  EXPECT_THAT(RegisterWith([](auto& request) { request.set_radius_m(0.0); }),
              RefusesField("radius_m"));
}

TEST_F(RobotServiceTest, MissionMustExist) {
  StartServer();
  EXPECT_THAT(RegisterWith([](auto& request) { request.set_mission("missions/attic"); }),
              Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

TEST_F(RobotServiceTest, FullMissionTakesNoMoreRobots) {
  ServerConfig config;
  config.mission.max_robot_count = 1;
  StartServer(config);
  ASSERT_TRUE(Register("r1").ok());
  EXPECT_THAT(Register("r2").status(),
              Refuses(absl::StatusCode::kResourceExhausted, "RESOURCE_EXHAUSTED"));
}

TEST_F(RobotServiceTest, ARobotLeavesWithItsLeaseAndComesBackToItsLog) {
  StartServer();
  const std::int64_t lease = Lease();
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease));
  ASSERT_TRUE(stream.Read().has_opened());
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(1, 3)).ok());
  const auto removed = Remove(kRobot, lease);
  ASSERT_TRUE(removed.ok()) << removed.status();
  EXPECT_EQ(removed->revision(), Revision());
  EXPECT_THAT(stream.Finish(), Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_THAT(Ingest(kRobot, lease, GasReadings(4, 4)).status(),
              Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_THAT(Remove(kRobot, lease).status(), Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_EQ(GetMap()->status().robots_size(), 0);

  const auto back = Register("r1");
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_GT(back->lease_token(), lease);
  EXPECT_EQ(back->ingest_state().applied_sequence(), 3);
}

TEST_F(RobotServiceTest, OnlyForceRemovesARobotWithoutItsLease) {
  StartServer();
  const std::int64_t old_lease = Lease();
  ASSERT_TRUE(Register("r1", /*take_over=*/true).ok());
  const std::int64_t revision = Revision();
  EXPECT_THAT(Remove(kRobot, old_lease).status(), Refuses(kPrecondition, "LEASE_SUPERSEDED"));
  EXPECT_EQ(Revision(), revision);
  EXPECT_TRUE(Remove(kRobot, 0, /*force=*/true).ok());
  EXPECT_THAT(Remove(kRobot, 0, /*force=*/true).status(), Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_THAT(Remove("missions/attic/robots/r1", 0, true).status(),
              Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

class RobotsTest : public RobotServiceTest {
 protected:
  absl::StatusOr<v1::GetRobotResponse> Get(const std::string& robot) {
    v1::GetRobotRequest request;
    request.set_name(robot);
    return Call(robots_, &v1::RobotService::Stub::GetRobot, request);
  }
  absl::StatusOr<v1::ListRobotsResponse> List(int page_size, const std::string& token = "") {
    v1::ListRobotsRequest request;
    request.set_mission("missions/hall");
    request.set_page_size(page_size);
    request.set_page_token(token);
    return Call(robots_, &v1::RobotService::Stub::ListRobots, request);
  }
  absl::Status Release(const std::string& robot, std::int64_t lease_token, bool force = false) {
    v1::ReleaseLeaseRequest request;
    request.set_robot(robot);
    request.set_lease_token(lease_token);
    request.set_force(force);
    return Call(robots_, &v1::RobotService::Stub::ReleaseLease, request).status();
  }
};

TEST_F(RobotsTest, ARobotTellsWhereItIsAndWhoWritesItsLog) {
  StartServer(WithLeaseHold(3600.0));
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(1, 3)).ok());
  const auto robot = Get(kRobot);
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_EQ(robot->robot().on_map().robot(), kRobot);
  EXPECT_EQ(robot->robot().on_map().pose().x_m(), 2.0);
  EXPECT_EQ(robot->robot().on_map().applied_sequence(), 3);
  EXPECT_TRUE(robot->robot().leased());
  EXPECT_FALSE(robot->robot().streaming());
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease));
  ASSERT_TRUE(stream.Read().has_opened());
  EXPECT_TRUE(Get(kRobot)->robot().streaming());
  EXPECT_EQ(Revision(), 4) << "a look changes nothing";
  EXPECT_THAT(Get("missions/hall/robots/r2").status(), Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_THAT(Get("missions/attic/robots/r1").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

TEST_F(RobotsTest, PagesOfRobotsFollowEachOtherInOrderOfName) {
  StartServer();
  EXPECT_EQ(List(2)->robots_size(), 0);
  for (const char* robot : {"r3", "r1", "r2"}) ASSERT_TRUE(Register(robot).ok());
  const auto first = List(2);
  ASSERT_TRUE(first.ok()) << first.status();
  ASSERT_EQ(first->robots_size(), 2);
  EXPECT_EQ(first->robots(0).on_map().robot(), "missions/hall/robots/r1");
  EXPECT_EQ(first->robots(1).on_map().robot(), "missions/hall/robots/r2");
  const auto last = List(2, first->next_page_token());
  ASSERT_EQ(last->robots_size(), 1);
  EXPECT_EQ(last->robots(0).on_map().robot(), "missions/hall/robots/r3");
  EXPECT_EQ(last->next_page_token(), "");
}

TEST_F(RobotsTest, AReleasedLeaseIsFreeForTheNextClientAtOnce) {
  StartServer(WithLeaseHold(3600.0));
  const std::int64_t lease = Lease();
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease));
  ASSERT_TRUE(stream.Read().has_opened());
  EXPECT_THAT(Release(kRobot, lease + 1), Refuses(kPrecondition, "LEASE_SUPERSEDED"));
  ASSERT_TRUE(Release(kRobot, lease).ok());
  EXPECT_THAT(stream.Finish(), Refuses(kPrecondition, "LEASE_SUPERSEDED"));
  EXPECT_THAT(Ingest(kRobot, lease, GasReadings(1, 1)).status(),
              Refuses(kPrecondition, "LEASE_SUPERSEDED"));
  EXPECT_FALSE(Get(kRobot)->robot().leased());
  ASSERT_TRUE(Register("r1").ok());
  EXPECT_TRUE(Release(kRobot, 0, /*force=*/true).ok());
  EXPECT_TRUE(Register("r1").ok());
}

class OrderHomeTest : public RobotsTest {
 protected:
  absl::StatusOr<v1::OrderHomeResponse> Order(const std::string& robot, bool home,
                                              const std::string& request_id = "") {
    v1::OrderHomeRequest request;
    request.set_robot(robot);
    request.set_home(home);
    request.set_request_id(request_id);
    return Call(robots_, &v1::RobotService::Stub::OrderHome, request);
  }
  absl::StatusOr<v1::OrderHomeResponse> OrderAll(bool home) {
    v1::OrderHomeRequest request;
    request.set_mission("missions/hall");
    request.set_home(home);
    return Call(robots_, &v1::RobotService::Stub::OrderHome, request);
  }
};

TEST_F(OrderHomeTest, PlansLeadHomeUntilItIsTakenBack) {
  StartServer();
  const std::int64_t lease = Lease();
  for (int i = 1; i <= 4; ++i) ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(i)).ok());
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(5, {4.0, 1.5, 0.0})).ok());
  const auto ordered = Order(kRobot, true);
  ASSERT_TRUE(ordered.ok()) << ordered.status();
  EXPECT_EQ(ordered->revision(), Revision());
  EXPECT_TRUE(Get(kRobot)->robot().ordered_home());
  const auto homeward = NextBest(PlanFor(lease));
  ASSERT_TRUE(homeward.ok()) << homeward.status();
  EXPECT_EQ(homeward->plan().phase(), v1::MISSION_PHASE_RETURNING);
  EXPECT_THAT(homeward->plan().explanation(), testing::HasSubstr("ordered the robot home"));
  ASSERT_TRUE(Order(kRobot, false).ok());
  const auto onward = NextBest(PlanFor(lease));
  ASSERT_TRUE(onward.ok()) << onward.status();
  EXPECT_NE(onward->plan().phase(), v1::MISSION_PHASE_RETURNING);
}

TEST_F(OrderHomeTest, AllAreOrderedAtOnce) {
  StartServer();
  for (const char* robot : {"r1", "r2"}) ASSERT_TRUE(Register(robot).ok());
  for (const bool home : {true, false}) {
    ASSERT_TRUE(OrderAll(home).ok());
    const auto listed = List(0);
    ASSERT_TRUE(listed.ok()) << listed.status();
    EXPECT_EQ(listed->robots_size(), 2);
    for (const v1::Robot& robot : listed->robots()) EXPECT_EQ(robot.ordered_home(), home);
  }
}

TEST_F(OrderHomeTest, ARequestIsCarriedOutOnce) {
  StartServer();
  ASSERT_TRUE(Register("r1").ok());
  const auto first = Order(kRobot, true, "once");
  ASSERT_TRUE(first.ok()) << first.status();
  ASSERT_TRUE(Order(kRobot, false).ok());
  EXPECT_EQ(Order(kRobot, true, "once")->revision(), first->revision());
  EXPECT_FALSE(Get(kRobot)->robot().ordered_home());
}

TEST_F(OrderHomeTest, SaysWhoIsNotThere) {
  StartServer();
  EXPECT_THAT(Order("r1", true).status(), RefusesField("robot"));
  EXPECT_THAT(Order(kRobot, true).status(), Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_THAT(Order("missions/attic/robots/r1", true).status(),
              Refuses(kNotFound, "MISSION_NOT_FOUND"));
  const v1::OrderHomeRequest nobody;
  EXPECT_THAT(Call(robots_, &v1::RobotService::Stub::OrderHome, nobody).status(),
              RefusesField("target"));
}

}  // namespace robot_service_test
}  // namespace plumescout::server
