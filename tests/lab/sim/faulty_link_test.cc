// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/faulty_link.h"

#include <gtest/gtest.h>

#include "tests/client/fake_planner_client.h"

namespace plumescout::lab {
namespace faulty_link_test {

const Pose2 kPose{1.0, 2.0, 0.0};

class FaultyLinkTest : public ::testing::Test {
 protected:
  client::RobotSession Join() {
    EXPECT_TRUE(link_.CreateMission("m", {}).ok());
    const auto session = link_.RegisterRobot("m", "r", 0.2, false);
    EXPECT_TRUE(session.ok()) << session.status();
    return session.value();
  }

  client::FakePlannerClient server_;
  FaultyLink link_{server_};
};

TEST_F(FaultyLinkTest, PassesOnWhatComes) {
  const client::RobotSession session = Join();
  const auto stream = link_.OpenObservationStream(session);
  ASSERT_TRUE(stream.ok()) << stream.status();
  EXPECT_TRUE((*stream)->Write({{1, 5, kPose, GasReading{2.0}}}).ok());
  EXPECT_EQ(server_.applied(), 1);
  EXPECT_TRUE((*stream)->Read(absl::Seconds(10)).ok());
  client::PlanQuery query;
  query.lease_token = session.lease_token;
  EXPECT_TRUE(link_.NextBestTrajectory("m", query).ok());
}

TEST_F(FaultyLinkTest, WhileItIsDownNothingPasses) {
  const client::RobotSession session = Join();
  const auto stream = link_.OpenObservationStream(session);
  ASSERT_TRUE(stream.ok()) << stream.status();
  link_.Set(LinkState::kDown);
  EXPECT_TRUE(absl::IsUnavailable((*stream)->Write({{1, 5, kPose, GasReading{2.0}}})));
  EXPECT_TRUE(absl::IsUnavailable(link_.OpenObservationStream(session).status()));
  EXPECT_TRUE(absl::IsUnavailable(link_.NextBestTrajectory("m", {}).status()));
  EXPECT_TRUE(absl::IsUnavailable(link_.ReportProgress(session, 1, ProgressOutcome::kReached)));
  EXPECT_EQ(server_.applied(), 0);
  link_.Set(LinkState::kUp);
  EXPECT_TRUE(absl::IsUnavailable((*stream)->Read(absl::ZeroDuration()).status()))
      << "a stream does not come back";
  EXPECT_TRUE(link_.OpenObservationStream(session).ok());
}

TEST_F(FaultyLinkTest, ARobotThatIsSwitchedOffReportsToNobody) {
  const client::RobotSession session = Join();
  link_.Set(LinkState::kGone);
  EXPECT_TRUE(link_.ReportProgress(session, 1, ProgressOutcome::kAborted).ok());
  EXPECT_TRUE(server_.reports().empty());
  EXPECT_TRUE(absl::IsUnavailable(link_.GetMap("m").status()));
}

TEST_F(FaultyLinkTest, AWatchOutlivesACut) {
  server_.set_watched(true);
  const client::RobotSession session = Join();
  link_.Set(LinkState::kDown);
  const auto watch = link_.WatchRobot(session);
  ASSERT_TRUE(watch.ok()) << watch.status();
  EXPECT_TRUE(absl::IsDeadlineExceeded((*watch)->TryRead().status()));
  EXPECT_EQ(server_.watches_opened(), 0);
  link_.Set(LinkState::kUp);
  EXPECT_TRUE(absl::IsDeadlineExceeded((*watch)->TryRead().status()));
  EXPECT_EQ(server_.watches_opened(), 1);
  link_.Set(LinkState::kDown);
  server_.Notify(RobotStanding{.paused = true});
  EXPECT_TRUE(absl::IsDeadlineExceeded((*watch)->TryRead().status()));
  link_.Set(LinkState::kUp);
  const auto notice = (*watch)->Read(absl::Seconds(10));
  ASSERT_TRUE(notice.ok()) << notice.status();
  EXPECT_TRUE(*notice == RobotNotice(RobotStanding{.paused = true}));
  (*watch)->Cancel();
  EXPECT_TRUE(absl::IsCancelled((*watch)->TryRead().status()));
}

}  // namespace faulty_link_test
}  // namespace plumescout::lab
