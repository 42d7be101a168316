// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/team_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "absl/synchronization/notification.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace team_job_test {

// One order for a team of two, and the answer to it.
class TeamJobTest : public testing::Test {
 protected:
  void StartHost(ScriptedStrategy::Script script) {
    host_ = std::make_shared<MissionHost>(HostParts(std::move(script)), HostOptions{});
    ASSERT_TRUE(host_
                    ->Post([](MissionWriter& writer) {
                      for (const char* const robot : {"r1", "r2"}) {
                        EXPECT_TRUE(writer.conduct().Register({robot, 0.2, 7}).ok());
                      }
                    })
                    .ok());
  }
  void TearDown() override {
    if (host_ != nullptr) host_->Stop(absl::NotFoundError("over"));
  }
  std::shared_ptr<TeamJob> Start(std::vector<RobotId> robots = {"r1", "r2"}) {
    TeamOrder order;
    order.request.robots = std::move(robots);
    auto job = std::make_shared<TeamJob>(TeamJob::Parts{
        host_, &pool_, std::move(order), [this](absl::StatusOr<CommittedTeam> answer) {
          answer_ = std::move(answer);
          answered_.Notify();
        }});
    job->Start();
    return job;
  }
  const absl::StatusOr<CommittedTeam>& Answer() {
    answered_.WaitForNotification();
    return *answer_;
  }
  RobotRecord RecordOf(const RobotId& robot) {
    RobotRecord record;
    absl::Notification done;
    EXPECT_TRUE(host_
                    ->Post([&](MissionWriter& writer) {
                      record = writer.conduct().Snapshot()->robots.at(robot);
                      done.Notify();
                    })
                    .ok());
    done.WaitForNotification();
    return record;
  }

  std::shared_ptr<MissionHost> host_;
  std::optional<absl::StatusOr<CommittedTeam>> answer_;
  absl::Notification answered_;
  FairPool pool_{{.name = "planning", .threads = 2, .max_queued = 4}};
};

// Each has a goal of its own.
absl::StatusOr<Plan> DriveApart(const Belief& belief, const PlanRequest& request, const StopFn&) {
  return PlanTo(belief, request.robot, request.robot == "r1" ? 1.0 : 5.0);
}

TEST_F(TeamJobTest, EveryPlanIsCommittedAndAssigned) {
  StartHost(DriveApart);
  Start();
  ASSERT_TRUE(Answer().ok()) << Answer().status();
  ASSERT_EQ(Answer()->plans.size(), 2U);
  EXPECT_TRUE(Answer()->left_out.empty());
  EXPECT_EQ(Answer()->order_count, 1);
  for (const Plan& plan : Answer()->plans) {
    EXPECT_GT(plan.id, 0);
    EXPECT_EQ(RecordOf(plan.robot).assigned_plan, plan.id);
  }
}

TEST_F(TeamJobTest, WhatIsRefusedAtItsCommitIsLeftOutAndNamed) {
  StartHost([](const Belief& belief, const PlanRequest& request, const StopFn&) {
    return PlanTo(belief, request.robot, 1.0);  // whatever others are to do
  });
  Start();
  ASSERT_TRUE(Answer().ok()) << Answer().status();
  EXPECT_EQ(Answer()->plans.size(), 1U);
  ASSERT_EQ(Answer()->left_out.size(), 1U);
  EXPECT_EQ(Answer()->left_out[0].robot, "r2");
  EXPECT_THAT(Answer()->left_out[0].why, testing::HasSubstr("claimed by robot \"r1\""));
}

TEST_F(TeamJobTest, WhoIsToStayIsLeftOutWithTheReason) {
  StartHost([](const Belief&, const PlanRequest& request, const StopFn&) {
    Plan plan;
    plan.robot = request.robot;
    plan.explanation = "Stay: nothing is left.";
    return plan;
  });
  Start({"r1"});
  ASSERT_TRUE(Answer().ok()) << Answer().status();
  ASSERT_EQ(Answer()->left_out.size(), 1U);
  EXPECT_EQ(Answer()->left_out[0].why, "Stay: nothing is left.");
  EXPECT_EQ(RecordOf("r1").plans_issued, 0);
}

TEST_F(TeamJobTest, AnUnknownRobotChangesNothing) {
  StartHost(DriveApart);
  Start({"r1", "r9"});
  EXPECT_TRUE(absl::IsNotFound(Answer().status()));
  EXPECT_EQ(RecordOf("r1").plans_issued, 0);
}

TEST_F(TeamJobTest, WhoGivesUpIsToldAtOnceAndNothingIsCommitted) {
  absl::Notification searching;
  StartHost([&](const Belief& belief, const PlanRequest& request, const StopFn& stop) {
    if (!searching.HasBeenNotified()) searching.Notify();
    while (!stop()) {
    }
    return PlanTo(belief, request.robot, 1.0);
  });
  const auto job = Start({"r1"});
  searching.WaitForNotification();
  job->Cancel();
  EXPECT_TRUE(absl::IsCancelled(Answer().status()));
  EXPECT_EQ(RecordOf("r1").plans_issued, 0);
}

TEST_F(TeamJobTest, AStoppedMissionAnswersToo) {
  StartHost(DriveApart);
  host_->Stop(absl::NotFoundError("MISSION_NOT_FOUND: missions/hall"));
  Start();
  EXPECT_TRUE(absl::IsNotFound(Answer().status()));
}

}  // namespace team_job_test
}  // namespace plumescout::server
