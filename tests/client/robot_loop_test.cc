// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>
#include <vector>

#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "tests/client/robot_loop_fixture.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace robot_loop_test {

using ::testing::SizeIs;

TEST_F(RobotLoopTest, InLockstepItVisitsEveryGoalAndEndsWithTheMission) {
  server_.set_script(Tour({{1, 0}, {1, 2}}));

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->end, RobotEnd::kMissionComplete);
  EXPECT_EQ(result->plans, 3);
  EXPECT_EQ(result->reached, 2);
  EXPECT_NEAR(result->distance_m, 3.0, 1e-6);
  EXPECT_EQ(driver_.pose().position(), (Point2{1, 2}));
}

TEST_F(RobotLoopTest, ItsObserverIsToldOfAllThatItLogs) {
  server_.set_script(Tour({{1, 0}}));
  driver_.status = [](std::int64_t) { return RobotStatus{0.5}; };

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok()) << result.status();
  const std::vector<Observation>& logged = recorder_.logged;
  ASSERT_EQ(std::ssize(logged), result->ingest.last_sequence);
  int statuses = 0;
  for (std::size_t i = 0; i < logged.size(); ++i) {
    EXPECT_EQ(logged[i].sequence, static_cast<std::int64_t>(i) + 1);
    statuses += std::holds_alternative<RobotStatus>(logged[i].payload) ? 1 : 0;
  }
  EXPECT_GT(statuses, 0);
  const auto* scan = std::get_if<Scan>(&logged[0].payload);
  ASSERT_NE(scan, nullptr);
  EXPECT_EQ(scan->ranges_m.size(), 90u);
}

TEST_F(RobotLoopTest, PlanningCostsTheFixedLatencyOfRobotTime) {
  server_.set_script(Tour({{1, 0}, {1, 2}}));
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.look_around_s = 0.5;
  options.plan_latency_s = 0.3;

  ASSERT_TRUE(Run(options).ok());

  ASSERT_THAT(recorder_.plan_times_s, SizeIs(3));
  EXPECT_NEAR(recorder_.plan_times_s[0], 0.5, 1e-6);
  EXPECT_NEAR(recorder_.plan_times_s[1], 0.5 + 0.3 + 1.0, 1e-6);
  EXPECT_NEAR(recorder_.plan_times_s[2], 0.5 + 0.3 + 1.0 + 0.3 + 2.0, 1e-6);
}

TEST_F(RobotLoopTest, SensorsGoOnWhileTheRobotStandsAndPlans) {
  server_.set_script(Tour({{1, 0}}));

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok());
  const double seconds = result->elapsed_s;
  const auto scans = std::llround(seconds * 10.0);
  const auto readings = std::llround(seconds * 2.0);
  EXPECT_NEAR(static_cast<double>(server_.applied()), static_cast<double>(scans + readings), 2.0);
  EXPECT_EQ(result->ingest.applied_sequence, result->ingest.last_sequence);
}

TEST_F(RobotLoopTest, EveryPlanWaitsForTheReadingsTakenSoFar) {
  std::vector<std::int64_t> awaited;
  auto tour = Tour({{1, 0}});
  server_.set_script([&](const PlanQuery& query) {
    awaited.push_back(query.min_applied_sequence);
    EXPECT_GE(server_.applied(), query.min_applied_sequence);
    return tour(query);
  });

  ASSERT_TRUE(RunInLockstep().ok());

  // Look-around of 0.5 s: scans at 0.0 ... 0.4 s and one gas reading.
  ASSERT_THAT(awaited, SizeIs(2));
  EXPECT_EQ(awaited[0], 6);
}

TEST_F(RobotLoopTest, ReportsComeAfterTheReadingsTakenOnTheWay) {
  server_.set_script(Tour({{1, 0}, {0, 0}}));

  ASSERT_TRUE(RunInLockstep().ok());

  const std::vector<FakePlannerClient::Report> reports = server_.reports();
  ASSERT_THAT(reports, SizeIs(2));
  EXPECT_EQ(reports[0].plan, 1);
  EXPECT_EQ(reports[0].outcome, ProgressOutcome::kReached);
  EXPECT_GE(reports[0].applied_sequence, 6 + 10);  // one second of scans at the least
}

TEST_F(RobotLoopTest, TwoRunsInLockstepSendTheSameBytes) {
  server_.set_script(Tour({{1, 0}, {2, 1}}));
  ASSERT_TRUE(RunInLockstep().ok());
  FakePlannerClient again;
  again.set_script(Tour({{1, 0}, {2, 1}}));
  FakeDriver driver;
  RobotLoop loop(again, driver, Options(Pacing::kLockstep, Following::kIdeal), recorder_);

  ASSERT_TRUE(loop.Run(NeverStop()).ok());

  EXPECT_EQ(server_.received(), again.received());
  EXPECT_EQ(server_.reports(), again.reports());
}

TEST_F(RobotLoopTest, StatusIsToldWhenItChangedAndNotTooOften) {
  const std::int64_t start_ns = driver_.now_ns();
  driver_.status = [start_ns](std::int64_t now_ns) {  // a percent in 4 s
    return RobotStatus{1.0 - 0.01 * static_cast<double>((now_ns - start_ns) / 4'000'000'000)};
  };
  server_.set_script(Tour({{4, 0}, {-4, 0}, {4, 0}, {-4, 0}}));
  ASSERT_TRUE(RunInLockstep().ok());
  std::vector<Observation> told;
  for (const Observation& observation : server_.received()) {
    if (std::holds_alternative<RobotStatus>(observation.payload)) told.push_back(observation);
  }
  ASSERT_GE(told.size(), 3U);
  EXPECT_EQ(std::get<RobotStatus>(told[0].payload), RobotStatus{1.0});
  for (std::size_t i = 1; i < told.size(); ++i) {
    EXPECT_NE(told[i].payload, told[i - 1].payload);
    EXPECT_GE(told[i].sample_time_ns - told[i - 1].sample_time_ns, 10'000'000'000);
  }
}

TEST_F(RobotLoopTest, OnlyARealClockIsHandedToTheLink) {
  ASSERT_TRUE(RunInLockstep().ok());
  EXPECT_EQ(server_.robot_clock_ns(), 0);
}

TEST_F(RobotLoopTest, ARealClockIsHandedToTheLink) {
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.real_clock = true;
  ASSERT_TRUE(Run(options).ok());
  EXPECT_GE(server_.robot_clock_ns(), 1'000'000'000'000);
}

TEST_F(RobotLoopTest, SteeredWheelsReachTheGoalsToo) {
  server_.set_script(Tour({{1, 0}, {1, 2}, {-1, -1}}));

  const absl::StatusOr<RobotResult> result =
      Run(Options(Pacing::kLockstep, Following::kProportional));

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->reached, 3);
  EXPECT_LT(Distance_m(driver_.pose().position(), {-1, -1}), 0.1 + 1e-9);
  EXPECT_EQ(driver_.twist().forward_mps, 0.0);
}

TEST_F(RobotLoopTest, TheTimeLimitEndsTheRunMidwayAndReleasesThePlan) {
  server_.set_script(Tour({{4, 0}}));
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.time_limit_s = 2.0;

  const absl::StatusOr<RobotResult> result = Run(options);

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->end, RobotEnd::kTimeLimit);
  EXPECT_NEAR(result->elapsed_s, 2.0, 1e-6);
  ASSERT_THAT(server_.reports(), SizeIs(1));
  EXPECT_EQ(server_.reports()[0].outcome, ProgressOutcome::kAborted);
}

TEST_F(RobotLoopTest, StopsWhenTold) {
  server_.set_script(Tour({{4, 0}}));
  int asked = 0;

  const absl::StatusOr<RobotResult> result =
      Run(Options(Pacing::kLockstep, Following::kIdeal), [&asked] { return ++asked > 20; });

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->end, RobotEnd::kStopped);
}

TEST_F(RobotLoopTest, InLockstepTheWorldWaitsForARestartedServer) {
  auto tour = Tour({{1, 0}, {1, 2}});
  bool restarted = false;
  server_.set_script([&](const PlanQuery& query) {
    if (!restarted && query.request.start->x_m > 0.5) {
      restarted = true;
      server_.Restart();
      return absl::StatusOr<Plan>(absl::UnavailableError("going down"));
    }
    return tour(query);
  });

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->reached, 2);
  EXPECT_GE(result->ingest.server_restarts, 1);
  EXPECT_EQ(server_.received().front().sequence, 1);  // told from the start
  EXPECT_EQ(server_.applied(), result->ingest.last_sequence);
}

TEST_F(RobotLoopTest, RunningFreelyItFollowsItsPathWhileTheLinkIsDownAndGoesOnAfterwards) {
  server_.set_script(Tour({{2, 0}, {2, 2}}));
  driver_.on_advance = [this] {
    absl::SleepFor(absl::Milliseconds(1));
    const double x_m = driver_.pose().x_m;
    if (x_m > 0.5 && x_m < 0.7) server_.BreakLink();
    const bool waiting = !recorder_.failures.empty();  // arrived, and asked in vain
    if (waiting) server_.MendLink();
  };
  RobotLoopOptions options = Options(Pacing::kFreeRunning, Following::kProportional);
  options.plan_timeout = absl::Milliseconds(20);

  const absl::StatusOr<RobotResult> result = Run(options);

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_FALSE(recorder_.failures.empty());
  EXPECT_EQ(result->reached, 2);
  EXPECT_EQ(result->ingest.applied_sequence, result->ingest.last_sequence);
  EXPECT_EQ(result->ingest.lost, 0);
}

TEST_F(RobotLoopTest, RunningFreelyItCompletesAMission) {
  server_.set_script(Tour({{1, 0}, {1, 2}}));

  const absl::StatusOr<RobotResult> result = RunFreely();

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->end, RobotEnd::kMissionComplete);
  EXPECT_EQ(result->reached, 2);
}

TEST_F(RobotLoopTest, APlanThatComesAfterTheEndIsGivenUp) {
  const FakePlannerClient::PlanScript tour = Tour({{1, 0}, {1, 2}});
  absl::Notification time_is_up;
  server_.set_script([&](const PlanQuery& query) {
    const bool second = query.request.start->x_m > 0.5;
    if (second) time_is_up.WaitForNotificationWithTimeout(absl::Seconds(20));
    return tour(query);
  });
  RobotLoopOptions options = Options(Pacing::kFreeRunning, Following::kProportional);
  options.time_limit_s = 30.0;
  const std::int64_t end_ns = driver_.now_ns() + 30'000'000'000;
  driver_.on_advance = [&] {
    absl::SleepFor(absl::Milliseconds(1));
    if (driver_.now_ns() >= end_ns && !time_is_up.HasBeenNotified()) time_is_up.Notify();
  };

  const absl::StatusOr<RobotResult> result = Run(options);

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->end, RobotEnd::kTimeLimit);
  ASSERT_THAT(server_.reports(), SizeIs(2));
  EXPECT_EQ(server_.reports()[0].outcome, ProgressOutcome::kReached);
  EXPECT_EQ(server_.reports()[1].plan, 2);
  EXPECT_EQ(server_.reports()[1].outcome, ProgressOutcome::kAborted);
}

TEST_F(RobotLoopTest, AReportThatTheServerCannotPlaceAnyMoreDoesNotFailTheRun) {
  server_.set_script(Tour({{4, 0}}));
  server_.set_report_answer(absl::FailedPreconditionError("PLAN_SUPERSEDED: by 9"));
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.time_limit_s = 2.0;  // on the way

  const absl::StatusOr<RobotResult> result = Run(options);

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->aborted, 1);
}

TEST_F(RobotLoopTest, ALeaseTakenByAnotherClientEndsTheRun) {
  server_.set_script([this](const PlanQuery&) -> absl::StatusOr<Plan> {
    server_.SupersedeLease();
    return absl::FailedPreconditionError("LEASE_SUPERSEDED: newer lease");
  });

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  EXPECT_EQ(ErrorReason(result.status()), kLeaseSuperseded) << result.status();
}

TEST_F(RobotLoopTest, APlanIsAskedForAgainUnderTheLeaseOfAServerThatWasSetBack) {
  server_.set_durable(true);
  auto tour = Tour({{1, 0}, {1, 2}});
  bool set_back = false;
  server_.set_script([&](const PlanQuery& query) {
    if (!set_back && query.request.start->x_m > 0.5) {
      set_back = true;
      server_.BreakLink();
      server_.SetBack(3, /*forget_lease=*/true);
      server_.MendLink();
      return absl::StatusOr<Plan>(absl::FailedPreconditionError("LEASE_SUPERSEDED: by none"));
    }
    return tour(query);
  });

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->reached, 2);
  EXPECT_EQ(server_.applied(), result->ingest.last_sequence);
  EXPECT_EQ(result->ingest.durable_sequence, result->ingest.last_sequence);
}

TEST_F(RobotLoopTest, ALogOnDiskIsGoneOnWith) {
  const TempFolder folder;
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.ingest.store.folder = folder.File("log");
  options.new_log_epoch = 8;
  ASSERT_TRUE(Run(options).ok());
  const std::int64_t first_life = server_.applied();
  options.new_log_epoch = 9;

  server_.Restart();  // and has forgotten all
  const absl::StatusOr<RobotResult> result = Run(options);

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_GT(result->ingest.last_sequence, first_life);
  EXPECT_EQ(server_.received().front().sequence, 1);
  EXPECT_EQ(static_cast<std::int64_t>(server_.received().size()), result->ingest.last_sequence);
  EXPECT_EQ(server_.registrations().back().log_epoch, 8);
}

TEST_F(RobotLoopTest, ALogOfAnotherRobotStopsTheStart) {
  const TempFolder folder;
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.ingest.store.folder = folder.File("log");
  options.new_log_epoch = 8;
  ASSERT_TRUE(Run(options).ok());

  options.participation.robot = "other";
  EXPECT_TRUE(absl::IsFailedPrecondition(Run(options).status()));
}

TEST_F(RobotLoopTest, ABrokenDriverEndsTheRunWithItsError) {
  driver_.advance_status = absl::InternalError("motors off");

  EXPECT_EQ(RunInLockstep().status(), absl::InternalError("motors off"));
}

TEST_F(RobotLoopTest, ALinkThatStaysBrokenIsGivenUpWhenJoining) {
  server_.BreakLink();
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.link_patience = absl::Milliseconds(5);
  ASSERT_TRUE(driver_.Drive({.forward_mps = 1.0}).ok());  // in a former life

  EXPECT_TRUE(absl::IsUnavailable(Run(options).status()));
  EXPECT_EQ(driver_.twist().forward_mps, 0.0);
}

TEST_F(RobotLoopTest, TicksAreReportedOnceForEachInstant) {
  server_.set_script(Tour({{1, 0}}));

  ASSERT_TRUE(RunInLockstep().ok());

  ASSERT_FALSE(recorder_.ticks.empty());
  for (std::size_t i = 1; i < recorder_.ticks.size(); ++i) {
    EXPECT_GT(recorder_.ticks[i].time_ns, recorder_.ticks[i - 1].time_ns);
  }
}

}  // namespace robot_loop_test
}  // namespace plumescout::client
