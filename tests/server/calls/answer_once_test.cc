// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/answer_once.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <string>
#include <utility>

#include "absl/synchronization/notification.h"
#include "tests/server/held_store.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace answer_once_test {

class AnswerOnceTest : public ServiceTest {
 protected:
  absl::StatusOr<v1::RegisterRobotResponse> RegisterAs(const std::string& request_id,
                                                       double radius_m = 0.2) {
    v1::RegisterRobotRequest request;
    request.set_mission("missions/hall");
    request.set_robot_id("r1");
    request.set_radius_m(radius_m);
    request.set_request_id(request_id);
    return Call(robots_, &v1::RobotService::Stub::RegisterRobot, request);
  }
  absl::StatusOr<v1::CreateMissionResponse> CreateAs(const std::string& request_id,
                                                     const std::string& mission) {
    v1::CreateMissionRequest request;
    request.set_mission_id(mission);
    request.set_request_id(request_id);
    return Call(missions_, &v1::MissionService::Stub::CreateMission, request);
  }
  v1::NextBestTrajectoryRequest PlanAs(const std::string& request_id) {
    v1::NextBestTrajectoryRequest request = PlanFor(lease_);
    request.set_request_id(request_id);
    return request;
  }
  std::int64_t lease_ = 0;
};

// The reply to the first was lost.
TEST_F(AnswerOnceTest, ARegistrationSentAgainGetsTheSameLease) {
  StartServer();
  const auto first = RegisterAs("a");
  const auto again = RegisterAs("a");
  ASSERT_TRUE(first.ok() && again.ok()) << first.status() << again.status();
  EXPECT_EQ(first->SerializeAsString(), again->SerializeAsString());
  EXPECT_EQ(Revision(), 1);
  EXPECT_THAT(RegisterAs("b").status(),
              Refuses(absl::StatusCode::kFailedPrecondition, "LEASE_HELD"));
  EXPECT_THAT(RegisterAs("").status(),
              Refuses(absl::StatusCode::kFailedPrecondition, "LEASE_HELD"));
}

TEST_F(AnswerOnceTest, AnIdStandsForOneRequestOnly) {
  StartServer();
  ASSERT_TRUE(RegisterAs("a", 0.2).ok());
  EXPECT_THAT(RegisterAs("a", 0.3).status(), RefusesField("request_id"));
}

TEST_F(AnswerOnceTest, AMissionIsMadeOnceUntilItIsDeleted) {
  StartServer();
  ASSERT_TRUE(CreateAs("a", "attic").ok());
  EXPECT_TRUE(CreateAs("a", "attic").ok());
  EXPECT_THAT(CreateAs("b", "attic").status(),
              Refuses(absl::StatusCode::kAlreadyExists, "MISSION_EXISTS"));
  ASSERT_TRUE(DeleteMission("attic").ok());
  ASSERT_TRUE(CreateAs("a", "attic").ok());
  EXPECT_TRUE(DeleteMission("attic").ok()) << "it was made anew";
}

TEST_F(AnswerOnceTest, ErrorsAreNotKept) {
  StartServer();
  EXPECT_FALSE(RegisterAs("a", -1.0).ok());
  EXPECT_TRUE(RegisterAs("a", 0.2).ok());
}

TEST_F(AnswerOnceTest, IdsAreWords) {
  StartServer();
  EXPECT_THAT(RegisterAs("a b").status(), RefusesField("request_id"));
  EXPECT_THAT(RegisterAs(std::string(65, 'a')).status(), RefusesField("request_id"));
  EXPECT_TRUE(RegisterAs(std::string(64, 'a')).ok());
}

TEST_F(AnswerOnceTest, WhoAsksWhileThePlanIsMadeGetsTheSamePlan) {
  std::atomic<int> searches = 0;
  absl::Notification searching;
  absl::Notification release;
  StartServer({},
              ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
                if (++searches == 1) searching.Notify();
                release.WaitForNotification();
                return PlanTo(belief, request.robot, 1.0);
              }));
  lease_ = Lease();
  auto first = std::async(std::launch::async, [&] { return NextBest(PlanAs("a")); });
  searching.WaitForNotification();
  auto second = std::async(std::launch::async, [&] { return NextBest(PlanAs("a")); });
  release.Notify();
  const auto plan = first.get();
  const auto same = second.get();
  ASSERT_TRUE(plan.ok() && same.ok()) << plan.status() << same.status();
  EXPECT_EQ(plan->plan().name(), "missions/hall/plans/1");
  EXPECT_EQ(plan->SerializeAsString(), same->SerializeAsString());
  EXPECT_EQ(searches, 1);
  EXPECT_EQ(NextBest(PlanAs("b"))->plan().name(), "missions/hall/plans/2");
}

TEST_F(AnswerOnceTest, IfTheFirstGivesUpTheSecondRuns) {
  std::atomic<int> searches = 0;
  absl::Notification searching;
  StartServer(
      {}, ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn& stop) {
        if (++searches == 1) {
          searching.Notify();
          while (!stop()) {
          }
        }
        return PlanTo(belief, request.robot, 1.0);
      }));
  lease_ = Lease();
  grpc::ClientContext context;
  SetPatience(context);
  auto first = std::async(std::launch::async, [&] {
    v1::NextBestTrajectoryResponse response;
    return ToAbsl(planning_->NextBestTrajectory(&context, PlanAs("a"), &response));
  });
  searching.WaitForNotification();
  auto second = std::async(std::launch::async, [&] { return NextBest(PlanAs("a")); });
  context.TryCancel();
  EXPECT_TRUE(absl::IsCancelled(first.get()));
  const auto plan = second.get();
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(plan->plan().name(), "missions/hall/plans/1");
  EXPECT_EQ(searches, 2);
}

TEST_F(AnswerOnceTest, WhoWaitsMayGiveUp) {
  absl::Notification searching;
  absl::Notification release;
  StartServer({},
              ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
                searching.Notify();
                release.WaitForNotification();
                return PlanTo(belief, request.robot, 1.0);
              }));
  lease_ = Lease();
  auto first = std::async(std::launch::async, [&] { return NextBest(PlanAs("a")).status(); });
  searching.WaitForNotification();
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(50));
  v1::NextBestTrajectoryResponse response;
  const grpc::Status waited = planning_->NextBestTrajectory(&context, PlanAs("a"), &response);
  EXPECT_EQ(waited.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  release.Notify();
  EXPECT_TRUE(first.get().ok());
}

// A server whose disk hangs when told so, and that waits for it no longer than 0.1 s.
class LateAnswerTest : public AnswerOnceTest {
 protected:
  ~LateAnswerTest() override {
    store_.Release();
    server_.reset();
  }
  void Start(RegistryHooks hooks = {}, double max_wait_s = 0.1) {
    ServerConfig config;
    config.limits.max_wait_s = max_wait_s;
    hooks.store = &store_;
    StartServer(config, std::move(hooks));
  }
  // One plan to drive, after this many searches at most.
  void StartToPlan() {
    Start(ScriptedHooks([this](const Belief& belief, const PlanRequest& request, const StopFn&) {
      ++searches_;
      return PlanTo(belief, request.robot, 1.0);
    }));
    lease_ = Lease();
  }
  static auto IsLate() { return Refuses(absl::StatusCode::kUnavailable, "STORE_UNAVAILABLE"); }
  absl::StatusOr<v1::PlanTeamResponse> PlanTeamAs(const std::string& request_id) {
    v1::PlanTeamRequest request;
    request.set_mission("missions/hall");
    request.add_robots(kRobot);
    request.set_request_id(request_id);
    return Call(planning_, &v1::PlanningService::Stub::PlanTeam, request);
  }

  HeldStore store_;
  std::atomic<int> searches_ = 0;
};

TEST_F(LateAnswerTest, WhatWasDoneIsNotDoneAgainWhenItIsDurableLate) {
  Start();
  store_.Hold();
  EXPECT_THAT(RegisterAs("a").status(), IsLate());
  EXPECT_THAT(RegisterAs("a").status(), IsLate()) << "it waits as the first did";
  EXPECT_THAT(RegisterAs("a", 0.3).status(), RefusesField("request_id"));
  store_.Release();
  const auto late = RegisterAs("a");
  ASSERT_TRUE(late.ok()) << late.status();
  EXPECT_EQ(Revision(), 1);
  EXPECT_EQ(RegisterAs("a")->SerializeAsString(), late->SerializeAsString());
}

TEST_F(LateAnswerTest, AMissionIsMadeOnce) {
  Start();
  store_.Hold();
  v1::CreateMissionRequest request;
  request.set_mission_id("attic");
  request.set_request_id("a");
  request.mutable_idle_time_to_live()->set_seconds(3600);
  const auto create = [&] {
    return Call(missions_, &v1::MissionService::Stub::CreateMission, request);
  };
  EXPECT_THAT(create().status(), IsLate());
  store_.Release();
  const auto late = create();
  ASSERT_TRUE(late.ok()) << late.status();
  EXPECT_EQ(late->mission().name(), "missions/attic");
  ASSERT_TRUE(DeleteMission("attic").ok());
  EXPECT_TRUE(create().ok()) << "it is made anew";
}

TEST_F(LateAnswerTest, WhoCameMeanwhileHearsWhenItIsDurable) {
  Start({}, /*max_wait_s=*/1.0);
  store_.Hold();
  auto first = std::async(std::launch::async, [&] { return RegisterAs("a"); });
  store_.AwaitHeld(1);
  auto second = std::async(std::launch::async, [&] { return RegisterAs("a"); });
  EXPECT_THAT(first.get().status(), IsLate());
  store_.Release();
  const auto late = second.get();
  ASSERT_TRUE(late.ok()) << late.status();
  EXPECT_EQ(Revision(), 1);
}

TEST_F(LateAnswerTest, WhatIsLostIsForgotten) {
  Start();
  store_.Hold();
  EXPECT_THAT(RegisterAs("a").status(), IsLate());
  ASSERT_TRUE(store_.Acquire("hall").ok());  // by another server
  store_.Release();
  EXPECT_FALSE(RegisterAs("a").ok());
}

TEST_F(LateAnswerTest, APlanIsMadeOnce) {
  StartToPlan();
  store_.Hold();
  EXPECT_THAT(NextBest(PlanAs("a")).status(), IsLate());
  store_.Release();
  const auto late = NextBest(PlanAs("a"));
  ASSERT_TRUE(late.ok()) << late.status();
  EXPECT_EQ(late->plan().name(), "missions/hall/plans/1");
  EXPECT_EQ(searches_, 1);
}

TEST_F(LateAnswerTest, AGivenUpPlanThatWasCommittedIsTold) {
  StartToPlan();
  store_.Hold();
  grpc::ClientContext context;
  SetPatience(context);
  auto first = std::async(std::launch::async, [&] {
    v1::NextBestTrajectoryResponse response;
    return ToAbsl(planning_->NextBestTrajectory(&context, PlanAs("a"), &response));
  });
  store_.AwaitHeld(1);
  context.TryCancel();
  EXPECT_TRUE(absl::IsCancelled(first.get()));
  store_.Release();
  const auto late = NextBest(PlanAs("a"));
  ASSERT_TRUE(late.ok()) << late.status();
  EXPECT_EQ(late->plan().name(), "missions/hall/plans/1");
  EXPECT_EQ(searches_, 1);
}

TEST_F(LateAnswerTest, ATeamIsPlannedOnce) {
  StartToPlan();
  store_.Hold();
  EXPECT_THAT(PlanTeamAs("a").status(), IsLate());
  store_.Release();
  const auto late = PlanTeamAs("a");
  ASSERT_TRUE(late.ok()) << late.status();
  ASSERT_EQ(late->plans_size(), 1);
  EXPECT_EQ(late->plans(0).name(), "missions/hall/plans/1");
}

}  // namespace answer_once_test
}  // namespace plumescout::server
