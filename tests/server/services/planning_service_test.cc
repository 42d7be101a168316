// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/planning_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <future>
#include <string>

#include "absl/synchronization/notification.h"
#include "proto/convert/geometry.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace planning_service_test {

constexpr auto kNotFound = absl::StatusCode::kNotFound;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;
// Of the 60 s that the calls of these tests may take, all but a moment is kept back.
constexpr double kMostOfPatience_s = 59.9;

constexpr int kScans = 4;

using NextBestResponse = absl::StatusOr<v1::NextBestTrajectoryResponse>;

// Scans of a room whose far walls are out of sight, as many as it takes to trust them.
v1::ObservationBatch CornerScans(const Pose2& pose = {2.0, 1.5, 0.0}) {
  constexpr double kSide_m = 30.0;
  v1::ObservationBatch batch;
  for (std::int64_t sequence = 1; sequence <= kScans; ++sequence) {
    *batch.add_observations() =
        ToProto(Observation{sequence, 0, pose, support::ScanInBox(pose, kSide_m, kSide_m)});
  }
  return batch;
}

class PlanningServiceTest : public ServiceTest {
 protected:
  // A server with a robot that has seen one corner of a room; `script`: how missions plan.
  void Start(ServerConfig config = {}, ScriptedStrategy::Script script = nullptr) {
    StartServer(config, script == nullptr ? RegistryHooks{} : ScriptedHooks(std::move(script)));
    lease_ = Lease();
    ASSERT_TRUE(Ingest(kRobot, lease_, CornerScans()).ok());
  }
  v1::NextBestTrajectoryRequest Order() const { return PlanFor(lease_); }
  NextBestResponse NextBestWith(const std::function<void(v1::NextBestTrajectoryRequest&)>& change) {
    v1::NextBestTrajectoryRequest request = Order();
    change(request);
    return NextBest(request);
  }
  absl::StatusOr<v1::ReportProgressResponse> Report(
      std::int64_t plan,
      const std::function<void(v1::ReportProgressRequest&)>& change = [](auto&) {}) {
    v1::ReportProgressRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease_);
    request.set_plan(absl::StrCat("missions/hall/plans/", plan));
    request.set_outcome(v1::ReportProgressRequest::OUTCOME_REACHED);
    change(request);
    return Call(planning_, &v1::PlanningService::Stub::ReportProgress, request);
  }

  std::int64_t lease_ = 0;
};

// Searches until told to stop, then goes where there was nothing to search.
absl::StatusOr<Plan> SearchUntilStopped(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop) {
  while (!stop()) {
  }
  return PlanTo(belief, request.robot, 1.0);
}

absl::StatusOr<Plan> DriveEast(const Belief& belief, const PlanRequest& request, const StopFn&) {
  return PlanTo(belief, request.robot, 1.0);
}

TEST_F(PlanningServiceTest, AReportWhoseAnswerWasLostMayBeMadeAgain) {
  Start();
  ASSERT_TRUE(NextBest(Order()).ok());
  const auto name = [](v1::ReportProgressRequest& request) { request.set_request_id("report-1"); };
  const auto first = Report(1, name);
  ASSERT_TRUE(first.ok()) << first.status();
  ASSERT_TRUE(NextBest(Order()).ok());  // by now another plan counts
  const auto again = Report(1, name);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ(again->revision(), first->revision());
  EXPECT_FALSE(Report(1).ok()) << "without its name it is another report";
}

TEST_F(PlanningServiceTest, PlanStartsAtTheRobotAndIsCommitted) {
  Start();
  const auto response = NextBest(Order());
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->plan().name(), "missions/hall/plans/1");
  EXPECT_EQ(response->plan().robot(), kRobot);
  ASSERT_GE(response->plan().chosen_index(), 0) << response->plan().explanation();
  ASSERT_GT(response->plan().trajectory().waypoints_size(), 1);
  EXPECT_EQ(response->plan().trajectory().waypoints(0).pose().x_m(), 2.0);
  EXPECT_EQ(response->plan().trajectory().waypoints(0).pose().y_m(), 1.5);
  EXPECT_GT(Revision(), response->plan().belief_revision());
}

TEST_F(PlanningServiceTest, SameSeedAndBeliefMakeTheSameTrajectory) {
  Start();
  const auto order = [](auto& request) {
    request.set_seed(17);
    request.set_max_edge_evaluation_count(1000);
  };
  const auto first = NextBestWith(order);
  const auto second = NextBestWith(order);
  ASSERT_TRUE(first.ok() && second.ok()) << first.status() << second.status();
  EXPECT_GT(first->plan().trajectory().waypoints_size(), 1);
  EXPECT_EQ(first->plan().trajectory().SerializeAsString(),
            second->plan().trajectory().SerializeAsString());
}

TEST_F(PlanningServiceTest, PlanWaitsForTheReadingsOfItsRobot) {
  std::atomic<std::int64_t> applied = 0;
  Start({}, [&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    applied = belief.robots.at("r1").state.applied_sequence;
    return PlanTo(belief, request.robot, 1.0);
  });
  auto response = std::async(std::launch::async, [&] {
    return NextBestWith([](auto& request) { request.set_min_applied_sequence(kScans + 2); });
  });
  ASSERT_TRUE(Ingest(kRobot, lease_, GasReadings(kScans + 1, kScans + 2)).ok());
  EXPECT_TRUE(response.get().ok());
  EXPECT_EQ(applied, kScans + 2);
}

TEST_F(PlanningServiceTest, ReadingsThatDoNotComeAreWaitedForUntilTheDeadline) {
  ServerConfig config;
  config.planning.deadline_margin_s = kMostOfPatience_s;
  Start(config, DriveEast);
  const absl::Status refused =
      NextBestWith([](auto& request) { request.set_min_applied_sequence(1000); }).status();
  EXPECT_THAT(refused, Refuses(absl::StatusCode::kDeadlineExceeded, "DEADLINE_EXCEEDED"));
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("stands at 4"));
}

TEST_F(PlanningServiceTest, DeadlineOfTheCallStopsTheSearchInTimeForAReply) {
  ServerConfig config;
  config.planning.deadline_margin_s = kMostOfPatience_s;
  Start(config, SearchUntilStopped);
  const auto response =
      NextBestWith([](auto& request) { request.mutable_planning_budget()->set_seconds(3600); });
  EXPECT_TRUE(response.ok()) << response.status();
}

TEST_F(PlanningServiceTest, BudgetStopsTheSearch) {
  Start({}, SearchUntilStopped);
  const auto response = NextBestWith([](auto& request) {
    request.mutable_planning_budget()->set_seconds(0);
    request.mutable_planning_budget()->set_nanos(1'000'000);
  });
  EXPECT_TRUE(response.ok()) << response.status();
}

TEST_F(PlanningServiceTest, BudgetBeyondTheServersIsCutToIt) {
  ServerConfig config;
  config.planning.max_budget_s = 0.001;
  Start(config, SearchUntilStopped);
  const auto response =
      NextBestWith([](auto& request) { request.mutable_planning_budget()->set_seconds(3600); });
  EXPECT_TRUE(response.ok()) << response.status();
}

TEST_F(PlanningServiceTest, MissionThatSearchesLeavesAThreadToTheOthers) {
  absl::Notification release;
  std::atomic<int> searching = 0;
  ServerConfig config;
  config.planning.threads = 2;
  Start(config, [&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    ++searching;
    if (request.robot != "quick") release.WaitForNotification();
    return PlanTo(belief, request.robot, request.robot == "r2" ? 5.0 : 1.0);
  });
  v1::NextBestTrajectoryRequest second = Order();
  second.set_robot("missions/hall/robots/r2");
  second.set_lease_token(Register("r2")->lease_token());
  auto first_plan = std::async(std::launch::async, [&] { return NextBest(Order()); });
  auto second_plan = std::async(std::launch::async, [&] { return NextBest(second); });
  while (searching == 0) {
  }
  ASSERT_TRUE(CreateMission("attic").ok());
  v1::RegisterRobotRequest robot;
  robot.set_mission("missions/attic");
  robot.set_robot_id("quick");
  robot.set_radius_m(0.2);
  const auto registered = Call(robots_, &v1::RobotService::Stub::RegisterRobot, robot);
  ASSERT_TRUE(registered.ok()) << registered.status();
  v1::NextBestTrajectoryRequest quick = Order();
  quick.set_robot("missions/attic/robots/quick");
  quick.set_lease_token(registered->lease_token());
  EXPECT_TRUE(NextBest(quick).ok());
  EXPECT_EQ(searching, 2) << "one of the hall, one of the attic";
  release.Notify();
  EXPECT_TRUE(first_plan.get().ok());
  EXPECT_TRUE(second_plan.get().ok());
}

TEST_F(PlanningServiceTest, CancelStopsTheSearchAndCommitsNothing) {
  absl::Notification searching;
  absl::Notification stopped;
  Start({}, [&](const Belief& belief, const PlanRequest& request, const StopFn& stop) {
    searching.Notify();
    auto plan = SearchUntilStopped(belief, request, stop);
    stopped.Notify();
    return plan;
  });
  grpc::ClientContext context;
  SetPatience(context);
  auto status = std::async(std::launch::async, [&] {
    v1::NextBestTrajectoryRequest request = Order();
    request.mutable_planning_budget()->set_seconds(3600);
    v1::NextBestTrajectoryResponse response;
    return ToAbsl(planning_->NextBestTrajectory(&context, request, &response));
  });
  searching.WaitForNotification();
  context.TryCancel();
  EXPECT_TRUE(absl::IsCancelled(status.get()));
  stopped.WaitForNotification();
  // One thread of the pool is free again, and the goal is nobody's.
  EXPECT_EQ(Report(1).status().code(), kNotFound);
}

TEST_F(PlanningServiceTest, ErrorsOfTheSearchReachTheCaller) {
  Start();
  ASSERT_TRUE(Register("r2").ok());
  EXPECT_THAT(NextBestWith([&](auto& request) {
                request.set_robot("missions/hall/robots/r2");
                request.set_lease_token(Register("r2", /*take_over=*/true)->lease_token());
              }).status(),
              Refuses(kPrecondition, "FAILED_PRECONDITION"));
  EXPECT_THAT(NextBestWith([](auto& request) { request.mutable_start()->set_x_m(500.0); }).status(),
              RefusesField("start"));
}

TEST_F(PlanningServiceTest, AStartOffTheMapIsRefusedWithItsReason) {
  Start();
  EXPECT_THAT(NextBestWith([](auto& request) { request.mutable_start()->set_x_m(500.0); }).status(),
              Refuses(absl::StatusCode::kInvalidArgument, "START_OUTSIDE_MAP"));
}

TEST_F(PlanningServiceTest, AStartInAnotherRobotIsRefusedWithItsReason) {
  Start();
  const Pose2 away{6.0, 1.5, 0.0};
  const std::int64_t lease = Register("r2")->lease_token();
  ASSERT_TRUE(Ingest("missions/hall/robots/r2", lease, CornerScans(away)).ok());
  const auto refused =
      NextBestWith([&](auto& request) { *request.mutable_start() = ToProto(away); });
  EXPECT_THAT(refused.status(), Refuses(absl::StatusCode::kInvalidArgument, "START_IN_ROBOT"));
  EXPECT_THAT(refused.status(), RefusesField("start"));
  EXPECT_TRUE(NextBest(Order()).ok());
}

TEST_F(PlanningServiceTest, OfTwoRobotsAtOnePlaceOneIsRefusedPlans) {
  Start();
  const std::int64_t lease = Register("r2")->lease_token();
  ASSERT_TRUE(Ingest("missions/hall/robots/r2", lease, CornerScans()).ok());
  const auto refused = NextBestWith([&](auto& request) {
    request.set_robot("missions/hall/robots/r2");
    request.set_lease_token(lease);
  });
  EXPECT_THAT(refused.status(), Refuses(kPrecondition, "START_IN_ROBOT"));
  EXPECT_TRUE(NextBest(Order()).ok());
}

TEST_F(PlanningServiceTest, ABudgetForNoPlanAtAllIsRefusedWithItsReason) {
  Start();
  const auto refused = NextBestWith([](auto& request) {
    request.mutable_planning_budget()->set_seconds(0);
    request.mutable_planning_budget()->set_nanos(1);
  });
  EXPECT_THAT(refused.status(),
              Refuses(absl::StatusCode::kDeadlineExceeded, "DEADLINE_BEFORE_FIRST_PLAN"));
}

TEST_F(PlanningServiceTest, ARobotThatStandsNowhereFreeIsToldSo) {
  StartServer();
  lease_ = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease_, RoomScan(1)).ok());  // one scan makes no cell free
  const auto response = NextBest(Order());
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->plan().end(), v1::Plan::END_START_OCCUPIED);
  EXPECT_EQ(response->plan().chosen_index(), -1);
  EXPECT_NE(response->plan().explanation(), "");
}

TEST_F(PlanningServiceTest, APlanWithoutGoalsSaysWhatBecameOfThem) {
  ServerConfig config;
  config.mission.planning.min_goal_distance_m = 100.0;
  Start(config);
  const auto rejected = NextBest(Order());
  ASSERT_TRUE(rejected.ok()) << rejected.status();
  EXPECT_EQ(rejected->plan().end(), v1::Plan::END_ALL_GOALS_REJECTED);
  ASSERT_GT(rejected->plan().rejected_goals_size(), 0);
  const auto at_home = NextBestWith([](auto& request) { request.set_go_home(true); });
  ASSERT_TRUE(at_home.ok()) << at_home.status();
  EXPECT_EQ(at_home->plan().end(), v1::Plan::END_NO_GOALS);
  EXPECT_EQ(at_home->plan().rejected_goals_size(), 0);
  EXPECT_EQ(at_home->plan().explanation(), "Stay: the robot is home.");
}

TEST_F(PlanningServiceTest, GoalOfAnotherRobotAborts) {
  Start({}, DriveEast);
  ASSERT_TRUE(NextBest(Order()).ok());
  EXPECT_THAT(NextBestWith([&](auto& request) {
                request.set_robot("missions/hall/robots/r2");
                request.set_lease_token(Register("r2")->lease_token());
              }).status(),
              Refuses(absl::StatusCode::kAborted, "ABORTED"));
}

TEST_F(PlanningServiceTest, StrangersAndOldLeasesGetNoPlan) {
  Start({}, DriveEast);
  EXPECT_THAT(
      NextBestWith([](auto& request) { request.set_robot("missions/hall/robots/r9"); }).status(),
      Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_THAT(
      NextBestWith([](auto& request) { request.set_robot("missions/attic/robots/r1"); }).status(),
      Refuses(kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(NextBestWith([](auto& request) { request.set_robot("r1"); }).status(),
              RefusesField("robot"));
  ASSERT_TRUE(Register("r1", /*take_over=*/true).ok());
  EXPECT_THAT(NextBest(Order()).status(), Refuses(kPrecondition, "LEASE_SUPERSEDED"));
}

TEST_F(PlanningServiceTest, FrontiersAreListedAsThePlanSawThem) {
  Start();
  v1::ListFrontiersRequest request;
  request.set_robot(kRobot);
  const auto listed = Call(planning_, &v1::PlanningService::Stub::ListFrontiers, request);
  ASSERT_TRUE(listed.ok()) << listed.status();
  const auto planned = NextBest(Order());
  ASSERT_TRUE(planned.ok()) << planned.status();
  int offered = 0;
  for (const v1::FrontierGoal& frontier : listed->frontiers()) {
    if (frontier.reason() != v1::RejectedGoal::REASON_UNSPECIFIED) continue;
    ++offered;
    EXPECT_GT(frontier.travel_m(), 0.0);
  }
  EXPECT_EQ(offered, planned->plan().candidates_size());
  EXPECT_EQ(listed->frontiers_size() - offered, planned->plan().rejected_goals_size());
}

TEST_F(PlanningServiceTest, ARobotThatWasNeverSeenHasNoFrontiers) {
  Start();
  ASSERT_TRUE(Register("r2").ok());
  v1::ListFrontiersRequest request;
  request.set_robot("missions/hall/robots/r2");
  EXPECT_THAT(Call(planning_, &v1::PlanningService::Stub::ListFrontiers, request).status(),
              Refuses(kPrecondition, "FAILED_PRECONDITION"));
}

TEST_F(PlanningServiceTest, RepeatedReportChangesNothing) {
  Start({}, DriveEast);
  ASSERT_TRUE(NextBest(Order()).ok());
  const auto first = Report(1);
  ASSERT_TRUE(first.ok()) << first.status();
  const auto second = Report(1);
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_EQ(second->revision(), first->revision());
  EXPECT_EQ(Revision(), first->revision());
}

TEST_F(PlanningServiceTest, ReportsOfOtherPlansAreRefused) {
  Start({}, DriveEast);
  EXPECT_THAT(Report(1).status(), Refuses(kNotFound, "NOT_FOUND"));
  ASSERT_TRUE(NextBest(Order()).ok());
  ASSERT_TRUE(NextBest(Order()).ok());
  EXPECT_THAT(Report(1).status(), Refuses(kPrecondition, "PLAN_SUPERSEDED"));
  EXPECT_THAT(Report(2, [](auto& request) { request.set_plan("missions/attic/plans/2"); }).status(),
              RefusesField("plan"));
  EXPECT_THAT(Report(2, [](auto& request) { request.clear_outcome(); }).status(),
              RefusesField("outcome"));
  EXPECT_THAT(Report(2, [](auto& request) { request.set_lease_token(1); }).status(),
              Refuses(kPrecondition, "LEASE_SUPERSEDED"));
}

}  // namespace planning_service_test
}  // namespace plumescout::server
