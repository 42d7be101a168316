// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/local/local_robot_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "lab/local/local_planner_client.h"
#include "tests/client/ingest_traffic.h"
#include "tests/support/scripted_strategy.h"

namespace plumescout::lab {
namespace local_robot_watch_test {

using client::kPatience;

class LocalRobotWatchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(service_.CreateMission("m", {}).ok());
    session_ = Join("r");
    auto watch = service_.WatchRobot(session_);
    ASSERT_TRUE(watch.ok());
    watch_ = *std::move(watch);
  }
  client::RobotSession Join(const RobotId& robot) {
    auto session = service_.RegisterRobot("m", robot, 0.2, /*take_over=*/true);
    EXPECT_TRUE(session.ok()) << session.status();
    return *std::move(session);
  }

  LocalPlannerClient service_;
  client::RobotSession session_;
  std::unique_ptr<client::RobotWatch> watch_;
};

TEST_F(LocalRobotWatchTest, TellsFirstHowTheRobotStandsAndThenNothingWithoutNews) {
  const auto first = watch_->TryRead();
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_EQ(*first, RobotNotice(RobotStanding{.leased = true}));
  EXPECT_TRUE(absl::IsDeadlineExceeded(watch_->TryRead().status()));
  EXPECT_TRUE(absl::IsDeadlineExceeded(watch_->Read(absl::Milliseconds(1)).status()));
}

TEST_F(LocalRobotWatchTest, ANewerLeaseEndsIt) {
  Join("r");
  EXPECT_TRUE(absl::IsFailedPrecondition(watch_->TryRead().status()));
}

TEST_F(LocalRobotWatchTest, ARobotThatLeftIsNotFound) {
  ASSERT_TRUE(service_.RemoveRobot("m", "r", session_.lease_token, false).ok());
  EXPECT_TRUE(absl::IsNotFound(watch_->TryRead().status()));
}

TEST_F(LocalRobotWatchTest, AMissionThatIsDeletedEndsAReadThatWaits) {
  ASSERT_TRUE(watch_->TryRead().ok());
  std::thread other([this] { EXPECT_TRUE(service_.DeleteMission("m").ok()); });
  EXPECT_TRUE(absl::IsNotFound(watch_->Read(kPatience).status()));
  other.join();
}

TEST_F(LocalRobotWatchTest, CancelEndsAReadThatWaits) {
  ASSERT_TRUE(watch_->TryRead().ok());
  std::thread other([this] { watch_->Cancel(); });
  EXPECT_TRUE(absl::IsCancelled(watch_->Read(kPatience).status()));
  other.join();
}

TEST_F(LocalRobotWatchTest, TellsThatTheRobotFellSilent) {
  const client::RobotSession other = Join("s");
  ASSERT_TRUE(watch_->TryRead().ok());
  const auto stream = service_.OpenObservationStream(other);
  ASSERT_TRUE(stream.ok());
  const auto own = service_.OpenObservationStream(session_);
  ASSERT_TRUE(own.ok());
  ASSERT_TRUE((*own)->Write({{1, 1'000'000'000, {}, GasReading{}}}).ok());
  // Others are heard of for longer than a robot may be silent.
  for (int i = 1; i <= 200; ++i) {
    ASSERT_TRUE(
        (*stream)->Write({{i, (1 + i) * 1'000'000'000LL, {3.0, 3.0, 0.0}, GasReading{}}}).ok());
  }
  bool silent = false;
  for (auto notice = watch_->TryRead(); notice.ok(); notice = watch_->TryRead()) {
    if (const auto* standing = std::get_if<RobotStanding>(&*notice)) silent = standing->silent;
  }
  EXPECT_TRUE(silent);
}

// Robot "late" stalls in a corridor before robot "next", which was given its way later.
class StalledRobotTest : public ::testing::Test {
 protected:
  static absl::StatusOr<Plan> Eastward(const Belief& belief, const PlanRequest& request,
                                       const StopFn&) {
    const Point2 start = belief.robots.at(request.robot).state.pose.position();
    Plan plan = support::PlanTo(belief, request.robot, start.x_m + 8.0);
    plan.trajectory.waypoints = {{{start.x_m, 0.0, 0.0}}, {{start.x_m + 8.0, 0.0, 0.0}, 8.0}};
    plan.trajectory.length_m = plan.trajectory.duration_s = 8.0;
    return plan;
  }
  struct Robot {
    std::unique_ptr<LocalRobotWatch> watch;
    client::RobotSession session;
    StreamId stream = 0;
    std::int64_t sequence = 0;
  };
  Robot Join(const RobotId& id) {
    Robot robot;
    robot.session = *mission_->Register({.robot = id, .radius_m = 0.2, .take_over = false});
    robot.stream = *mission_->OpenStream(id, robot.session.lease_token);
    robot.watch = std::make_unique<LocalRobotWatch>(mission_, robot.session);
    return robot;
  }
  void Tell(Robot& robot, double time_s, double x_m) {
    std::vector<client::ObservationRejected> rejected;
    const std::int64_t time_ns = std::llround(time_s * 1e9);
    ASSERT_TRUE(mission_
                    ->Ingest(robot.session.robot, robot.session.lease_token, robot.stream,
                             {{++robot.sequence, time_ns, {x_m, 0.0, 0.0}, GasReading{}}}, rejected)
                    .ok());
    ASSERT_TRUE(rejected.empty());
  }
  PlanId Ask(const Robot& robot) {
    client::PlanQuery query;
    query.request.robot = robot.session.robot;
    query.lease_token = robot.session.lease_token;
    query.timeout = kPatience;
    const auto plan = mission_->NextPlan(query);
    EXPECT_TRUE(plan.ok()) << plan.status();
    return plan.ok() ? plan->id : 0;
  }
  static std::vector<PlanInvalidated> Invalidations(Robot& robot) {
    std::vector<PlanInvalidated> told;
    for (auto notice = robot.watch->TryRead(); notice.ok(); notice = robot.watch->TryRead()) {
      if (const auto* one = std::get_if<PlanInvalidated>(&*notice)) told.push_back(*one);
    }
    return told;
  }

  const std::shared_ptr<LocalMission> mission_ = std::make_shared<LocalMission>(
      std::make_unique<Mission>(MissionOptions{}),
      std::make_unique<const support::ScriptedStrategy>(
          support::ScriptedStrategy::Script(&StalledRobotTest::Eastward)),
      LocalOptions{});
};

TEST_F(StalledRobotTest, WhoDrivesUpToItIsToldInTimeAndAloneAndOnce) {
  Robot late = Join("late");
  Robot next = Join("next");
  Tell(late, 1.0, 2.0);
  Tell(next, 1.0, -1.0);
  Ask(late);
  const PlanId plan = Ask(next);
  std::vector<PlanInvalidated> told;
  double told_at_m = 0.0;
  for (double time_s = 1.0; time_s < 4.0; time_s += 0.1) {
    Tell(late, time_s, 2.0 + std::min(time_s - 1.0, 0.5));
    const double x_m = told.empty() ? -1.0 + (time_s - 1.0) : told_at_m;
    Tell(next, time_s, x_m);
    for (PlanInvalidated& one : Invalidations(next)) {
      told.push_back(std::move(one));
      told_at_m = x_m;
    }
    EXPECT_TRUE(Invalidations(late).empty());
  }
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].plan, plan);
  EXPECT_EQ(told[0].robot, "late");
  EXPECT_LT(told_at_m, 2.5 - 0.4 - 0.25);  // with room to stop
}

}  // namespace local_robot_watch_test
}  // namespace plumescout::lab
