// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a robot makes of what the service tells it unasked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "client/robot_loop.h"
#include "tests/client/robot_loop_fixture.h"

namespace plumescout::client {
namespace robot_loop_notices_test {

using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;

class RobotLoopNoticesTest : public RobotLoopTest {
 protected:
  void SetUp() override { server_.set_watched(true); }
  double now_s() const { return static_cast<double>(driver_.now_ns() - start_ns_) * 1e-9; }
  // Once, when so much time has gone by.
  void At(double time_s, std::function<void()> what) {
    driver_.on_advance = [this, time_s, what = std::move(what), before = driver_.on_advance,
                          done = false]() mutable {
      if (before) before();
      if (!done && now_s() >= time_s) {
        done = true;
        what();
      }
    };
  }

  std::int64_t start_ns_ = driver_.now_ns();
};

TEST_F(RobotLoopNoticesTest, APlanThatDoesNotStandIsReportedAndAnotherAskedFor) {
  server_.set_script(Tour({{4, 0}, {0, 2}}));
  At(2.0, [this] { server_.Notify(PlanInvalidated{.plan = 1}); });

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->invalidated, 1);
  EXPECT_EQ(result->aborted, 1);
  EXPECT_EQ(result->reached, 1);
  EXPECT_EQ(result->end, RobotEnd::kMissionComplete);
  EXPECT_THAT(server_.reports(),
              ElementsAre(Field(&FakePlannerClient::Report::outcome, ProgressOutcome::kAborted),
                          Field(&FakePlannerClient::Report::outcome, ProgressOutcome::kReached)));
  EXPECT_NEAR(recorder_.plan_times_s.at(1), 2.0, 0.5);
}

TEST_F(RobotLoopNoticesTest, OtherPlansAreNoneOfItsBusiness) {
  server_.set_script(Tour({{4, 0}}));
  At(1.0, [this] { server_.Notify(PlanInvalidated{.plan = 7}); });

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->reached, 1);
  EXPECT_EQ(result->aborted, 0);
}

TEST_F(RobotLoopNoticesTest, ItHeedsNothingIfToldSo) {
  server_.set_script(Tour({{4, 0}}));
  At(1.0, [this] { server_.Notify(PlanInvalidated{.plan = 1}); });
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.watch = false;

  const absl::StatusOr<RobotResult> result = Run(options);

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->reached, 1);
  EXPECT_EQ(server_.watches_opened(), 0);
}

TEST_F(RobotLoopNoticesTest, WhileTheMissionIsPausedItStandsAndDoesNotAsk) {
  server_.set_script(Tour({{2, 0}, {0, 2}}));
  At(1.0, [this] { server_.Notify(RobotStanding{.paused = true}); });
  At(20.0, [this] { server_.Notify(RobotStanding{}); });

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->reached, 2);
  EXPECT_THAT(recorder_.failures, IsEmpty());
  ASSERT_EQ(recorder_.plan_times_s.size(), 3u);
  EXPECT_NEAR(recorder_.plan_times_s[1], 20.0, 0.5);  // the first leg was driven to its end
}

TEST_F(RobotLoopNoticesTest, ARobotThatIsOrderedHomeAsksAtOnceAndOnce) {
  server_.set_script(Tour({{4, 0}, {0, 0}}));
  At(2.0, [this] { server_.Notify(RobotStanding{.ordered_home = true}); });

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->aborted, 1);
  EXPECT_EQ(result->reached, 1);
  EXPECT_NEAR(recorder_.plan_times_s.at(1), 2.0, 0.5);
}

TEST_F(RobotLoopNoticesTest, AFinishedMissionEndsTheRun) {
  server_.set_script(Tour({{4, 0}, {0, 0}}));
  At(2.0, [this] { server_.Notify(RobotStanding{.finished = true}); });

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->end, RobotEnd::kMissionFinished);
  EXPECT_NEAR(result->elapsed_s, 2.0, 0.5);
}

TEST_F(RobotLoopNoticesTest, AFreeRunningRobotHeedsThemToo) {
  server_.set_script(Tour({{4, 0}, {0, 2}}));
  At(2.0, [this] { server_.Notify(PlanInvalidated{.plan = 1}); });

  const absl::StatusOr<RobotResult> result = RunFreely();

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->invalidated, 1);
  EXPECT_EQ(result->reached, 1);
}

}  // namespace robot_loop_notices_test
}  // namespace plumescout::client
