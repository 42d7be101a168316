// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "absl/time/time.h"
#include "client/robot_loop.h"
#include "tests/client/fake_driver.h"
#include "tests/client/fake_planner_client.h"
#include "tests/client/ingest_session_fixture.h"

namespace plumescout::client {

inline Plan PlanTo(PlanId id, const PlanQuery& query, Point2 goal) {
  constexpr double kSpeed_mps = 1.0;
  const Pose2 start = *query.request.start;
  const double length_m = Distance_m(start.position(), goal);
  const double yaw_rad = std::atan2(goal.y_m - start.y_m, goal.x_m - start.x_m);
  Plan plan;
  plan.id = id;
  plan.chosen = 0;
  plan.trajectory.waypoints = {
      {.pose = {start.x_m, start.y_m, yaw_rad}},
      {.pose = {goal.x_m, goal.y_m, yaw_rad}, .arrival_time_s = length_m / kSpeed_mps}};
  plan.trajectory.length_m = length_m;
  plan.trajectory.duration_s = length_m / kSpeed_mps;
  return plan;
}

// Sends the robot through `goals`, then says that the mission is complete.
inline FakePlannerClient::PlanScript Tour(std::vector<Point2> goals) {
  const auto next = std::make_shared<std::size_t>(0);
  return [goals, next](const PlanQuery& query) -> absl::StatusOr<Plan> {
    if (*next == goals.size()) return CompletePlan();
    const Point2 goal = goals[(*next)++];
    return PlanTo(static_cast<PlanId>(*next), query, goal);
  };
}

class RunNotes final : public RobotObserver {
 public:
  void OnTick(const RobotTick& tick) override { ticks.push_back(tick); }
  void OnLogged(const Observation& observation) override { logged.push_back(observation); }
  void OnPlan(const PlanArrival& plan) override { plan_times_s.push_back(plan.elapsed_s); }
  void OnPlanFailure(const absl::Status& status) override { failures.push_back(status); }

  std::vector<RobotTick> ticks;
  std::vector<Observation> logged;
  std::vector<double> plan_times_s;
  std::vector<absl::Status> failures;
};

inline RobotLoopOptions Options(Pacing pacing, Following following) {
  RobotLoopOptions options;
  options.participation = {.mission = "m", .robot = "r", .create = MissionOptions{}};
  options.pacing = pacing;
  options.following = following;
  options.time_limit_s = 600.0;
  options.ingest = QuickOptions();
  return options;
}

class RobotLoopTest : public ::testing::Test {
 protected:
  absl::StatusOr<RobotResult> Run(const RobotLoopOptions& options,
                                  const StopFn& stop = NeverStop()) {
    RobotLoop loop(server_, driver_, options, recorder_);
    return loop.Run(stop);
  }
  absl::StatusOr<RobotResult> RunInLockstep() {
    return Run(Options(Pacing::kLockstep, Following::kIdeal));
  }
  // A free-running robot whose world goes on once the server has applied what the robot said, and,
  // while it stands, has given it a plan if it asked for one.
  absl::StatusOr<RobotResult> RunFreely() {
    driver_.on_advance = [this, before = driver_.on_advance] {
      if (before) before();
      if (recorder_.ticks.empty()) return;
      const RobotTick& tick = recorder_.ticks.back();
      EXPECT_TRUE(server_.AwaitApplied(tick.ingest.last_sequence, absl::Seconds(10)));
      if (tick.plan == 0) {
        server_.AwaitPlans(recorder_.plan_times_s.size() + 1, absl::Milliseconds(50));
      }
    };
    return Run(Options(Pacing::kFreeRunning, Following::kProportional));
  }

  FakePlannerClient server_;
  FakeDriver driver_;
  RunNotes recorder_;
};

}  // namespace plumescout::client
